# One job per scene. All that a scene depends on is in its params and in the package files it lists.
SCENES_OF = {pair: one.scenes() for pair, one in PAIRS.items()}
SCENES = SCENES_OF[RUBBER, ROAD]
DIGESTS = [scene.digest for scene in SCENES.values()]
# What the collection of these scenes is known by.
COLLECTED = fingerprint(sorted(DIGESTS))


rule scene:
    input:
        package_files("rubfric.simulation"),
        script=script_copy("simulate_scene.py"),
    output:
        scene_file("{scene}", "{rubber}", "{road}"),
    log:
        f"{RESULTS}/logs/scenes/{{rubber}}/{{road}}/{{scene}}.log",
    priority: 5
    localrule: workflow.remote_exec
    params:
        parameters=lambda wildcards: SCENES_OF[wildcards.rubber, wildcards.road][
            wildcards.scene
        ].parameters(),
        version=rubfric.__version__,
    message:
        f"{{wildcards.scene}}{OF_PAIR}"
    run:
        jobs.run(input.script, log[0], output=output[0], parameters=params.parameters)


rule campaign:
    input:
        package_files("rubfric.results.campaign"),
        script=script_copy("collect_campaign.py"),
        scenes=scene_files,
    output:
        report(
            f"{RESULTS}/campaign.nc",
            caption="../report/campaign.rst",
            category=REPORT.fields,
            labels={"data": "scalars of every scene (netCDF)"},
        ),
        # Other scenes, another name: the collection is checked again even where Snakemake has lost its memory.
        mark=f"{RESULTS}/collected/{fingerprint(DIGESTS)}",
    log:
        f"{RESULTS}/logs/campaign.log",
    localrule: True
    params:
        digests=DIGESTS,
    message:
        "Collecting all scenes"
    run:
        jobs.run(
            input.script,
            log[0],
            output=output[0],
            scenes=list(input.scenes),
            digests=params.digests,
            mark=output.mark,
        )


rule scenes:
    input:
        scene_files,
        [scene_file(name, *pair) for pair in PAIRS for name in SCENES_OF[pair]],
