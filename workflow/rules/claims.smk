# The paper's claims, judged by the campaign where the config asks for it; and other readings of what the paper leaves
# open, in batches of one scale and speed, so that a new speed runs its own scenes only. Each has the whole road too, the
# first of random ones, as one scale more.
JUDGE = CAMPAIGN.claims
READINGS = {name: AT_ONE.reading(name) for name in (JUDGE.compare if JUDGE else ())}
OBSERVED = {
    name: batches_by_speed(reading.scenes() | whole_once(reading))
    for name, reading in READINGS.items()
}
CLAIMS = {
    "claims": f"{RESULTS}/tables/claims.csv",
    "evidence": f"{RESULTS}/tables/claims_evidence.csv",
    "page": f"{RESULTS}/claims.html",
}
JUDGED_AT = (
    f" Of {len(CAMPAIGN.temperatures)} temperatures, claims are judged at {TEMPERATURE:g} degC."
    if len(CAMPAIGN.temperatures) > 1
    else ""
)
CLAIM_FILES = [*CLAIMS.values()] if JUDGE else []
JUDGED = {
    "campaign": f"{RESULTS}/campaign.nc",
    "totals": f"{RESULTS}/tables/friction_total.csv",
    "profiles": [scene_file(name) for name in CAMPAIGN.field_scenes()],
    "marches": MARCH_FILES,
    "points": RIG_TABLES[:1],
    "readings": {
        name: [reading_file(name, batch) for batch in OBSERVED[name]]
        for name in OBSERVED
    },
}


if JUDGE:

    rule reading:
        input:
            package_files("rubfric.studies.paper.observation"),
            script=script_copy("observe_scenes.py"),
        output:
            f"{RESULTS}/readings/{{reading}}/{RUBBER}/{ROAD}/{{batch}}.csv",
        log:
            f"{RESULTS}/logs/readings/{{reading}}/{RUBBER}/{ROAD}/{{batch}}.log",
        wildcard_constraints:
            reading=r"[A-Za-z0-9_-]+",
            batch=r"(scale\d+|all)_v[0-9.e-]+",
        localrule: workflow.remote_exec
        params:
            scenes=lambda wildcards: {
                name: scene.parameters()
                for name, scene in OBSERVED[wildcards.reading][wildcards.batch].items()
            },
            version=rubfric.__version__,
        message:
            "Reading {wildcards.reading}: {wildcards.batch}"
        run:
            jobs.run(input.script, log[0], output=output[0], scenes=params.scenes)

    rule claims:
        input:
            package_files("rubfric.pages.claims", "rubfric.studies.paper.judge"),
            page_files("claims"),
            script=script_copy("judge_claims.py"),
            results=[
                *(JUDGED["campaign"], *JUDGED["profiles"], *JUDGED["marches"]),
                *(JUDGED["totals"], *JUDGED["points"]),
                *(path for paths in JUDGED["readings"].values() for path in paths),
            ],
        output:
            claims=report(
                CLAIMS["claims"],
                caption="../report/claims.rst",
                category=REPORT.answers,
                labels=lambda wildcards, output: {
                    "answer": f"claims of the paper: {verdicts(output.claims)}",
                    "as": "spreadsheet (CSV)",
                },
            ),
            evidence=CLAIMS["evidence"],
            page=report(
                CLAIMS["page"],
                caption="../report/claims.rst",
                category=REPORT.answers,
                labels=lambda wildcards, output: {
                    "answer": f"claims of the paper: {verdicts(output.claims)}",
                    "as": "page",
                },
            ),
        log:
            f"{RESULTS}/logs/claims.log",
        localrule: True
        params:
            digests={
                "campaign": COLLECTED,
                "profiles": [
                    scene.digest for scene in CAMPAIGN.field_scenes().values()
                ],
                "marches": [scene.digest for scene in MARCHES.values()],
                "readings": {
                    name: [
                        scene.digest
                        for batch in parts.values()
                        for scene in batch.values()
                    ]
                    for name, parts in OBSERVED.items()
                },
            },
            criteria=criteria(CAMPAIGN),
            temperature=TEMPERATURE,
            figures=sorted(
                os.path.basename(path).removesuffix(".png")
                for path in [*FIGURES, *MARCH_FIGURE]
                if path.endswith(".png")
            ),
            roads={
                name: reading.whole_parameters() for name, reading in READINGS.items()
            },
            about={
                AS_CONFIGURED: AT_ONE.words() + JUDGED_AT,
                **{name: reading.words() for name, reading in READINGS.items()},
            },
        message:
            "Judging the paper's claims: {output.page}"
        run:
            jobs.run(
                input.script,
                log[0],
                outputs=CLAIMS,
                **JUDGED,
                **dict(params.items()),
            )
