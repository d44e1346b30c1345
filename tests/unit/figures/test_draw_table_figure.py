"""The script that draws a figure from a table, run as a job runs it."""

from __future__ import annotations

import runpy
from collections.abc import Callable
from pathlib import Path

import pandas as pd
import pytest

import rubfric
from rubfric.errors import BrokenResult
from rubfric.results.tables import write_table

SCRIPT = Path(rubfric.__file__).resolve().parents[1] / "workflow" / "scripts" / "draw_table_figure.py"


@pytest.mark.parametrize("figure", ["pareto", "calibration"])
def test_figure_is_drawn_from_its_csv_file(
    figure: str,
    make_ladder: Callable[..., pd.DataFrame],
    make_calibration: Callable[..., pd.DataFrame],
    tmp_path: Path,
) -> None:
    made = {"pareto": make_ladder, "calibration": make_calibration}[figure]()
    write_table(made, tmp_path / "table.csv")
    outputs = [tmp_path / "figures" / f"{figure}.{kind}" for kind in ("pdf", "png")]
    main = runpy.run_path(str(SCRIPT))["main"]
    main(figure=figure, table=str(tmp_path / "table.csv"), outputs=[str(path) for path in outputs])
    assert outputs[0].read_bytes().startswith(b"%PDF-")
    assert outputs[1].read_bytes().startswith(b"\x89PNG")


def test_absent_table_is_named(tmp_path: Path) -> None:
    main = runpy.run_path(str(SCRIPT))["main"]
    with pytest.raises(BrokenResult, match=r"absent\.csv is missing: run again, which makes it$"):
        main(figure="pareto", table=str(tmp_path / "absent.csv"), outputs=[str(tmp_path / "figure.pdf")])
    assert not list(tmp_path.iterdir())
