"""Put the outcome of the matrix of stability, which ``snakemake stability`` wrote, into docs/stability.md."""

from __future__ import annotations

import shutil
from pathlib import Path

import tables

RESULTS = Path(__file__).resolve().parents[2] / "results"
PAGE, MAP = RESULTS / "stability" / "stability.md", RESULTS / "figures" / "stability.png"


def main() -> None:
    """Copy the page, with the machine that it was measured on, and its map."""
    if not PAGE.exists():
        raise SystemExit(f"{PAGE} is missing: run snakemake -j2 stability first")
    # The page in docs has a heading of its own.
    _, text = PAGE.read_text(encoding="utf-8").split("\n\n", 1)
    text = f"{text.rstrip()}\n\n{tables.machine()}."
    tables.publish("stability", text, "stability.md")
    shutil.copy(MAP, tables.DOCS)
    print(text)


if __name__ == "__main__":
    main()
