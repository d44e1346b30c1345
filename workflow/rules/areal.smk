# Scenes on areal roads, over the grid of speeds and pressures, and a figure of each road.
AREAL = CAMPAIGN.areal_scenes()


# What a figure shows: of a road at one temperature every scene, by its name.
AREAL_SHOWN = {
    road: {
        name: scene
        for name, scene in AREAL.items()
        if name.startswith(f"{road}/") and scene.temperature == TEMPERATURE
    }
    for road in CAMPAIGN.areal
}
AREAL_FIGURES = [
    f"{RESULTS}/figures/areal_{road}.{kind}"
    for road in CAMPAIGN.areal
    for kind in ("pdf", "png")
]
AREAL_FILES = [*map(areal_file, AREAL), *AREAL_FIGURES]


if AREAL:

    rule areal_scene:
        input:
            package_files("rubfric.areal_simulation"),
            script=script_copy("simulate_areal.py"),
        output:
            areal_file("{areal}"),
        log:
            f"{RESULTS}/logs/areal/{RUBBER}/{{areal}}.log",
        wildcard_constraints:
            areal=r"[A-Za-z0-9_-]+/areal_v[^/]+",
        priority: 5
        localrule: workflow.remote_exec
        params:
            parameters=lambda wildcards: AREAL[wildcards.areal].parameters(),
            version=rubfric.__version__,
        message:
            "{wildcards.areal}"
        run:
            jobs.run(
                input.script, log[0], output=output[0], parameters=params.parameters
            )

    rule areal_figure:
        input:
            package_files("rubfric.figures.areal"),
            script=script_copy("draw_areal.py"),
            results=lambda wildcards: [
                areal_file(name) for name in AREAL_SHOWN[wildcards.road]
            ],
        output:
            **pictures(
                "areal_{road}",
                "../report/areal_figure.rst",
                lambda wildcards: f"contact on the areal road {wildcards.road}, slow and fast, light and heavy",
            ),
        log:
            f"{RESULTS}/logs/figures/areal_{{road}}.log",
        wildcard_constraints:
            road="|".join(CAMPAIGN.areal),
        localrule: True
        params:
            digests=lambda wildcards: [
                scene.digest for scene in AREAL_SHOWN[wildcards.road].values()
            ],
        message:
            "Drawing the areal road {wildcards.road}"
        run:
            jobs.run(
                input.script,
                log[0],
                results=list(input.results),
                digests=params.digests,
                outputs=list(output),
            )
