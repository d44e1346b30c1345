"""Put the outcome of the matrix of stability, which ``snakemake stability`` wrote, into the README."""

from __future__ import annotations

from pathlib import Path

import pandas as pd
import tables

from rubfric.markdown import markdown_table
from rubfric.studies.stability.cases import cases
from rubfric.studies.stability.report import summary

TABLE = Path(__file__).resolve().parents[2] / "results" / "stability" / "stability.csv"


def main() -> None:
    if not TABLE.exists():
        raise SystemExit(f"{TABLE} is missing: run snakemake -j2 stability first")
    table = pd.read_csv(TABLE)
    tried = "" if len(table) == len(cases()) else f"{len(table)} of the {len(cases())} cases. "
    text = f"{markdown_table(summary(table), numeric=True)}\n\n{tried}{tables.machine()}."
    tables.publish("stability", text)
    print(text)


if __name__ == "__main__":
    main()
