"""Put the verdicts on the paper's claims, which the campaign wrote, into docs/claims.md."""

from __future__ import annotations

from pathlib import Path

import tables

from rubfric.pages.claims import claims_text
from rubfric.results.tables import read_table

TABLE = Path(__file__).resolve().parents[2] / "results" / "tables" / "claims.csv"


def main() -> None:
    if not TABLE.exists():
        raise SystemExit(f"{TABLE} is missing: run snakemake -j2 first")
    text = claims_text(read_table(TABLE, ("pressure_MPa", "where", "limit", "parts", "note")))
    tables.publish("claims", text, "claims.md")
    print(text)


if __name__ == "__main__":
    main()
