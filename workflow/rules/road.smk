# The page of each road whose profile was measured, and the road as a config of sines. What scenes need of the profile is
# in their params: planning has read it, as the Snakefile says.
PROFILED = {road: one.survey for (_, road), one in PAIRS.items() if one.survey}
ROAD_FILES = [
    f"{RESULTS}/roads/{road}.{kind}" for road in PROFILED for kind in ("yaml", "html")
]


if PROFILED:

    rule road_read:
        input:
            package_files("rubfric.commands.road"),
            page_files("road"),
            script=script_copy("read_road.py"),
            profile=lambda wildcards: local(PROFILED[wildcards.road].source),
        output:
            f"{RESULTS}/roads/{{road}}.yaml",
            page=report(
                f"{RESULTS}/roads/{{road}}.html",
                caption="../report/road.rst",
                category=REPORT.fields,
                labels={
                    "data": "the road"
                    + (" {road}" if COMPARED else "")
                    + ", from its measured profile"
                },
            ),
        log:
            f"{RESULTS}/logs/roads/{{road}}.log",
        wildcard_constraints:
            road="|".join(PROFILED),
        localrule: True
        params:
            road=lambda wildcards: wildcards.road,
            entry=lambda wildcards: {
                name: value
                for name, value in config["roads"][wildcards.road].items()
                if name != "profile"
            },
        message:
            "The profile of road {wildcards.road}: {output.page}"
        run:
            jobs.run(
                input.script,
                log[0],
                output=output[0],
                road=params.road,
                entry={**params.entry, "profile": input.profile},
            )
