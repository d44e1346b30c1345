# The paper's figures: name, then the arguments of its draw function. Figs 2 and 4 show the fields of a few scenes.
STUDY = {
    "scales": list(CAMPAIGN.aspect_study.scales),
    "pressures": list(CAMPAIGN.aspect_study.pressures),
    "aspects": list(CAMPAIGN.aspect_study.aspects),
}
CAMPAIGN_FIGURES = {
    "fig1": STUDY,
    "fig3": STUDY,
    "fig6": {"aspect": CAMPAIGN.aspect},
    "fig7": {"aspect": CAMPAIGN.aspect, "pressure": CAMPAIGN.figures.total_pressure},
}
FIELD_FIGURES = ["fig2", "fig4"]
FIGURE_WORDS = {
    "fig1": "friction over speed, by height-to-width ratio",
    "fig2": "strain energy over the height",
    "fig3": "friction over the height-to-width ratio",
    "fig4": "the deformed block",
    "fig6": "friction over speed and pressure",
    "fig7": "friction of the whole road",
}
RIG_FIGURES = ["fig8", "fig9"]
FIGURES = [
    f"{RESULTS}/figures/{figure}.{kind}"
    for figure in sorted([*CAMPAIGN_FIGURES, *FIELD_FIGURES, *RIG_FIGURES])
    for kind in ("pdf", "png")
]


rule campaign_figure:
    input:
        lambda wildcards: package_files(f"rubfric.figures.{wildcards.figure}"),
        script="workflow/scripts/draw_figure.py",
        results=rules.campaign.output[0],
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
    params:
        choice=lambda wildcards: CAMPAIGN_FIGURES[wildcards.figure],
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
        )


rule field_figure:
    input:
        lambda wildcards: package_files(f"rubfric.figures.{wildcards.figure}"),
        script="workflow/scripts/draw_figure.py",
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
    params:
        digests=[scene.digest for scene in CAMPAIGN.field_scenes().values()],
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
        )


rule figures:
    input:
        scene_files,
        rules.campaign.output,
        FIGURES,
