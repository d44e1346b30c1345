# The page of a road whose profile was measured, and the road as a config of sines. What scenes need of the profile is in
# their params: planning has read it, as the Snakefile says.
PROFILED = config["roads"][ROAD] if CAMPAIGN.survey else {}
ROAD_FILES = [f"{RESULTS}/roads/{ROAD}.{kind}" for kind in ("yaml", "html") if PROFILED]


if PROFILED:

    rule road_read:
        input:
            package_files("rubfric.road_commands"),
            page_files("road"),
            script=script_copy("read_road.py"),
            profile=local(CAMPAIGN.survey.source),
        output:
            ROAD_FILES[0],
            page=report(
                ROAD_FILES[1],
                caption="../report/road.rst",
                category=REPORT.fields,
                labels={"data": "the road, from its measured profile"},
            ),
        log:
            f"{RESULTS}/logs/roads/{ROAD}.log",
        localrule: True
        params:
            road=ROAD,
            entry={name: value for name, value in PROFILED.items() if name != "profile"},
        message:
            f"The profile of road {ROAD}: {ROAD_FILES[1]}"
        run:
            jobs.run(
                input.script,
                log[0],
                output=output[0],
                road=params.road,
                entry={**params.entry, "profile": input.profile},
            )
