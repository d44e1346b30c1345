# Friction on a measured road over its windows: beside Persson's theory and sines, and down to one cutoff after the other.
ROAD_FRICTION = [
    f"{RESULTS}/roads/{ROAD}_friction.{kind}"
    for kind in ("csv", "html")
    if CUTOFF_SCENES
]
ROAD_PICTURES = {
    "road_persson": "friction and contact on the measured road, beside Persson's theory",
    "road_cutoff": "which waves of the measured road carry friction",
}
ROAD_FIGURES = [
    f"{RESULTS}/figures/{figure}.{kind}"
    for figure in ROAD_PICTURES
    for kind in ("pdf", "png")
    if CUTOFF_SCENES
]


if ROAD_FRICTION:
    ROAD_POINTS = road_points()
    ROAD_SINES = [
        [scene.pressure, scene.velocity, whole_file(name), scene.digest]
        for name, scene in CUTOFF_SCENES.items()
        if name.startswith("sines/")
    ]

    rule road_friction:
        input:
            package_files("rubfric.config.measured_road", "rubfric.pages.slide"),
            page_files("slide"),
            script=script_copy("tabulate_road.py"),
            profile=local(CAMPAIGN.survey.source),
            total=rules.total_table.output.table,
            scenes=[path for *_, files in ROAD_POINTS for path in files],
            sines=[path for *_, path, _ in ROAD_SINES],
        output:
            table=report(
                ROAD_FRICTION[0],
                caption="../report/road_friction.rst",
                category=REPORT.answers,
                labels=lambda wildcards, output: {
                    "answer": f"friction of the measured road: {carrying(output.table)}",
                    "as": "spreadsheet (CSV)",
                },
            ),
            page=report(
                ROAD_FRICTION[1],
                caption="../report/road_friction.rst",
                category=REPORT.answers,
                labels=lambda wildcards, output: {
                    "answer": f"friction of the measured road: {carrying(output.table)}",
                    "as": "page",
                },
            ),
        log:
            f"{RESULTS}/logs/roads/{ROAD}_friction.log",
        localrule: True
        params:
            road=ROAD,
            entry={
                name: value
                for name, value in config["roads"][ROAD].items()
                if name != "profile"
            },
            scene=next(iter(CUTOFF_SCENES.values())).parameters(),
            points=ROAD_POINTS,
            sines=ROAD_SINES,
            temperature=TEMPERATURE,
        message:
            f"Friction of road {ROAD}: {ROAD_FRICTION[0]}"
        run:
            jobs.run(
                input.script,
                log[0],
                output=output.table,
                page=output.page,
                road=params.road,
                entry={**params.entry, "profile": input.profile},
                scene=params.scene,
                points=params.points,
                sines=params.sines,
                total=input.total,
                temperature=params.temperature,
            )

    rule road_figure:
        input:
            package_files("rubfric.figures.road_friction"),
            script=script_copy("draw_road.py"),
            table=rules.road_friction.output.table,
        output:
            **pictures(
                "{figure}",
                "../report/road_friction.rst",
                lambda wildcards: ROAD_PICTURES[wildcards.figure],
            ),
        log:
            f"{RESULTS}/logs/figures/{{figure}}.log",
        wildcard_constraints:
            figure="|".join(ROAD_PICTURES),
        localrule: True
        params:
            temperature=TEMPERATURE,
        message:
            "Drawing {wildcards.figure}"
        run:
            jobs.run(
                input.script,
                log[0],
                figure=wildcards.figure,
                table=input.table,
                temperature=params.temperature,
                outputs=list(output),
            )
