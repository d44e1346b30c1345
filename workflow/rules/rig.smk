# The test rig: measured runs, or those of a virtual one, as points of friction over speed and pressure; Figs 8 and 9.
RIG_TABLES = [
    f"{RESULTS}/tables/{name}.csv"
    for name in ("rig_points", "rig_rejected")
    if CAMPAIGN.rig
]


if CAMPAIGN.rig:

    rule rig_points:
        input:
            package_files(
                "rubfric.rig.virtual", "rubfric.rig.summary", "rubfric.results.tables"
            ),
            script=script_copy("measure_rig.py"),
            totals=rules.total_table.output.table,
            measured=RIG_FILES,
        output:
            points=report(
                RIG_TABLES[0],
                caption="../report/rig.rst",
                category=REPORT.tables,
                subcategory="test rig",
                labels={"table": "points"},
            ),
            rejected=report(
                RIG_TABLES[1],
                caption="../report/rig.rst",
                category=REPORT.tables,
                subcategory="test rig",
                labels={"table": "rejected windows"},
            ),
        log:
            f"{RESULTS}/logs/tables/rig_points.log",
        localrule: True
        params:
            rig=CAMPAIGN.rig.model_dump(),
            temperature=TEMPERATURE,
        message:
            "Test rig: {output.points}"
        run:
            jobs.run(
                input.script,
                log[0],
                points=output.points,
                rejected=output.rejected,
                totals=input.totals,
                rig=params.rig,
                temperature=params.temperature,
            )

    rule rig_figure:
        input:
            package_files("rubfric.figures.fig9", "rubfric.figures.temperature"),
            script=script_copy("draw_rig.py"),
            totals=rules.total_table.output.table,
            points=rules.rig_points.output.points,
        output:
            **pictures("fig9", "../report/fig9.rst", "friction on the test rig"),
        log:
            f"{RESULTS}/logs/figures/fig9.log",
        localrule: True
        params:
            pressures=list(CAMPAIGN.rig.pressures),
            speeds=list(CAMPAIGN.rig.speeds),
            temperature=TEMPERATURE,
        message:
            "Drawing fig9"
        run:
            jobs.run(
                input.script,
                log[0],
                totals=input.totals,
                points=input.points,
                pressures=params.pressures,
                speeds=params.speeds,
                temperature=params.temperature,
                outputs=list(output),
            )

    rule rig_schematic:
        input:
            package_files("rubfric.figures.fig8"),
            script=script_copy("draw_schematic.py"),
        output:
            **pictures("fig8", "../report/fig8.rst", "the test rig"),
        log:
            f"{RESULTS}/logs/figures/fig8.log",
        localrule: True
        message:
            "Drawing fig8"
        run:
            jobs.run(input.script, log[0], figure="fig8", outputs=list(output))

    rule rig:
        input:
            rules.rig_points.output,
            rules.rig_figure.output,
            rules.rig_schematic.output,
