# The whole road, all scales at once: one job per scene, as for a scale, except that a scene that is refused leaves a file
# that says why, and the campaign goes on. With random phases every draw has a folder of its own.
WHOLE_OF = {pair: one.whole_scenes() for pair, one in PAIRS.items()}
WHOLE = WHOLE_OF[RUBBER, ROAD]
# With them, of this rubber and road, the windows down to longer cutoffs, and the road's sines under the same block.
CUTOFF_SCENES = cutoff_scenes(CAMPAIGN)
# Where a scene of the whole road may not be needed, what decides; and the files of the package behind it.
CHOOSING = {
    pair: ["rubfric.results.whole_road"] if one.multiscale.way == "auto" else []
    for pair, one in PAIRS.items()
}
WHOLE_CODE = {
    pair: package_files("rubfric.simulation", *CHOOSING[pair]) for pair in PAIRS
}
# The parameters of the whole road at each temperature.
ROADS_OF = {
    pair: {
        temperature: campaign.whole_parameters()
        for temperature, campaign in one.by_temperature.items()
    }
    for pair, one in PAIRS.items()
}
ROADS = ROADS_OF[RUBBER, ROAD]
# Other scenes, another name, as for the collection of the scales.
WHOLE_MARK = (
    f"{RESULTS}/collected_whole/{fingerprint(scene.digest for scene in WHOLE.values())}"
)
# The collection of them, and its mark; none where the total does without.
WHOLE_COLLECTION = [f"{RESULTS}/whole.nc", WHOLE_MARK] if WHOLE else []
# Paths of the results of every road, and their digests; what the collection of these scenes is known by.
WHOLE_DIGESTS_OF = {
    pair: {
        draw: {
            whole_file(name, *pair): scene.digest
            for name, scene in WHOLE_OF[pair].items()
            if name.startswith(f"{draw}all_")
        }
        for draw in one.whole_roads
    }
    for pair, one in PAIRS.items()
}
WHOLE_DIGESTS = WHOLE_DIGESTS_OF[RUBBER, ROAD]
WHOLE_COLLECTED = whole_fingerprint(WHOLE_DIGESTS)


rule whole_scene:
    input:
        lambda wildcards: WHOLE_CODE[wildcards.rubber, wildcards.road],
        script=script_copy("simulate_whole.py"),
    output:
        whole_file("{whole}", "{rubber}", "{road}"),
    log:
        f"{RESULTS}/logs/whole/{{rubber}}/{{road}}/{{whole}}.log",
    priority: 5
    localrule: workflow.remote_exec
    params:
        parameters=lambda wildcards: (
            WHOLE_OF[wildcards.rubber, wildcards.road] | CUTOFF_SCENES
        )[wildcards.whole].parameters(),
        road=lambda wildcards: choosing(
            wildcards.rubber, wildcards.road, wildcards.whole
        ),
        version=rubfric.__version__,
    message:
        f"{{wildcards.whole}}{OF_PAIR}"
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
        [whole_file(name, *pair) for pair in PAIRS for name in WHOLE_OF[pair]],
        WHOLE_COLLECTION,
