# The page of a rubber that was fitted to measured moduli, with bands, and the rubber as a config. What scenes need of the
# fit is in their params: planning has made it, as the Snakefile says.
MEASURED = config["rubbers"][RUBBER] if CAMPAIGN.fitted else {}
RUBBER_FILES = [
    f"{RESULTS}/rubbers/{RUBBER}.{kind}" for kind in ("yaml", "html") if MEASURED
]


if MEASURED:

    rule rubber_fit:
        input:
            package_files("rubfric.rubber_commands"),
            page_files("rubber"),
            script=script_copy("fit_rubber.py"),
            measurements=local(CAMPAIGN.fitted.source),
        output:
            RUBBER_FILES[0],
            page=report(
                RUBBER_FILES[1],
                caption="../report/rubber.rst",
                category=REPORT.fields,
                labels={"data": "the rubber, fitted to its measurements"},
            ),
        log:
            f"{RESULTS}/logs/rubbers/{RUBBER}.log",
        localrule: True
        params:
            rubber=RUBBER,
            entry={
                name: value
                for name, value in MEASURED.items()
                if name not in ("measurements", "uncertainty")
            },
        message:
            f"The fit of rubber {RUBBER}: {RUBBER_FILES[1]}"
        run:
            jobs.run(
                input.script,
                log[0],
                output=output[0],
                rubber=params.rubber,
                entry={**params.entry, "measurements": input.measurements},
            )
