# Numerical stability far beyond the paper: every case of the matrix in a process of its own, some cases a job.
from rubfric.studies.stability.cases import cases

STABILITY = f"{RESULTS}/stability"
EXTREMES = cases()
CASES_PER_JOB = 32
BATCHES = [str(number) for number in range(-(-len(EXTREMES) // CASES_PER_JOB))]


rule stability_batch:
    input:
        package_files("rubfric.studies.stability.report"),
        script=script_copy("try_extremes.py"),
    output:
        f"{RESULTS}/stability/batches/{{batch}}.csv",
    log:
        f"{RESULTS}/logs/stability/{{batch}}.log",
    wildcard_constraints:
        batch=r"\d+",
    localrule: workflow.remote_exec
    params:
        cases=lambda wildcards: [
            case.parameters()
            for case in EXTREMES[int(wildcards.batch) :: len(BATCHES)]
        ],
        version=rubfric.__version__,
    message:
        "Stability, batch {wildcards.batch}"
    run:
        jobs.run(input.script, log[0], output=output[0], cases=params.cases)


rule stability_table:
    input:
        package_files("rubfric.studies.stability.report"),
        script=script_copy("tabulate_stability.py"),
        batches=[f"{STABILITY}/batches/{batch}.csv" for batch in BATCHES],
    output:
        table=report(
            f"{RESULTS}/stability/stability.csv",
            caption="../report/stability_table.rst",
            category=REPORT.stability,
            subcategory="tables",
            labels={"table": "every case"},
        ),
        page=f"{RESULTS}/stability/stability.md",
    log:
        f"{RESULTS}/logs/stability/table.log",
    localrule: True
    message:
        "Stability: {output.page}"
    run:
        jobs.run(
            input.script,
            log[0],
            table=output.table,
            page=output.page,
            batches=list(input.batches),
        )


rule stability_figure:
    input:
        package_files("rubfric.figures.stability"),
        script=script_copy("draw_table_figure.py"),
        table=rules.stability_table.output.table,
    output:
        **pictures(
            "stability",
            "../report/stability.rst",
            "what becomes of every case",
            REPORT.stability,
        ),
    log:
        f"{RESULTS}/logs/figures/stability.log",
    localrule: True
    message:
        "Drawing the map of stability"
    run:
        jobs.run(
            input.script,
            log[0],
            figure="stability",
            table=input.table,
            outputs=list(output),
        )


rule stability:
    input:
        rules.stability_table.output,
        rules.stability_figure.output,
