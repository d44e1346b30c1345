# Friction of rubber on rough roads: every scene, table and figure of the campaign in config/config.yaml.
#   snakemake -j2                                       the paper
#   snakemake -j2 --configfile config/minimal.yaml      a campaign of under a minute
import sys

from snakemake.utils import min_version

from rubfric.files import check_folder, check_place, remove_parts
from rubfric.config.campaign import Campaign
from rubfric.config.overlay import read_yaml
from rubfric.errors import BrokenResult, InvalidInput, NotWritten
from rubfric.runner.reruns import check_records
from rubfric.rig.files import rig_files

min_version("9.0")


configfile: "config/config.yaml"


report: "workflow/report/workflow.rst"


# A wrong config is refused in one sentence. Snakemake has read the files already, but not whether a key is there twice.
try:
    if workflow.is_main_process:
        for path in workflow.configfiles:
            read_yaml(path)
    CAMPAIGN = Campaign.from_config(config)
    RIG_FILES = rig_files(CAMPAIGN.rig)
except InvalidInput as error:
    sys.exit(f"The config is wrong: {error}.")
try:
    check_folder(".snakemake")  # where Snakemake keeps its memory
    check_place(CAMPAIGN.results)
    check_records(".snakemake/metadata")
except (NotWritten, BrokenResult) as error:
    sys.exit(f"No results can be made: {error}.")


include: "workflow/rules/common.smk"
include: "workflow/rules/scenes.smk"
include: "workflow/rules/whole.smk"
include: "workflow/rules/tables.smk"
include: "workflow/rules/figures.smk"
include: "workflow/rules/transient.smk"
include: "workflow/rules/rig.smk"
include: "workflow/rules/claims.smk"
include: "workflow/rules/explorer.smk"
include: "workflow/rules/accuracy.smk"
include: "workflow/rules/stability.smk"


rule all:
    default_target: True
    input:
        scene_files,
        rules.campaign.output,
        whole_files,
        WHOLE_COLLECTION,
        MARCH_FILES,
        TABLES,
        RIG_TABLES,
        FIGURES,
        rules.march_figure.output,
        rules.claims.output,
        rules.explorer.output,


# For the report, which runs nothing: the campaign, and what there is of accuracy and stability.
rule everything:
    input:
        rules.all.input,
        [
            path
            for path in [*rules.accuracy.input, *rules.stability.input]
            if os.path.exists(path)
        ],


if workflow.is_main_process:
    RUN_LOG = follow(workflow)


onstart:
    jobs.warm_up()
    check_folder(RESULTS)
    remove_parts(RESULTS)
    RUN_LOG.begin()


onsuccess:
    RUN_LOG.succeed()


onerror:
    RUN_LOG.fail()
