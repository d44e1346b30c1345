# One page to explore the campaign in a browser: the grid's scenes, without the other ratios of the study.
EXPLORED = {
    name: scene for name, scene in SCENES.items() if scene.aspect == CAMPAIGN.aspect
}
# Those of a comparison that its friction is shown beside.
BESIDE = [pair for pair in PAIR_TABLES if pair != (RUBBER, ROAD)]


rule explorer:
    input:
        package_files("rubfric.pages.explorer.data", "rubfric.pages.explorer.page"),
        page_files("explorer"),
        script=script_copy("build_explorer.py"),
        campaign=rules.campaign.output[0],
        table=rules.total_table.output.table,
        whole=WHOLE_COLLECTION,
        pairs=[PAIR_TABLES[pair] for pair in BESIDE],
        scenes=[
            *(scene_file(name) for name in EXPLORED),
            *(whole_file(name) for name in WHOLE),
        ],
    output:
        # The report links to it: browsers show no embedded page of more than 2 MB.
        f"{RESULTS}/explorer.html",
    log:
        f"{RESULTS}/logs/explorer.log",
    localrule: True
    params:
        about={
            "aspect": CAMPAIGN.aspect,
            "road": ROAD,
            "collected": [COLLECTED, WHOLE_COLLECTED],
            "digests": [
                scene.digest for scene in [*EXPLORED.values(), *WHOLE.values()]
            ],
            "temperatures": [
                scene.temperature for scene in [*EXPLORED.values(), *WHOLE.values()]
            ],
            "roads": [road_number(name) for name in [*EXPLORED, *WHOLE]],
            "shown": TEMPERATURE,
            "others": [
                (*pair, PAIR_TABLES[pair], COLLECTED_OF[pair]) for pair in BESIDE
            ],
        },
    message:
        "The campaign to explore in a browser: {output}"
    run:
        jobs.run(
            input.script,
            log[0],
            output=output[0],
            campaign=input.campaign,
            table=input.table,
            whole=list(input.whole),
            scenes=list(input.scenes),
            **params.about,
        )
