# The whole road, all scales at once: one job per scene, as for a scale, except that a scene that is refused leaves a file
# that says why, and the campaign goes on. With random phases every draw has a folder of its own.
WHOLE = CAMPAIGN.whole_scenes()
# With them the windows of a measured road down to longer cutoffs, and its sines under the same block.
CUTOFF_SCENES = cutoff_scenes(CAMPAIGN)
# What decides whether a scene of the whole road is needed.
CHOOSING = ["rubfric.results.whole_road"] if CAMPAIGN.multiscale.way == "auto" else []
# The parameters of the whole road at each temperature.
ROADS = {
    temperature: campaign.whole_parameters()
    for temperature, campaign in CAMPAIGN.by_temperature.items()
}
# Other scenes, another name, as for the collection of the scales.
WHOLE_MARK = (
    f"{RESULTS}/collected_whole/{fingerprint(scene.digest for scene in WHOLE.values())}"
)
# The collection of them, and its mark; none where the total does without.
WHOLE_COLLECTION = [f"{RESULTS}/whole.nc", WHOLE_MARK] if WHOLE else []
# Paths of the results of every road, and their digests; what the collection of these scenes is known by.
WHOLE_DIGESTS = {
    draw: {
        whole_file(name): scene.digest
        for name, scene in WHOLE.items()
        if name.startswith(f"{draw}all_")
    }
    for draw in CAMPAIGN.whole_roads
}
WHOLE_COLLECTED = whole_fingerprint(WHOLE_DIGESTS)


rule whole_scene:
    input:
        package_files("rubfric.simulation", *CHOOSING),
        script=script_copy("simulate_whole.py"),
    output:
        whole_file("{whole}"),
    log:
        f"{RESULTS}/logs/whole/{RUBBER}/{ROAD}/{{whole}}.log",
    priority: 5
    localrule: workflow.remote_exec
    params:
        parameters=lambda wildcards: (WHOLE | CUTOFF_SCENES)[
            wildcards.whole
        ].parameters(),
        road=lambda wildcards: (
            ROADS[WHOLE[wildcards.whole].temperature] if CHOOSING else {}
        ),
        version=rubfric.__version__,
    message:
        "{wildcards.whole}"
    run:
        jobs.run(
            input.script,
            log[0],
            output=output[0],
            parameters=params.parameters,
            road=params.road,
        )


rule whole_collection:
    input:
        package_files("rubfric.results.campaign", "rubfric.results.draws"),
        script=script_copy("collect_whole.py"),
        scenes=whole_files,
    output:
        report(
            f"{RESULTS}/whole.nc",
            caption="../report/whole.rst",
            category=REPORT.fields,
            labels={"data": "scalars of every scene of the whole road (netCDF)"},
        ),
        mark=WHOLE_MARK,
    log:
        f"{RESULTS}/logs/whole.log",
    localrule: True
    params:
        scenes=WHOLE_DIGESTS,
    message:
        "Collecting the whole road"
    run:
        jobs.run(
            input.script,
            log[0],
            output=output[0],
            scenes=params.scenes,
            mark=output.mark,
        )


rule whole:
    input:
        whole_files,
        WHOLE_COLLECTION,
