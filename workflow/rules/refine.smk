# Friction over speed, curve by curve: where the config asks for it with speeds added until it is known between them. A job
# owns a curve and adds its speeds one by one, so that a further pressure runs its own curves and no others; what it has
# solved is kept, so that a further speed of the grid, or another accuracy, solves what is new.


def curve_file(name):
    """Return where friction at the speeds that are added to a curve belongs."""
    return f"{RESULTS}/refined/{RUBBER}/{ROAD}/{name}.csv"


def scenes_of_curves():
    """Return the results that each curve of friction over speed is made of, and their scenes, by the curve's name.

    A scale's own at one pressure and temperature; and all of them with those of the whole road.
    """
    curves = {}
    for name, scene in SCENES.items():
        if scene.aspect != CAMPAIGN.aspect or scene.velocity not in CAMPAIGN.velocities:
            continue
        place = scene.name.split("_aspect")[0].split("_p", 1)[1]
        for curve in (f"scale{scene.scale}_p{place}", f"all_p{place}"):
            of = curves.setdefault(curve, {"scales": {}, "whole": {}, "scenes": {}})
            of["scales"][scene_file(name)] = scene.digest
            of["scenes"][scene.scale] = scene
    for name, scene in WHOLE.items():
        place = scene.name.split("_aspect")[0].split("_p", 1)[1]
        draw, of = name.removesuffix(scene.name), curves[f"all_p{place}"]
        of["whole"].setdefault(draw, {})[whole_file(name)] = scene.digest
        of["scenes"][draw] = scene
    return curves


def sliding(curve):
    """Return what is slid over at every speed of a curve, as plain values."""
    scenes = {
        of: replace(one, velocity=1.0) for of, one in CURVES[curve]["scenes"].items()
    }
    scales = [of for of in scenes if of in CAMPAIGN.scales]
    return {
        "scales": [scenes[scale].parameters() for scale in scales],
        "whole": {
            draw: scenes[draw].parameters()
            for draw in scenes
            if draw not in CAMPAIGN.scales
        },
        "road": (
            ROADS[scenes[scales[0]].temperature] if curve.startswith("all_") else None
        ),
    }


CURVES = scenes_of_curves() if CAMPAIGN.refine else {}
REFINED = [*CURVES]
# The tables of the grid's points, and of the added ones, by the name of the curve.
CURVES_OF = {
    **{
        f"scale {scale}": f"{RESULTS}/tables/friction_scale_{scale}.csv"
        for scale in CAMPAIGN.scales
    },
    "whole road": f"{RESULTS}/tables/friction_total.csv",
}
ADDED_TO = {
    name: [
        curve_file(curve)
        for curve in REFINED
        if curve.startswith(name.replace("whole road", "all").replace(" ", "") + "_p")
    ]
    for name in CURVES_OF
}
CURVE_TABLES = {
    "curves": f"{RESULTS}/tables/curves.csv",
    "peaks": f"{RESULTS}/tables/peaks.csv",
    "page": f"{RESULTS}/tables/peaks.html",
}
# What figures draw in place of straight lines between the grid's points.
DRAWN_CURVES = CURVE_TABLES["curves"] if REFINED else []


if REFINED:

    rule refined_curve:
        input:
            package_files("rubfric.curve_simulation"),
            script=script_copy("refine_curve.py"),
            scales=lambda wildcards: [*CURVES[wildcards.curve]["scales"]],
            whole=lambda wildcards: [
                path
                for paths in CURVES[wildcards.curve]["whole"].values()
                for path in paths
            ],
        output:
            curve_file("{curve}"),
        log:
            f"{RESULTS}/logs/refined/{RUBBER}/{ROAD}/{{curve}}.log",
        wildcard_constraints:
            curve="|".join(REFINED),
        priority: 7
        localrule: workflow.remote_exec
        params:
            scales=lambda wildcards: CURVES[wildcards.curve]["scales"],
            whole=lambda wildcards: CURVES[wildcards.curve]["whole"],
            sliding=lambda wildcards: sliding(wildcards.curve),
            accuracy=CAMPAIGN.refine,
            version=rubfric.__version__,
        message:
            "Adding speeds to {wildcards.curve}"
        run:
            jobs.run(
                input.script,
                log[0],
                output=output[0],
                scales=params.scales,
                whole=params.whole,
                sliding=params.sliding,
                accuracy=params.accuracy,
                results=RESULTS,
            )


rule curve_table:
    input:
        package_files(
            "rubfric.results.peaks", "rubfric.results.tables", "rubfric.pages.table"
        ),
        page_files("table"),
        script=script_copy("tabulate_curves.py"),
        tables=CURVES_OF.values(),
        added=[path for paths in ADDED_TO.values() for path in paths],
    output:
        curves=report(
            CURVE_TABLES["curves"],
            caption="../report/curve_table.rst",
            category=REPORT.tables,
            subcategory="curves",
            labels={"table": "friction over speed, every point"},
        ),
        peaks=report(
            CURVE_TABLES["peaks"],
            caption="../report/curve_table.rst",
            category=REPORT.tables,
            subcategory="curves",
            labels={"table": "peaks and half-widths", "as": "spreadsheet (CSV)"},
        ),
        page=report(
            CURVE_TABLES["page"],
            caption="../report/curve_table.rst",
            category=REPORT.tables,
            subcategory="curves",
            labels={"table": "peaks and half-widths", "as": "page"},
        ),
    log:
        f"{RESULTS}/logs/tables/curves.log",
    localrule: True
    params:
        tables=CURVES_OF,
        added=ADDED_TO,
        aspect=CAMPAIGN.aspect,
        about=(RUBBER, ROAD),
        accuracy=CAMPAIGN.refine,
    message:
        "Peaks of friction over speed: {output.peaks}"
    run:
        jobs.run(input.script, log[0], **dict(output.items()), **dict(params.items()))


rule curves:
    input:
        scene_files,
        whole_files,
        [curve_file(name) for name in REFINED],
        CURVE_TABLES.values(),
