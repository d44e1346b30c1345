"""
5. Outgrow one machine
======================

A campaign of a few hundred scenes runs on a laptop. This tutorial shows how to see
what a campaign will cost before it runs, how to send it to a cluster, and how to
divide one that is too large for a single run.
"""

import subprocess
import sys
import textwrap
from pathlib import Path
from tempfile import TemporaryDirectory

import matplotlib.pyplot as plt
import numpy as np

import rubfric

# %%
# What would run?
# ---------------
#
# A dry run reads and checks the config, says what it understood, and lists the jobs
# with an estimate of their time. Nothing is computed. Look at the first lines:
# wavelengths, slopes and moduli at the frequencies of the grid are where a slip of
# units shows. Here it is the small campaign of the clone, planned in an empty folder.

clone = Path(rubfric.__file__).parents[1]
with TemporaryDirectory() as folder:
    command = [
        sys.executable,
        "-m",
        "snakemake",
        "-n",
        "-s",
        clone / "Snakefile",
        "--directory",
        folder,
    ]
    command += ["--configfile", clone / "config" / "minimal.yaml"]
    planned = subprocess.run(command, check=True, capture_output=True, text=True)
for line in (planned.stdout + planned.stderr).splitlines():
    if line[:2] == "  " and line[2] != " ":  # the others list the jobs, one by one
        print(textwrap.fill(line, 110, subsequent_indent="    "))

# %%
# What does a scene cost?
# -----------------------
#
# Costs follow from contact, not from the number of unknowns: light contacts need many
# columns. Small strain costs milliseconds, finite strain ten times as much, and all
# scales at once in finite strain from seconds to a minute. So the cheapest way to a
# large campaign is to think about which scenes need what. ``kinematics: auto`` does
# that to the accuracy asked for; ``preset: draft`` (5 %) takes 0.4 times as long as
# ``standard`` (1 %), and ``reference`` (0.2 %) five times.

campaign = rubfric.load()
pressures = np.geomspace(0.05, 5, 9)
fig, ax = plt.subplots(figsize=(6.4, 3.8), layout="constrained")
for preset, marker in zip(("draft", "standard", "reference"), "^so", strict=True):
    scenes = [
        campaign.scene(1, 1000, p, kinematics="small", preset=preset) for p in pressures
    ]
    columns = [int(rubfric.simulate(scene).columns) for scene in scenes]
    ax.loglog(
        pressures,
        columns,
        marker + "-",
        label=f"{preset}, {campaign.presets[preset].accuracy:.1%}",
    )
ax.set(xlabel="nominal pressure (MPa)", ylabel="columns of cells that a scene needs")
ax.legend(title="accuracy of friction")
plt.show()

# %%
# On a cluster
# ------------
#
# The workflow has a profile for SLURM. On the login node:
#
# .. code-block:: sh
#
#    snakemake --profile workflow/profiles/slurm --configfile mine.yaml
#
# Scenes go out in batches of about two minutes (``group-components: scenes=100``),
# since a job of a second each would spend its time in the queue. What was killed for
# want of memory is repeated with more. Tables, figures and pages are made where
# Snakemake runs. Five lines of the profile are yours to set: partition and account,
# jobs at a time, scenes in a batch, retries, and the patience with a slow file
# system. Start it within ``tmux`` or ``screen``.
#
# Divide and conquer
# ------------------
#
# Up to 30 000 scenes are one run. Beyond, planning takes longer than it should, and
# one run for each rubber, road or range of speeds is better: a config and a folder of
# results each. Parts share nothing but the code, so that one that is interrupted or
# changed leaves the others alone. This writes the configs of a screening of
# compounds, whose relaxation times are those of the paper's rubber times a factor:

parts = {}
for number, factor in enumerate(np.geomspace(0.1, 10, 5)):
    name = f"compound_{number}"
    rubber = {
        "youngs_modulus": 4.17,
        "poissons_ratio": 0.49,
        "shear_fractions": list(campaign.material.shear_fractions),
        "relaxation_times": [
            float(f"{factor * time:.6g}") for time in campaign.material.relaxation_times
        ],
    }
    grid = {"velocities": [1, 10, 100, 1000], "pressures": [0.2, 1], "aspect": 0.75}
    parts[name] = {
        "results": f"results/{name}",
        "rubber": name,
        "rubbers": {name: rubber},
        "grid": grid,
    }

scenes = {name: len(rubfric.load(part).scenes()) for name, part in parts.items()}
print(scenes)

# %%
# Each is checked when it is loaded, before anything is sent anywhere. Written to
# files (``yaml.safe_dump``), they are run by
#
# .. code-block:: sh
#
#    for part in compound_*.yaml; do
#        snakemake --profile workflow/profiles/slurm --configfile "$part" -- tables
#    done
#
# Every part has its ``campaign.nc`` and tables; ``xarray.open_mfdataset`` or
# ``pandas.concat`` joins them. What a result depends on is in its file, so that parts
# that were made months apart can still be told from one another: parameters, their
# digest, and the version. :doc:`/performance` has measured costs up to a million
# scenes, :doc:`/operations` what to do when something goes wrong.
