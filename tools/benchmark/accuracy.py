"""Publish what ``snakemake -j2 accuracy`` has measured: tables in the README, page and figures in docs.

It refuses where the presets of the config are not those that the measurements choose.
"""

from __future__ import annotations

import shutil
from pathlib import Path

import pandas as pd
import tables

from rubfric.config.campaign import load
from rubfric.studies.accuracy.page import calibration_text, preset_text
from rubfric.studies.accuracy.presets import presets_that_differ, start_table

PROJECT = Path(__file__).resolve().parents[2]
MEASURED = PROJECT / "results/accuracy"
DOCS = PROJECT / "docs"


def main() -> None:
    """Check the presets, write the README's tables and copy page, tables and figures to docs."""
    if not (MEASURED / "page.md").exists():
        raise SystemExit("results/accuracy is not there: run snakemake -j2 accuracy first")
    presets = load(PROJECT / "config/config.yaml").presets
    ladder = pd.read_csv(MEASURED / "ladder.csv", dtype={"rung": str, "note": str})
    starts = start_table(ladder)
    differing = presets_that_differ(starts, presets)
    if differing:
        chosen = starts[starts["chosen"]].to_string(index=False)
        raise SystemExit(f"the presets {', '.join(differing)} of the config are not those that were chosen:\n{chosen}")
    accuracies = {name: numerics.accuracy for name, numerics in presets.items()}
    calibration = pd.read_csv(MEASURED / "calibration.csv")
    tables.publish("presets", f"{preset_text(ladder, accuracies)}\n\n{tables.machine()}.")
    tables.publish("calibration", calibration_text(calibration))
    figures = "\n\n".join(f"![{name}]({name}.png)" for name in ("pareto", "calibration"))
    page = (MEASURED / "page.md").read_text(encoding="utf-8")
    (DOCS / "accuracy.md").write_text(page.replace("## Presets", f"{figures}\n\n## Presets", 1), encoding="utf-8")
    for name in ("pareto", "calibration"):
        shutil.copy(PROJECT / f"results/figures/{name}.png", DOCS / f"{name}.png")
    for name in ("ladder", "calibration"):
        shutil.copy(MEASURED / f"{name}.csv", DOCS / f"accuracy_{name}.csv")


if __name__ == "__main__":
    main()
