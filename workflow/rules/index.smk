# One page that joins all results: it lists what this config asks for, and is written again after any of it.
def named(words, page="", table="", data=""):
    """Return an entry of the page: words, and files by kind."""
    files = {"page": page, "CSV": table, "netCDF": data}
    return words, {kind: path for kind, path in files.items() if path}


SHOWN_FIGURES = {
    **FIGURE_WORDS,
    "fig5": "friction settling in time",
    "fig8": "the test rig",
    "fig9": "friction on the test rig",
    **ROAD_PICTURES,
    **{f"areal_{road}": f"contact on the areal road {road}" for road in CAMPAIGN.areal},
}
ALL_PICTURES = [
    path
    for path in [*FIGURES, *MARCH_FIGURE, *ROAD_FIGURES, *AREAL_FIGURES]
    if path.endswith(".png")
]
# Those of the paper by number, then the others.
DRAWN = sorted(
    (os.path.basename(path).removesuffix(".png") for path in ALL_PICTURES),
    key=lambda name: (not name.startswith("fig"), len(name), name),
)
IN_GROUPS = {
    "Answers": [
        named(
            "friction to explore, and the deformed blocks", f"{RESULTS}/explorer.html"
        ),
        *(
            [
                named(
                    "which claims of the paper are reproduced",
                    CLAIMS["page"],
                    CLAIMS["claims"],
                )
            ]
            if JUDGE
            else []
        ),
        *(
            [
                named(
                    "which grips more",
                    COMPARISON["rankinghtml"],
                    COMPARISON["rankingcsv"],
                ),
                named(
                    "friction of every rubber on every road",
                    COMPARISON["comparisonhtml"],
                    COMPARISON["comparisoncsv"],
                ),
            ]
            if COMPARED
            else []
        ),
        *(
            [
                named(
                    f"friction of the measured road {ROAD}",
                    ROAD_FRICTION[1],
                    ROAD_FRICTION[0],
                )
            ]
            if ROAD_FRICTION
            else []
        ),
        *(
            named(
                f"contact and friction on the areal road {road}",
                f"{RESULTS}/tables/areal_{road}.html",
                f"{RESULTS}/tables/areal_{road}.csv",
            )
            for road in CAMPAIGN.areal
        ),
        *(
            named(
                f"rubber {rubber}, fitted to its measurements",
                f"{RESULTS}/rubbers/{rubber}.html",
            )
            for rubber in MEASURED
        ),
        *(
            named(
                f"road {road}, from its measured profile",
                f"{RESULTS}/roads/{road}.html",
            )
            for road in PROFILED
        ),
    ],
    "Tables": [
        named(
            "the whole road, by every way",
            f"{RESULTS}/tables/friction_total.html",
            f"{RESULTS}/tables/friction_total.csv",
        ),
        *(
            named(
                f"scale {scale}",
                f"{RESULTS}/tables/friction_scale_{scale}.html",
                f"{RESULTS}/tables/friction_scale_{scale}.csv",
            )
            for scale in CAMPAIGN.scales
        ),
        named(
            "peaks of friction over speed", CURVE_TABLES["page"], CURVE_TABLES["peaks"]
        ),
        named("friction over speed, every point", table=CURVE_TABLES["curves"]),
        *([named("evidence on the claims", table=CLAIMS["evidence"])] if JUDGE else []),
        *(
            named(f"test rig: {what}", table=path)
            for what, path in zip(("points", "rejected windows"), RIG_TABLES)
        ),
    ],
    "Data": [
        named("scalars of every scene", data=f"{RESULTS}/campaign.nc"),
        *(
            [named("scalars of the whole road", data=f"{RESULTS}/whole.nc")]
            if WHOLE
            else []
        ),
    ],
}
# Beside these, what no job makes, or not by default.
NOT_AWAITED = {
    "Logs and other pages": [
        (
            "report: figures and tables with captions",
            {"page": f"{RESULTS}/report.html"},
        ),
        ("log of the runs", {"text": f"{RESULTS}/logs/run.log"}),
        ("a log for each job", {"folder": f"{RESULTS}/logs"}),
        ("fields of every scene", {"folder": f"{RESULTS}/scenes"}),
        ("accuracy: how often the errors cover", {"folder": f"{RESULTS}/accuracy"}),
        ("stability: extreme cases", {"folder": f"{RESULTS}/stability"}),
    ]
}


rule index_page:
    input:
        package_files("rubfric.pages.index", "rubfric.runner.findings"),
        page_files("index"),
        script=script_copy("write_index.py"),
        totals=rules.total_table.output.table,
        linked=[
            *ALL_PICTURES,
            *(path.removesuffix("png") + "pdf" for path in ALL_PICTURES),
            *(
                path
                for linked in IN_GROUPS.values()
                for _, files in linked
                for path in files.values()
            ),
        ],
    output:
        f"{RESULTS}/index.html",
    log:
        f"{RESULTS}/logs/index.log",
    localrule: True
    params:
        about={
            "claims": CLAIMS["claims"] if JUDGE else "",
            "ranking": COMPARISON.get("rankingcsv", ""),
            "title": TITLE,
            "figures": {name: SHOWN_FIGURES[name] for name in DRAWN},
            "groups": {**IN_GROUPS, **NOT_AWAITED},
            "temperature": TEMPERATURE,
        },
        understood=lambda wildcards: understood(CAMPAIGN, OWN_CAMPAIGN),
    message:
        "The page of all results: {output}"
    run:
        jobs.run(
            input.script,
            log[0],
            output=output[0],
            totals=input.totals,
            understood=params.understood,
            **params.about,
        )
