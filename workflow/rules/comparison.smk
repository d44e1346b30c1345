# Several rubbers on several roads: the friction of every pair, which of two grips more, and a figure of them. A pair has a
# table of its own, so that a further rubber or road runs its own scenes and the comparison alone.
PAIR_TABLES = {
    pair: f"{RESULTS}/totals/{'/'.join(pair)}/friction_total.csv"
    for pair in PAIRS
    if COMPARED
}
COMPARISON = {
    f"{table}{kind}": f"{RESULTS}/tables/{table}.{kind}"
    for table in ("comparison", "ranking")
    for kind in ("csv", "html")
    if COMPARED
}
# What the scenes of a pair are known by, one by one, and together.
DIGESTS_OF = {
    pair: {scene_file(name, *pair): scene.digest for name, scene in scenes.items()}
    for pair, scenes in SCENES_OF.items()
}
COLLECTED_OF = {
    pair: fingerprint(
        [*sorted(DIGESTS_OF[pair].values()), whole_fingerprint(WHOLE_DIGESTS_OF[pair])]
    )
    for pair in PAIR_TABLES
}
COMPARISON_MARK = f"{RESULTS}/collected_pairs/{fingerprint(COLLECTED_OF.values())}"


if COMPARED:

    rule pair_table:
        input:
            package_files(
                "rubfric.results.pair",
                "rubfric.results.draws",
                "rubfric.results.totals",
            ),
            script=script_copy("tabulate_pair.py"),
            scenes=lambda wildcards: pair_files(wildcards.rubber, wildcards.road),
        output:
            f"{RESULTS}/totals/{{rubber}}/{{road}}/friction_total.csv",
        log:
            f"{RESULTS}/logs/totals/{{rubber}}/{{road}}.log",
        localrule: True
        params:
            scenes=lambda wildcards: DIGESTS_OF[wildcards.rubber, wildcards.road],
            whole=lambda wildcards: WHOLE_DIGESTS_OF[wildcards.rubber, wildcards.road],
            roads=lambda wildcards: ROADS_OF[wildcards.rubber, wildcards.road],
            collected=lambda wildcards: COLLECTED_OF[wildcards.rubber, wildcards.road],
        message:
            "Friction of {wildcards.rubber} on {wildcards.road}: {output}"
        run:
            jobs.run(input.script, log[0], output=output[0], **dict(params.items()))

    rule comparison_table:
        input:
            package_files(
                "rubfric.results.comparison",
                "rubfric.results.pair",
                "rubfric.pages.table",
            ),
            page_files("table"),
            script=script_copy("tabulate_comparison.py"),
            pairs=[*PAIR_TABLES.values()],
        output:
            **{
                name: report(
                    path,
                    caption="../report/comparison_table.rst",
                    category=REPORT.answers,
                    labels=lambda wildcards, output, name=name: {
                        "answer": (
                            f"which grips more: {told_apart(output.rankingcsv)}"
                            if name.startswith("ranking")
                            else "friction of every rubber on every road"
                        ),
                        "as": "page" if name.endswith("html") else "spreadsheet (CSV)",
                    },
                )
                for name, path in COMPARISON.items()
            },
            # Other scenes, another name, as for the collection of the scenes.
            mark=COMPARISON_MARK,
        log:
            f"{RESULTS}/logs/tables/comparison.log",
        localrule: True
        params:
            pairs=[
                (
                    *pair,
                    PAIR_TABLES[pair],
                    COLLECTED_OF[pair],
                    not_covered(PAIRS[pair]),
                )
                for pair in PAIR_TABLES
            ],
        message:
            "Which grips more: {output.rankinghtml}"
        run:
            jobs.run(
                input.script,
                log[0],
                outputs=COMPARISON,
                pairs=params.pairs,
                mark=output.mark,
            )

    rule comparison_figure:
        input:
            package_files("rubfric.figures.fig13", "rubfric.figures.temperature"),
            script=script_copy("draw_comparison.py"),
            comparison=COMPARISON["comparisoncsv"],
            ranking=COMPARISON["rankingcsv"],
        output:
            **pictures(
                "fig13", "../report/comparison_figure.rst", FIGURE_WORDS["fig13"]
            ),
        log:
            f"{RESULTS}/logs/figures/fig13.log",
        localrule: True
        params:
            pressures=TOTAL_FIGURES["fig10"]["pressures"],
            temperature=TEMPERATURE,
        message:
            "Drawing fig13"
        run:
            jobs.run(
                input.script,
                log[0],
                comparison=input.comparison,
                ranking=input.ranking,
                pressures=params.pressures,
                temperature=params.temperature,
                outputs=list(output),
            )


# All that is asked for of a comparison, the scenes in between by name; nothing for one rubber on one road.
COMPARISON_FILES = [
    *(path for pair in PAIR_TABLES for path in pair_files(*pair)),
    *(*PAIR_TABLES.values(), *COMPARISON.values()),
    *([COMPARISON_MARK] if COMPARED else []),
]


rule comparison:
    input:
        COMPARISON_FILES,
        [path for path in FIGURES if os.path.basename(path).startswith("fig13.")],
