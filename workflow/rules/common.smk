# What all rules share: paths, the names of rubber and road, and how a job runs.
import os
import sys
from types import SimpleNamespace
from dataclasses import asdict

from snakemake.logging import logger
from snakemake.settings.enums import Quietness

import rubfric
from rubfric.runner import jobs
from rubfric.config.campaign import load
from rubfric.checks import written
from rubfric.checksums import fingerprint
from rubfric.runner.findings import highest, verdicts
from rubfric.config.models import AS_CONFIGURED
from rubfric.pages.render import assets
from rubfric.runner.runlog import RunLog, attach
from rubfric.runner.reruns import stamp
from rubfric.studies.accuracy.scenes import (
    batches,
    drawn_scenes,
    fixed_scenes,
    whole_scenes,
)

RESULTS = CAMPAIGN.results
RUBBER = CAMPAIGN.material.name
ROAD = CAMPAIGN.road_name
# Where things are in the report, which sorts by name.
REPORT = SimpleNamespace(
    answers="1 Answers",
    figures="2 Figures of the paper",
    tables="3 Tables",
    accuracy="4 Accuracy",
    stability="5 Stability",
    fields="6 Fields and data",
)


wildcard_constraints:
    scene=r"scale\d+_v[0-9.e-]+_p[0-9.e-]+_aspect[0-9.e-]+_(stress|strain)",
    whole=r"(draw\d+/)?all_v[0-9.e-]+_p[0-9.e-]+_aspect[0-9.e-]+_(stress|strain)",
    scale=r"\d+",
    figure=r"\w+",


# On a cluster, tables and figures run where Snakemake does: they take seconds. The scenes of a batch are local to the
# one Snakemake that runs them on their node: it would start another for each.
localrules:
    campaign,
    whole_collection,
    scale_table,
    total_table,
    campaign_figure,
    field_figure,
    march_figure,
    rig_points,
    rig_figure,
    rig_schematic,
    claims,
    explorer,
    accuracy_tables,
    accuracy_figure,
    stability_table,
    stability_figure,


if workflow.remote_exec:

    localrules:
        scene,
        whole_scene,
        reading,
        march,
        ladder,
        calibrate,
        stability_batch,


def package_files(*modules):
    """Return a file that represents the package's files behind some modules: a job that lists it reruns when the content
    of one of them changes.
    """
    return stamp(".snakemake/sources", *modules)


def page_files(page):
    """Return the templates, styles and scripts that a page is made of beside its code."""
    return [os.path.relpath(path) for path in assets(page)]


def scene_file(name):
    """Return where the result of a scene belongs."""
    return f"{RESULTS}/scenes/{RUBBER}/{ROAD}/{name}.nc"


def scene_files(wildcards):
    """Return the results of all scenes; a function, since only some runs need to know."""
    return [scene_file(name) for name in SCENES]


def whole_file(name):
    """Return where the result of a scene of the whole road belongs."""
    return f"{RESULTS}/whole/{RUBBER}/{ROAD}/{name}.nc"


def whole_files(wildcards):
    """Return the results of all scenes of the whole road; a function, since only some runs need to know."""
    return [whole_file(name) for name in WHOLE]


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


def whole_fingerprint(digests):
    """Return what the collection of the whole road is known by, given the digests of the scenes of every road."""
    roads = [fingerprint(sorted(each.values())) for each in digests.values()]
    return roads[0] if "" in digests else fingerprint(roads)


def reading_file(reading, batch):
    """Return where observations of a batch of scenes in another reading of the paper belong."""
    return f"{RESULTS}/readings/{reading}/{RUBBER}/{ROAD}/{batch}.csv"


def batches_by_speed(scenes):
    """Return scenes by name, in batches of one scale and speed."""
    batches = {}
    for name, scene in scenes.items():
        batch = f"scale{scene.scale}_v{written(scene.velocity)}"
        batches.setdefault(batch, {})[name] = scene
    return batches


def criteria(campaign):
    """Return what the verdicts on the paper's claims depend on, besides results."""
    fields = campaign.figures.fields
    return {
        "aspect": campaign.aspect,
        "studied": list(campaign.aspect_study.pressures),
        "profiled": {
            "scale": [fields.scale],
            "velocity": list(fields.velocities),
            "pressure": list(fields.pressures),
            "aspect": [campaign.aspect],
        },
        "difference": campaign.claims.difference,
        "saturation": campaign.transient.saturation,
        "total_pressure": campaign.figures.total_pressure,
    }


def follow(workflow):
    """Return the short log of this run, which follows Snakemake's own."""
    output = workflow.output_settings
    quiet = output.quiet or set()
    stream = sys.stdout if output.stdout else sys.stderr
    run = RunLog(
        RESULTS,
        targets=[rule.name for rule in workflow.rules if not rule.output],
        tables=TABLES,
        first=[
            f"{RESULTS}/{path}"
            for path in (
                "claims.html",
                "tables/friction_total.csv",
                "figures/fig6.png",
                "explorer.html",
            )
        ],
        dry=lambda: workflow.dryrun,
        seconds=jobs.seconds,
        stream=None if Quietness.ALL in quiet else stream,
    )
    attach(run, logger, silence=Quietness.RULES in quiet)
    return run
