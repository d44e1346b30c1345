# The figures: name, then the arguments of its draw function. Figs 2 and 4 show the fields of a few scenes.
STUDY = CAMPAIGN.aspect_study and {
    "scales": list(CAMPAIGN.aspect_study.scales),
    "pressures": list(CAMPAIGN.aspect_study.pressures),
    "aspects": list(CAMPAIGN.aspect_study.aspects),
}
CAMPAIGN_FIGURES = {
    **({"fig1": STUDY, "fig3": STUDY} if STUDY else {}),
    "fig6": {"aspect": CAMPAIGN.aspect, "micro": bool(CAMPAIGN.claims)},
}
FIELD_FIGURES = ["fig2", "fig4"]
# The whole road: its friction, from the table of totals; and the block on it, light and heavy, slow to fast.
SHOWN = CAMPAIGN.figures.fields
TOTAL_FIGURES = {
    "fig7": {"aspect": CAMPAIGN.aspect, "pressure": CAMPAIGN.figures.total_pressure},
    "fig10": {
        "pressures": sorted({min(SHOWN.pressures), CAMPAIGN.figures.total_pressure})
    },
}
# And one of all temperatures, where there are several.
if len(CAMPAIGN.temperatures) > 1:
    TOTAL_FIGURES["fig12"] = {
        "pressure": CAMPAIGN.figures.total_pressure,
        "factors": {
            one: (CAMPAIGN.shift.factor(one), CAMPAIGN.shift.modulus_factor(one))
            for one in CAMPAIGN.temperatures
        },
        "reference": CAMPAIGN.shift.reference_temperature,
    }
WHOLE_FIGURES = ["fig11"] if WHOLE else []


# Three fast speeds at two light loads, where all scales at once are solved in seconds; of random roads the first. Windows
# of a measured road are solved in seconds anywhere: there the slowest and the fastest, at the lightest and the heaviest.
DRAW = next(iter(CAMPAIGN.whole_roads), "")
DRAWS = len(CAMPAIGN.whole_roads) if DRAW else 0
WINDOWS = DRAW.startswith("window")
DRAWN_KIND = "windows" if WINDOWS else "random roads"


SHOWN_WHOLE = {
    name: scene
    for name, scene in WHOLE.items()
    if name == f"{DRAW}{scene.name}"
    and scene.temperature == TEMPERATURE
    and scene.pressure
    in (extremes(SHOWN.pressures) if WINDOWS else sorted(SHOWN.pressures)[:2])
    and scene.velocity
    in (extremes(SHOWN.velocities) if WINDOWS else sorted(SHOWN.velocities)[-3:])
}
# Made before Snakemake looks for them: of files that appear while it does it would know nothing.
DRAWN_BY = {
    figure: package_files(f"rubfric.figures.{figure}", "rubfric.figures.temperature")
    for figure in [*CAMPAIGN_FIGURES, *FIELD_FIGURES, *TOTAL_FIGURES, "fig11"]
}
FIGURE_WORDS = {
    "fig1": "friction over speed, by height-to-width ratio",
    "fig2": "strain energy over the height",
    "fig3": "friction over the height-to-width ratio",
    "fig4": "the deformed block",
    "fig6": "friction over speed and pressure",
    "fig7": "friction of the whole road",
    "fig10": "five ways to the friction of the whole road",
    "fig11": "the block on the whole road",
    "fig12": "friction over speed and temperature",
    "fig13": "friction of every rubber on every road",
}
RIG_FIGURES = ["fig8", "fig9"] if CAMPAIGN.rig else []
COMPARISON_FIGURES = ["fig13"] if COMPARED else []
FIGURES = [
    f"{RESULTS}/figures/{figure}.{kind}"
    for figure in sorted(
        [
            *(*CAMPAIGN_FIGURES, *FIELD_FIGURES, *RIG_FIGURES),
            *(*TOTAL_FIGURES, *WHOLE_FIGURES, *COMPARISON_FIGURES),
        ]
    )
    for kind in ("pdf", "png")
]


rule campaign_figure:
    input:
        lambda wildcards: DRAWN_BY[wildcards.figure],
        script=script_copy("draw_figure.py"),
        results=rules.campaign.output[0],
        curves=lambda wildcards: DRAWN_CURVES if wildcards.figure == "fig6" else [],
    output:
        **pictures(
            "{figure}",
            "../report/campaign_figure.rst",
            lambda wildcards: FIGURE_WORDS[wildcards.figure],
        ),
    log:
        f"{RESULTS}/logs/figures/{{figure}}.log",
    wildcard_constraints:
        figure="|".join(CAMPAIGN_FIGURES),
    localrule: True
    params:
        choice=lambda wildcards: CAMPAIGN_FIGURES[wildcards.figure],
        digests=[COLLECTED],
        temperature=TEMPERATURE,
    message:
        "Drawing {wildcards.figure}"
    run:
        jobs.run(
            input.script,
            log[0],
            figure=wildcards.figure,
            results=input.results,
            choice=params.choice,
            outputs=list(output),
            digests=params.digests,
            temperature=params.temperature,
            curves=str(input.curves) or None,
        )


rule field_figure:
    input:
        lambda wildcards: DRAWN_BY[wildcards.figure],
        script=script_copy("draw_figure.py"),
        results=[scene_file(name) for name in CAMPAIGN.field_scenes()],
    output:
        **pictures(
            "{figure}",
            "../report/field_figure.rst",
            lambda wildcards: FIGURE_WORDS[wildcards.figure],
        ),
    log:
        f"{RESULTS}/logs/figures/{{figure}}.log",
    wildcard_constraints:
        figure="|".join(FIELD_FIGURES),
    localrule: True
    params:
        digests=[scene.digest for scene in CAMPAIGN.field_scenes().values()],
        temperature=TEMPERATURE,
    message:
        "Drawing {wildcards.figure}"
    run:
        jobs.run(
            input.script,
            log[0],
            figure=wildcards.figure,
            results=list(input.results),
            choice={},
            outputs=list(output),
            digests=params.digests,
            temperature=params.temperature,
        )


rule total_figure:
    input:
        lambda wildcards: DRAWN_BY[wildcards.figure],
        script=script_copy("draw_total.py"),
        table=rules.total_table.output.table,
        campaign=rules.campaign.output[0],
        added=lambda wildcards: (
            ADDED_TO["whole road"] if wildcards.figure == "fig7" else []
        ),
    output:
        **pictures(
            "{figure}",
            "../report/total_figure.rst",
            lambda wildcards: FIGURE_WORDS[wildcards.figure],
        ),
    log:
        f"{RESULTS}/logs/figures/{{figure}}.log",
    wildcard_constraints:
        figure="|".join(TOTAL_FIGURES),
    localrule: True
    params:
        choice=lambda wildcards: TOTAL_FIGURES[wildcards.figure],
        collected=COLLECTED,
        temperature=lambda wildcards: (
            None if wildcards.figure == "fig12" else TEMPERATURE
        ),
    message:
        "Drawing {wildcards.figure}"
    run:
        jobs.run(
            input.script,
            log[0],
            figure=wildcards.figure,
            table=input.table,
            campaign=input.campaign,
            collected=params.collected,
            choice=params.choice,
            temperature=params.temperature,
            outputs=list(output),
            added=list(input.added),
        )


rule whole_figure:
    input:
        DRAWN_BY["fig11"],
        script=script_copy("draw_whole.py"),
        results=[whole_file(name) for name in SHOWN_WHOLE],
    output:
        **pictures(
            "fig11",
            "../report/whole_figure.rst",
            lambda _: FIGURE_WORDS["fig11"]
            + (f", first of {DRAWS} {DRAWN_KIND}" if DRAWS else ""),
        ),
    log:
        f"{RESULTS}/logs/figures/fig11.log",
    localrule: True
    params:
        digests=[scene.digest for scene in SHOWN_WHOLE.values()],
        draws=DRAWS,
        temperature=TEMPERATURE,
    message:
        "Drawing fig11"
    run:
        jobs.run(
            input.script,
            log[0],
            results=list(input.results),
            outputs=list(output),
            digests=params.digests,
            draws=params.draws,
            temperature=params.temperature,
            windows=WINDOWS,
        )


rule figures:
    input:
        scene_files,
        rules.campaign.output,
        FIGURES,
