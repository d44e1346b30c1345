# Accuracy against cost, on a fixed set of scenes and on scenes drawn at random: tables, figures and a page. It takes
# about an hour on two cores, and is no part of `all`. It measures the paper's rubber and road, whatever the config.
PAPER = Campaign.from_config(read_yaml(PAPER_CONFIG))
PRESETS = {name: asdict(numerics) for name, numerics in PAPER.presets.items()}
LADDERS = fixed_scenes(PAPER) | total_scenes(PAPER)
DRAWN = drawn_scenes(PAPER, count=60, seed=2019) | whole_scenes(
    PAPER, count=48, seed=2019
)
# Each in finite strain on the whole road is a job of its own: a reference takes two to three gigabytes.
FINITE = finite_scenes(PAPER, count=12, seed=2019)
DRAWN_BATCHES = dict(enumerate([*batches(list(DRAWN), 6), *batches(list(FINITE), 1)]))
DRAWN |= FINITE
ACCURACY = {
    name: f"{RESULTS}/accuracy/{name}.{kind}"
    for name, kind in [
        *(
            (table, "csv")
            for table in ("ladder", "knobs", "starts", "calibration", "verdict")
        ),
        ("page", "md"),
    ]
}
ACCURACY_WORDS = {
    "pareto": "error against cost, knob by knob",
    "calibration": "estimated against true errors",
}


rule ladder:
    input:
        package_files("rubfric.studies.accuracy.ways"),
        script=script_copy("measure_ladder.py"),
    output:
        f"{RESULTS}/accuracy/ladders/{{scene}}.csv",
    log:
        f"{RESULTS}/logs/accuracy/{{scene}}.log",
    wildcard_constraints:
        scene="|".join(LADDERS),
    localrule: workflow.remote_exec
    params:
        parameters=lambda wildcards: LADDERS[wildcards.scene].parameters(),
    message:
        "Accuracy against cost: {wildcards.scene}"
    run:
        jobs.run(
            input.script,
            log[0],
            output=output[0],
            name=wildcards.scene,
            parameters=params.parameters,
        )


rule calibrate:
    input:
        package_files("rubfric.studies.accuracy.calibration"),
        script=script_copy("calibrate_errors.py"),
    output:
        f"{RESULTS}/accuracy/drawn/{{batch}}.csv",
    log:
        f"{RESULTS}/logs/accuracy/drawn_{{batch}}.log",
    wildcard_constraints:
        batch=r"\d+",
    localrule: workflow.remote_exec
    params:
        scenes=lambda wildcards: {
            name: DRAWN[name].parameters()
            for name in DRAWN_BATCHES[int(wildcards.batch)]
        },
        presets=PRESETS,
    message:
        "Estimated against true errors: batch {wildcards.batch}"
    run:
        jobs.run(
            input.script,
            log[0],
            output=output[0],
            scenes=params.scenes,
            presets=params.presets,
        )


rule accuracy_tables:
    input:
        package_files("rubfric.studies.accuracy.page"),
        script=script_copy("tabulate_accuracy.py"),
        ladders=expand(
            f"{RESULTS}/accuracy/ladders/{{scene}}.csv",
            scene=LADDERS,
        ),
        calibrations=expand(
            f"{RESULTS}/accuracy/drawn/{{batch}}.csv",
            batch=DRAWN_BATCHES,
        ),
    output:
        **{
            name: (
                report(
                    path,
                    caption="../report/accuracy_table.rst",
                    category=REPORT.accuracy,
                    subcategory="tables",
                    labels={"table": name},
                )
                if path.endswith(".csv")
                else path
            )
            for name, path in ACCURACY.items()
        },
    log:
        f"{RESULTS}/logs/accuracy/tables.log",
    localrule: True
    params:
        accuracies={name: preset["accuracy"] for name, preset in PRESETS.items()},
    message:
        "Tables of accuracy against cost"
    run:
        jobs.run(
            input.script,
            log[0],
            outputs=ACCURACY,
            ladders=list(input.ladders),
            calibrations=list(input.calibrations),
            accuracies=params.accuracies,
        )


rule accuracy_figure:
    input:
        lambda wildcards: package_files(f"rubfric.figures.{wildcards.figure}"),
        script=script_copy("draw_table_figure.py"),
        table=lambda wildcards: ACCURACY[
            {"pareto": "ladder"}.get(wildcards.figure, wildcards.figure)
        ],
    output:
        **pictures(
            "{figure}",
            "../report/accuracy_figure.rst",
            lambda wildcards: ACCURACY_WORDS[wildcards.figure],
            REPORT.accuracy,
        ),
    log:
        f"{RESULTS}/logs/figures/{{figure}}.log",
    wildcard_constraints:
        figure="pareto|calibration",
    localrule: True
    message:
        "Drawing {wildcards.figure}"
    run:
        jobs.run(
            input.script,
            log[0],
            figure=wildcards.figure,
            table=input.table,
            outputs=list(output),
        )


rule accuracy:
    input:
        ACCURACY.values(),
        expand(
            f"{RESULTS}/figures/{{figure}}.{{kind}}",
            figure=["pareto", "calibration"],
            kind=["pdf", "png"],
        ),
