# The page of each rubber that was fitted to measured moduli, with bands, and the rubber as a config. What scenes need of
# the fit is in their params: planning has made it, as the Snakefile says.
MEASURED = {rubber: one.fitted for (rubber, _), one in PAIRS.items() if one.fitted}
RUBBER_FILES = [
    f"{RESULTS}/rubbers/{rubber}.{kind}"
    for rubber in MEASURED
    for kind in ("yaml", "html")
]


if MEASURED:

    rule rubber_fit:
        input:
            package_files("rubfric.commands.rubber"),
            page_files("rubber"),
            script=script_copy("fit_rubber.py"),
            measurements=lambda wildcards: local(MEASURED[wildcards.rubber].source),
        output:
            f"{RESULTS}/rubbers/{{rubber}}.yaml",
            page=report(
                f"{RESULTS}/rubbers/{{rubber}}.html",
                caption="../report/rubber.rst",
                category=REPORT.fields,
                labels={
                    "data": "the rubber"
                    + (" {rubber}" if COMPARED else "")
                    + ", fitted to its measurements"
                },
            ),
        log:
            f"{RESULTS}/logs/rubbers/{{rubber}}.log",
        wildcard_constraints:
            rubber="|".join(MEASURED),
        localrule: True
        params:
            rubber=lambda wildcards: wildcards.rubber,
            entry=lambda wildcards: {
                name: value
                for name, value in config["rubbers"][wildcards.rubber].items()
                if name not in ("measurements", "uncertainty")
            },
        message:
            "The fit of rubber {wildcards.rubber}: {output.page}"
        run:
            jobs.run(
                input.script,
                log[0],
                output=output[0],
                rubber=params.rubber,
                entry={**params.entry, "measurements": input.measurements},
            )
