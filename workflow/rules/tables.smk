# Tables of the campaign.
TITLE = f"Friction of rubber {RUBBER} on road {ROAD}"
TABLES = [
    *(f"{RESULTS}/tables/friction_scale_{scale}.csv" for scale in CAMPAIGN.scales),
    f"{RESULTS}/tables/friction_total.csv",
]


rule scale_table:
    input:
        package_files("rubfric.results.tables", "rubfric.pages.table"),
        page_files("table"),
        script=script_copy("tabulate_scale.py"),
        campaign=rules.campaign.output[0],
    output:
        table=report(
            f"{RESULTS}/tables/friction_scale_{{scale}}.csv",
            caption="../report/scale_table.rst",
            category=REPORT.tables,
            subcategory="each scale",
            labels={"table": "friction on scale {scale}", "as": "spreadsheet (CSV)"},
        ),
        page=report(
            f"{RESULTS}/tables/friction_scale_{{scale}}.html",
            caption="../report/scale_table.rst",
            category=REPORT.tables,
            subcategory="each scale",
            labels={"table": "friction on scale {scale}", "as": "page"},
        ),
    log:
        f"{RESULTS}/logs/tables/friction_scale_{{scale}}.log",
    localrule: True
    params:
        title=TITLE,
        collected=COLLECTED,
    message:
        "Friction on scale {wildcards.scale}: {output.table}"
    run:
        jobs.run(
            input.script,
            log[0],
            output=output.table,
            page=output.page,
            campaign=input.campaign,
            collected=params.collected,
            scale=int(wildcards.scale),
            title=params.title,
        )


rule total_table:
    input:
        package_files(
            "rubfric.results.totals",
            "rubfric.results.areal_table",
            "rubfric.results.tables",
            "rubfric.pages.table",
        ),
        page_files("table"),
        script=script_copy("tabulate_total.py"),
        campaign=rules.campaign.output[0],
        whole=WHOLE_COLLECTION,
        areal=AREAL_COMPARED.values(),
    output:
        table=report(
            f"{RESULTS}/tables/friction_total.csv",
            caption="../report/total_table.rst",
            category=REPORT.answers,
            labels=lambda wildcards, output: {
                "answer": f"friction of the whole road: {highest(output.table)}",
                "as": "spreadsheet (CSV)",
            },
        ),
        page=report(
            f"{RESULTS}/tables/friction_total.html",
            caption="../report/total_table.rst",
            category=REPORT.answers,
            labels=lambda wildcards, output: {
                "answer": f"friction of the whole road: {highest(output.table)}",
                "as": "page",
            },
        ),
    log:
        f"{RESULTS}/logs/tables/friction_total.log",
    localrule: True
    params:
        about={
            "roads": ROADS,
            "title": TITLE,
            "collected": [COLLECTED, WHOLE_COLLECTED],
            "areal": AREAL_COMPARED,
        },
    message:
        "Friction of the whole road: {output.table}"
    run:
        jobs.run(
            input.script,
            log[0],
            output=output.table,
            page=output.page,
            campaign=input.campaign,
            whole=list(input.whole),
            **params.about,
        )


# Scenes and collection are asked for by name: a file in between that is missing would not be missed.
rule tables:
    input:
        scene_files,
        rules.campaign.output,
        whole_files,
        WHOLE_COLLECTION,
        TABLES,
