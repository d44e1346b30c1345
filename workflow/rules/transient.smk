# Press and slide in time, the paper's procedure: a few scenes, for Fig. 5, where the config asks for them.
MARCHES = CAMPAIGN.marches()
MARCH_FILES = [march_file(name) for name in MARCHES]
MARCH_FIGURE = [
    f"{RESULTS}/figures/fig5.{kind}" for kind in ("pdf", "png") if CAMPAIGN.transient
]


rule march:
    input:
        package_files("rubfric.results.march", "rubfric.marching"),
        script=script_copy("march_scene.py"),
    output:
        march_file("{scene}"),
    log:
        f"{RESULTS}/logs/marches/{RUBBER}/{ROAD}/{{scene}}.log",
    priority: 10
    localrule: workflow.remote_exec
    params:
        parameters=lambda wildcards: MARCHES[wildcards.scene].parameters(),
        procedure=CAMPAIGN.procedure(),
        version=rubfric.__version__,
    message:
        "march of {wildcards.scene}"
    run:
        jobs.run(
            input.script,
            log[0],
            output=output[0],
            parameters=params.parameters,
            procedure=params.procedure,
        )


rule marches:
    input:
        MARCH_FILES,


rule march_figure:
    input:
        package_files("rubfric.figures.fig5", "rubfric.figures.temperature"),
        script=script_copy("draw_figure.py"),
        results=MARCH_FILES,
    output:
        **pictures("fig5", "../report/fig5.rst", "friction settling in time"),
    log:
        f"{RESULTS}/logs/figures/fig5.log",
    localrule: True
    params:
        digests=[scene.digest for scene in MARCHES.values()],
        temperature=TEMPERATURE,
    message:
        "Drawing fig5"
    run:
        jobs.run(
            input.script,
            log[0],
            figure="fig5",
            results=list(input.results),
            choice={},
            outputs=list(output),
            digests=params.digests,
            temperature=params.temperature,
        )
