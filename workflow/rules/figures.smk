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
        pdf=f"{RESULTS}/figures/{{figure}}.pdf",
        png=f"{RESULTS}/figures/{{figure}}.png",
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
        pdf=f"{RESULTS}/figures/{{figure}}.pdf",
        png=f"{RESULTS}/figures/{{figure}}.png",
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
        SCENE_FILES,
        rules.campaign.output,
        FIGURES,
