# What all rules share: paths, the names of rubber and road, and how a job runs.
import os
import sys
from types import SimpleNamespace
from dataclasses import asdict, replace

from snakemake.logging import logger
from snakemake.settings.enums import Quietness

import rubfric
from rubfric.runner import jobs
from rubfric.config.default import PAPER as PAPER_CONFIG
from rubfric.checks import written
from rubfric.checksums import fingerprint
from rubfric.config.pairs import not_covered
from rubfric.runner.findings import carrying, highest, told_apart, verdicts
from rubfric.config.models import AS_CONFIGURED
from rubfric.pages.render import assets
from rubfric.runner.leftovers import remove_leftovers
from rubfric.runner.opening import Costs, understood
from rubfric.progress import kind
from rubfric.runner.runlog import RunLog, attach
from rubfric.runner.reruns import copy_of, stamp, stamp_files
from rubfric.scene.scene import ALL
from rubfric.studies.accuracy.scenes import (
    batches,
    drawn_scenes,
    finite_scenes,
    fixed_scenes,
    total_scenes,
    whole_scenes,
)


def in_place(folder):
    """Return a folder as it is, or where the prefix of a module puts it; absolute then, since it would be put twice."""
    given = f"{folder}/"
    moved = workflow.modifier.path_modifier.replace_prefix(given)
    return folder if moved == given else os.path.abspath(moved)


RESULTS = in_place(CAMPAIGN.results)
RUBBER = CAMPAIGN.material.name
ROAD = CAMPAIGN.road_name
# The campaign of every rubber on every road, by their names: this one first. Several are compared.
PAIRS = CAMPAIGN.pairs
COMPARED = len(PAIRS) > 1
OF_PAIR = " of {wildcards.rubber} on {wildcards.road}" if COMPARED else ""
# The temperature of whatever shows one, and the campaign at it; None, and the campaign itself, where it has none.
TEMPERATURE = CAMPAIGN.figures.temperature
AT_ONE = CAMPAIGN.at(TEMPERATURE)
# What jobs need of the workflow itself, in a form that Snakemake watches.
SOURCES = ".snakemake/sources"
# Where things are in the report, which sorts by name.
REPORT = SimpleNamespace(
    answers="1 Answers",
    figures="2 Figures",
    tables="3 Tables",
    accuracy="4 Accuracy",
    stability="5 Stability",
    fields="6 Fields and data",
)


wildcard_constraints:
    scene=r"scale\d+_v[0-9.e-]+_p[0-9.e-]+(_T[0-9.e-]+)?_aspect[0-9.e-]+_(stress|strain)",
    whole=r"((cutoff[0-9.e-]+/)?(draw|window)\d+/|sines/)?all_v[0-9.e-]+_p[0-9.e-]+(_T[0-9.e-]+)?_aspect[0-9.e-]+_(stress|strain)",
    rubber=r"[A-Za-z0-9_-]+",
    road=r"[A-Za-z0-9_-]+",
    scale=r"\d+",
    figure=r"\w+",


def package_files(*modules):
    """Return a file that represents the package's files behind some modules: a job that lists it reruns when the content
    of one of them changes.
    """
    return local(stamp(SOURCES, *modules))


def page_files(page):
    """Return a file that represents the templates, styles and scripts of a page beside its code."""
    return local(stamp_files(SOURCES, page, assets(page)))


def script_copy(name):
    """Return a script of the workflow as a file of the working folder, which may be anywhere."""
    return local(copy_of(SOURCES, workflow.source_path(f"../scripts/{name}")))


def scene_file(name, rubber=RUBBER, road=ROAD):
    """Return where the result of a scene belongs."""
    return f"{RESULTS}/scenes/{rubber}/{road}/{name}.nc"


def scene_files(wildcards):
    """Return the results of all scenes; a function, since only some runs need to know."""
    return [scene_file(name) for name in SCENES]


def whole_file(name, rubber=RUBBER, road=ROAD):
    """Return where the result of a scene of the whole road belongs."""
    return f"{RESULTS}/whole/{rubber}/{road}/{name}.nc"


def whole_files(wildcards):
    """Return the results of all scenes of the whole road; a function, since only some runs need to know."""
    return [whole_file(name) for name in WHOLE]


def areal_file(name):
    """Return where the result of a scene on an areal road belongs."""
    return f"{RESULTS}/areal/{RUBBER}/{name}.nc"


def of_scan(name):
    """Return how the scan of a scene is read, given its name with its road; None on another road."""
    return SCANS.get(name.split("/")[0])


def profiles_file(name):
    """Return where the result of the profiles of a scene on an areal road belongs."""
    return f"{RESULTS}/areal_profiles/{RUBBER}/{name}.nc"


def shown_profiles(road):
    """Return the results of the profiles of all scenes that a figure shows, by name; none where there are none."""
    count = AREAL_PROFILES[road]
    return {
        name: scene.digest_of_profiles(count)
        for name, scene in AREAL_SHOWN[road].items()
        if count
    }


def choosing(rubber, road, whole):
    """Return the parameters of the whole road that decide whether a scene of it is needed; none where all are."""
    pair = rubber, road
    return ROADS_OF[pair][WHOLE_OF[pair][whole].temperature] if CHOOSING[pair] else {}


def road_points():
    """Return pressure, speed, cutoff, and paths and digests of all windows, for each point of the table."""
    points = []
    cutoffs = [CAMPAIGN.survey.cutoff, *CAMPAIGN.survey.coarser]
    for cutoff in cutoffs:
        named = {}
        for number in range(1, len(CAMPAIGN.survey.windows) + 1):
            finest = cutoff == CAMPAIGN.survey.cutoff
            place = f"window{number}/" if finest else folder(cutoff, number)
            for name, scene in (WHOLE if finest else CUTOFF_SCENES).items():
                if name == f"{place}{scene.name}" and scene.temperature == TEMPERATURE:
                    named.setdefault((scene.pressure, scene.velocity), {})[
                        whole_file(name)
                    ] = scene.digest
        points += [[*point, cutoff, files] for point, files in named.items()]
    return points


def pair_files(rubber, road):
    """Return the results of all scenes of a rubber on a road, the whole road's too."""
    pair = rubber, road
    return [*DIGESTS_OF[pair], *(whole_file(name, *pair) for name in WHOLE_OF[pair])]


def march_file(name):
    """Return where the march of a scene belongs."""
    return f"{RESULTS}/marches/{RUBBER}/{ROAD}/{name}.nc"


def pictures(figure, caption, shows, category=REPORT.figures):
    """Return the outputs of a figure: vector graphics, and the picture, which the report shows first.

    ``shows`` says in a few words what is seen, or is a function of the wildcards that does.
    """

    def labels(form):
        def described(wildcards):
            name = figure.format(**dict(wildcards.items()))
            words = shows(wildcards) if callable(shows) else shows
            if name.startswith(
                "fig"
            ):  # the report sorts by words: a figure space puts Fig. 2 before Fig. 10
                name = f"Fig. {name.removeprefix('fig').rjust(2, chr(0x2007))}"
            return {"figure": name, "shows": words, "as": form}

        return described

    return {
        kind: report(
            f"{RESULTS}/figures/{figure}.{kind}",
            caption=caption,
            category=category,
            subcategory=None if category == REPORT.figures else "figures",
            labels=labels(form),
        )
        for kind, form in (("pdf", "print (PDF)"), ("png", "picture (PNG)"))
    }


def extremes(values):
    """Return the least and the largest."""
    return min(values), max(values)


def road_number(name):
    """Return on which of several roads a scene is, from 1, given its name with its folder; 0 on the only one."""
    return (
        [*CAMPAIGN.whole_roads].index(name.split("all_")[0]) + 1 if "/" in name else 0
    )


def whole_fingerprint(digests):
    """Return what the collection of the whole road is known by, given the digests of the scenes of every road."""
    roads = [fingerprint(sorted(each.values())) for each in digests.values()]
    return roads[0] if "" in digests else fingerprint(roads)


def reading_file(reading, batch):
    """Return where observations of a batch of scenes in another reading of the paper belong."""
    return f"{RESULTS}/readings/{reading}/{RUBBER}/{ROAD}/{batch}.csv"


def batches_by_speed(scenes):
    """Return scenes by name, in batches of one scale, or the whole road, and one speed."""
    batches = {}
    for name, scene in scenes.items():
        place = ALL if scene.scale == ALL else f"scale{scene.scale}"
        batch = f"{place}_v{written(scene.velocity)}"
        batches.setdefault(batch, {})[name] = scene
    return batches


def whole_once(reading):
    """Return the scenes of the whole road by name, of random roads the first, as accurate as a reading's others."""
    first = next(iter(reading.whole_roads), "")
    return {
        scene.name: replace(scene, numerics=reading.numerics)
        for name, scene in reading.whole_scenes().items()
        if name == f"{first}{scene.name}"
    }


def criteria(campaign):
    """Return what the verdicts on the paper's claims depend on, besides results."""
    fields = campaign.figures.fields
    return {
        "aspect": campaign.aspect,
        "studied": list(getattr(campaign.aspect_study, "pressures", ())),
        "profiled": {
            "scale": [fields.scale],
            "velocity": list(fields.velocities),
            "pressure": list(fields.pressures),
            "aspect": [campaign.aspect],
        },
        "difference": campaign.claims.difference,
        "saturation": campaign.procedure()["saturation"],
        "total_pressure": campaign.figures.total_pressure,
    }


def own_name(name):
    """Return the name that a rule has in this workflow, given the one that a module gives it."""
    before, _, after = workflow.modifier.modify_rulename("*").partition("*")
    return name.removeprefix(before).removesuffix(after) or name


def made_for_a_config():
    """Return what the present config makes that another may not, by rule."""
    pages = [path.removesuffix("csv") + "html" for path in TABLES]
    return {
        **dict.fromkeys(["scale_table", "total_table"], [*TABLES, *pages]),
        **dict.fromkeys(
            ["campaign_figure", "field_figure", "total_figure", "whole_figure"]
            + ["rig_figure", "rig_schematic", "march_figure"],
            [*FIGURES, *MARCH_FIGURE],
        ),
        "refined_curve": [curve_file(name) for name in REFINED],
        "curve_table": [*CURVE_TABLES.values()],
        "pair_table": [*PAIR_TABLES.values()],
        "comparison_table": [*COMPARISON.values(), COMPARISON_MARK],
        "comparison_figure": FIGURES,
        "rig_points": RIG_TABLES,
        "rubber_fit": RUBBER_FILES,
        "road_read": ROAD_FILES,
        "areal_figure": AREAL_FIGURES,
        "areal_table": AREAL_TABLES,
        "road_friction": ROAD_FRICTION,
        "road_figure": ROAD_FIGURES,
        "claims": CLAIM_FILES,
        **({} if WHOLE else {"whole_collection": []}),
    }


def follow(workflow):
    """Return the short log of this run, which follows Snakemake's own."""
    output = workflow.output_settings
    quiet = output.quiet or set()
    stream = sys.stdout if output.stdout else sys.stderr
    # A module may give its rules other names, and the workflow around it has rules of its own.
    own = {rule.name: own_name(rule.name) for rule in workflow.modifier.rules}
    costs = Costs.of(CAMPAIGN)
    run = RunLog(
        RESULTS,
        targets=[own[rule.name] for rule in workflow.modifier.rules if not rule.output],
        rules=own,
        tables=[*TABLES, CURVE_TABLES["peaks"], *COMPARISON.values()],
        first=[
            f"{RESULTS}/{path}"
            for path in (
                "index.html",
                *(["claims.html"] if CAMPAIGN.claims else []),
                "tables/friction_total.csv",
                *(["tables/ranking.html"] if COMPARED else []),
                "figures/fig6.png",
                "explorer.html",
                *([f"rubbers/{RUBBER}.html"] if CAMPAIGN.fitted else []),
                *([f"roads/{ROAD}.html"] if CAMPAIGN.survey else []),
                *([f"roads/{ROAD}_friction.html"] if ROAD_FRICTION else []),
                *(f"tables/areal_{road}.html" for road in CAMPAIGN.areal),
            )
        ],
        dry=lambda: workflow.dryrun,
        touch=lambda: workflow.touch,
        threads=lambda: workflow.use_threads,
        seconds=jobs.seconds,
        stream=None if Quietness.ALL in quiet else stream,
        opening=lambda: understood(CAMPAIGN, OWN_CAMPAIGN),
        expected=lambda rule: costs.job(rule, kind(rule)),
        at_once=lambda: workflow.resource_settings.cores or 1,
        leftovers=lambda: remove_leftovers(
            ".snakemake/metadata", RESULTS, made_for_a_config()
        ),
    )
    attach(run, logger, silence=Quietness.RULES in quiet)
    return run
