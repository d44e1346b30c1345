"""Publish what ``snakemake -j2 accuracy`` has measured: tables and figures of docs/accuracy.md.

It refuses where the presets of the config are not those that the measurements choose.
"""

from __future__ import annotations

import shutil
from pathlib import Path

import pandas as pd
import tables

from rubfric.config.campaign import load
from rubfric.studies.accuracy.presets import presets_that_differ, start_table

PROJECT = Path(__file__).resolve().parents[2]
MEASURED = PROJECT / "results/accuracy"


def main() -> None:
    """Check the presets, then copy page, tables and figures to docs."""
    if not (MEASURED / "page.md").exists():
        raise SystemExit("results/accuracy is not there: run snakemake -j2 accuracy first")
    presets = load(PROJECT / "config/config.yaml").presets
    ladder = pd.read_csv(MEASURED / "ladder.csv", dtype={"rung": str, "note": str})
    starts = start_table(ladder)
    differing = presets_that_differ(starts, presets)
    if differing:
        chosen = starts[starts["chosen"]].to_string(index=False)
        raise SystemExit(f"the presets {', '.join(differing)} of the config are not those that were chosen:\n{chosen}")
    figures = "\n\n".join(f"![{name}]({name}.png)" for name in ("pareto", "calibration"))
    # The page in docs has a heading of its own.
    _, page = (MEASURED / "page.md").read_text(encoding="utf-8").split("\n\n", 1)
    page = page.replace("## Presets", f"{figures}\n\n## Presets", 1)
    tables.publish("accuracy", f"{page.rstrip()}\n\n{tables.machine()}.", "accuracy.md")
    for name in ("pareto", "calibration"):
        shutil.copy(PROJECT / f"results/figures/{name}.png", tables.DOCS / f"{name}.png")
    for name in ("ladder", "calibration"):
        shutil.copy(MEASURED / f"{name}.csv", tables.DOCS / f"accuracy_{name}.csv")


if __name__ == "__main__":
    main()
