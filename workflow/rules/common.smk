# What all rules share: paths, the names of rubber and road, and how a job runs.
import hashlib
from dataclasses import asdict

import rubfric
from rubfric import jobs
from rubfric.campaign import load
from rubfric.sources import stamp
from rubfric.trials import batches, drawn_scenes, fixed_scenes

RESULTS = CAMPAIGN.results
RUBBER = CAMPAIGN.material.name
ROAD = CAMPAIGN.road_name


wildcard_constraints:
    scene=r"scale\d+_v[0-9.e-]+_p[0-9.e-]+_aspect[0-9.e-]+_(stress|strain)",
    scale=r"\d+",
    figure=r"\w+",


# On a cluster, tables and figures run where Snakemake does: they take seconds. The scenes of a batch are local to the
# one Snakemake that runs them on their node: it would start another for each.
localrules:
    campaign,
    scale_table,
    total_table,
    campaign_figure,
    field_figure,
    march_figure,
    accuracy_tables,
    accuracy_figure,
    stability_table,
    stability_figure,


if workflow.remote_exec:

    localrules:
        scene,
        march,
        ladder,
        calibrate,
        stability_batch,


def package_files(*modules):
    """Return a file that stands for the package's files behind some modules: a job that lists it reruns when the content
    of one of them changes.
    """
    return stamp(".snakemake/sources", *modules)


def scene_file(name):
    """Return where the result of a scene belongs."""
    return f"{RESULTS}/scenes/{RUBBER}/{ROAD}/{name}.nc"


def scene_files(wildcards):
    """Return the results of all scenes; a function, since only some runs need to know."""
    return [scene_file(name) for name in SCENES]


def march_file(name):
    """Return where the march of a scene belongs."""
    return f"{RESULTS}/marches/{RUBBER}/{ROAD}/{name}.nc"


def fingerprint(words):
    """Return a short name for a list of words."""
    return hashlib.sha256(" ".join(words).encode()).hexdigest()[:16]
