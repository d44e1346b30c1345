"""What an earlier config made is removed: nothing that Snakemake did not make, and nothing changed since."""

from __future__ import annotations

import json
import os
from base64 import urlsafe_b64encode
from pathlib import Path

import pytest

from rubfric.runner.leftovers import remove_leftovers


def wanted(*tables: str) -> dict[str, list[str]]:
    return {"scale_table": list(tables), "claims": []}


def made(records: Path, path: str, rule: str = "scale_table", *, split: int = 1000, later: float = 0.0) -> None:
    """Write a file and the record that Snakemake keeps of it; the name of the record is split where it is long."""
    place = Path(path)
    place.parent.mkdir(parents=True, exist_ok=True)
    place.write_text("1\n")
    os.utime(place, (1000.0 + later, 1000.0 + later))
    name = urlsafe_b64encode(path.encode()).decode()
    parts = [name[at : at + split] for at in range(0, len(name), split)]
    record = records.joinpath(*(f"@{part}" for part in parts[:-1]), parts[-1])
    record.parent.mkdir(parents=True, exist_ok=True)
    record.write_text(json.dumps({"rule": rule, "endtime": 1000.0}))


def test_only_recorded_files_of_these_rules_are_removed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    records = Path("records")
    made(records, "out/tables/one.csv")
    made(records, "out/tables/two.csv", split=10)
    made(records, "out/claims.html", "paper_claims")  # of a module with a prefix
    made(records, "out/tables/mine.csv", later=60.0)
    made(records, "out/scenes/a.nc", "scene")
    made(records, "out2/tables/two.csv")
    Path("out/tables/users.csv").write_text("mine\n")
    (records / "no record").write_text("{")
    lines = remove_leftovers(records, "out", wanted("out/tables/one.csv"))
    assert lines == [
        "removed, since an earlier config made them and this one does not: out/claims.html, out/tables/two.csv",
        "left of an earlier config, since changed after they were made: out/tables/mine.csv",
    ]
    left = {path.as_posix() for path in Path().glob("out*/**/*") if path.is_file()}
    assert left == {
        *("out/tables/one.csv", "out/tables/mine.csv", "out/tables/users.csv", "out/scenes/a.nc"),
        "out2/tables/two.csv",
    }
    assert remove_leftovers(records, "out", wanted("out/tables/one.csv", "out/tables/mine.csv")) == []
    assert remove_leftovers("nowhere", "out", wanted()) == []
