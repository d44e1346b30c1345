# Friction of rubber on rough roads: the workflow itself is workflow/Snakefile.
#   snakemake -j2                                       the paper
#   snakemake -j2 --configfile config/minimal.yaml      a campaign of under a minute
#   snakemake -j2 --configfile mine.yaml                the grid of your own rubber and road alone
include: "workflow/Snakefile"


# Snakemake ignores the default target of an included file.
workflow.default_target = workflow.default_target or rules.all.rule.name
