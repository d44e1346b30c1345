# Scenes on areal roads over the grid of speeds and pressures, what the plane model makes of their profiles, and of each
# road a table, a page and a figure.
AREAL = CAMPAIGN.areal_scenes()
# How the scans among the roads are read. Planning has read them: params have digests of their heights.
SCANS = CAMPAIGN.areal_scans()


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
AREAL_COMPARED = {road: f"{RESULTS}/tables/areal_{road}.csv" for road in CAMPAIGN.areal}
AREAL_TABLES = [
    *AREAL_COMPARED.values(),
    *(path.removesuffix("csv") + "html" for path in AREAL_COMPARED.values()),
]
AREAL_FILES = [*map(areal_file, AREAL), *AREAL_TABLES, *AREAL_FIGURES]
# How many of a road's profiles the plane model slides over.
AREAL_PROFILES = {road: CAMPAIGN.areal_roads[road].profiles for road in CAMPAIGN.areal}


if AREAL:

    rule areal_scene:
        input:
            lambda wildcards: package_files(
                "rubfric.areal_simulation",
                *(["rubfric.road.areal_scan"] if of_scan(wildcards.areal) else []),
            ),
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
                input.script,
                log[0],
                output=output[0],
                parameters=params.parameters,
                scan=of_scan(wildcards.areal),
            )

    rule areal_profiles:
        input:
            lambda wildcards: package_files(
                "rubfric.areal_plane",
                *(["rubfric.road.areal_scan"] if of_scan(wildcards.areal) else []),
            ),
            script=script_copy("slide_profiles.py"),
        output:
            profiles_file("{areal}"),
        log:
            f"{RESULTS}/logs/areal_profiles/{RUBBER}/{{areal}}.log",
        wildcard_constraints:
            areal=r"[A-Za-z0-9_-]+/areal_v[^/]+",
        localrule: workflow.remote_exec
        params:
            parameters=lambda wildcards: AREAL[wildcards.areal].parameters(),
            profiles=lambda wildcards: AREAL_PROFILES[wildcards.areal.split("/")[0]],
            version=rubfric.__version__,
        message:
            "profiles of {wildcards.areal}"
        run:
            jobs.run(
                input.script,
                log[0],
                output=output[0],
                parameters=params.parameters,
                profiles=params.profiles,
                scan=of_scan(wildcards.areal),
            )

    rule areal_table:
        input:
            package_files("rubfric.pages.areal", "rubfric.results.tables"),
            page_files("areal"),
            script=script_copy("tabulate_areal.py"),
            results=lambda wildcards: [
                areal_file(name) for name in AREAL_SHOWN[wildcards.road]
            ],
            profiles=lambda wildcards: [
                profiles_file(name) for name in shown_profiles(wildcards.road)
            ],
        output:
            table=report(
                f"{RESULTS}/tables/areal_{{road}}.csv",
                caption="../report/areal_table.rst",
                category=REPORT.tables,
                subcategory="areal roads",
                labels={"table": "areal road {road}", "as": "spreadsheet (CSV)"},
            ),
            page=report(
                f"{RESULTS}/tables/areal_{{road}}.html",
                caption="../report/areal_table.rst",
                category=REPORT.tables,
                subcategory="areal roads",
                labels={"table": "areal road {road}", "as": "page with contact maps"},
            ),
        log:
            f"{RESULTS}/logs/tables/areal_{{road}}.log",
        wildcard_constraints:
            road="|".join(CAMPAIGN.areal),
        localrule: True
        params:
            digests=lambda wildcards: [
                scene.digest for scene in AREAL_SHOWN[wildcards.road].values()
            ],
            profiles=lambda wildcards: [*shown_profiles(wildcards.road).values()],
        message:
            "Friction on the areal road {wildcards.road}: {output.table}"
        run:
            jobs.run(
                input.script,
                log[0],
                output=output.table,
                page=output.page,
                road=wildcards.road,
                results=dict(zip(input.results, params.digests)),
                profiles=dict(zip(input.profiles, params.profiles)),
            )

    rule areal_figure:
        input:
            package_files("rubfric.figures.areal"),
            script=script_copy("draw_areal.py"),
            table=rules.areal_table.output.table,
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
                table=input.table,
                outputs=list(output),
            )
