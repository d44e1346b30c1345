# Tables of the campaign.
TABLES = [
    *(f"{RESULTS}/tables/friction_scale_{scale}.csv" for scale in CAMPAIGN.scales),
    f"{RESULTS}/tables/friction_total.csv",
]


rule scale_table:
    input:
        package_files("rubfric.tables"),
        script="workflow/scripts/tabulate_scale.py",
        campaign=rules.campaign.output[0],
    output:
        f"{RESULTS}/tables/friction_scale_{{scale}}.csv",
    log:
        f"{RESULTS}/logs/tables/friction_scale_{{scale}}.log",
    message:
        "Friction on scale {wildcards.scale}: {output}"
    run:
        jobs.run(
            input.script,
            log[0],
            output=output[0],
            campaign=input.campaign,
            scale=int(wildcards.scale),
        )


rule total_table:
    input:
        package_files("rubfric.tables"),
        script="workflow/scripts/tabulate_total.py",
        campaign=rules.campaign.output[0],
    output:
        f"{RESULTS}/tables/friction_total.csv",
    log:
        f"{RESULTS}/logs/tables/friction_total.log",
    params:
        aspect=CAMPAIGN.aspect,
    message:
        "Friction of all scales: {output}"
    run:
        jobs.run(
            input.script,
            log[0],
            output=output[0],
            campaign=input.campaign,
            aspect=params.aspect,
        )


# Scenes and collection are asked for by name: a file in between that is missing would not be missed.
rule tables:
    input:
        scene_files,
        rules.campaign.output,
        TABLES,
