"""What jobs have cost: measured while they run, and gathered from the ends of their logs."""

from __future__ import annotations

from pathlib import Path

import pytest

from rubfric.runner import times
from rubfric.runner.times import Cost


def put(folder: Path, log: str, text: str) -> None:
    path = folder / log
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


def test_cost_of_a_block_is_its_wall_and_cpu_time(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    with times.clock():
        print("at work")
        ballast = bytearray(80_000_000)
        total = sum(range(3_000_000))
        del ballast
    put(tmp_path, "one.log", capsys.readouterr().out)
    (cost,) = times.costs(tmp_path)
    assert total > 0
    assert 0.0 < cost.cpu <= cost.seconds * 1.5 + 0.1
    assert cost.memory is None or cost.memory > 80.0


def test_block_that_fails_says_no_cost(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(ValueError, match="no good"), times.clock():
        raise ValueError("no good")
    assert capsys.readouterr().out == ""


def test_table_of_costs_is_gathered_from_logs_the_dearest_first(tmp_path: Path) -> None:
    put(tmp_path, "scenes/zhou/one.log", "µ = 0.2\ntook 3.1 s, 3.0 s of CPU time, 210 MB of memory at most\n")
    put(tmp_path, "scenes/zhou/two.log", "took 1.1 s, 1.0 s of CPU time\n")
    put(tmp_path, "whole/all.log", "took 9.0 s, 6.0 s of CPU time, 900 MB of memory at most\n")
    put(tmp_path, "campaign.log", "took 9.0 s, 6.0 s of CPU time\nTraceback")  # begun again, and failed
    found = times.record(tmp_path)
    assert found[0] == Cost("whole/all.log", 9.0, 6.0, 900.0)
    assert times.shares(found) == {"whole": (1, 6.0, 0.6), "scenes": (2, 4.0, 0.4)}
    assert (tmp_path / "times.csv").read_text().splitlines() == [
        "log,seconds,cpu_seconds,memory_MB",
        "whole/all.log,9.0,6.0,900.0",
        "scenes/zhou/one.log,3.1,3.0,210.0",
        "scenes/zhou/two.log,1.1,1.0,",
    ]
    assert Cost("claims.log", 1.0, 1.0, None).kind == "others"
