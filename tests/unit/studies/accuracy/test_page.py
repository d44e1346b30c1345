"""The page on accuracy against cost: everything on it is from the tables, and what is not in them is left out."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import pandas as pd
import pytest

from rubfric.studies.accuracy.ladder import STARTS
from rubfric.studies.accuracy.page import accuracy_page, calibration_text, dominance, preset_text

PRESETS = {"draft": 0.05, "standard": 0.01, "reference": 0.002}
# Name, speed in mm/s, pressure in MPa, plane.
SCENES = (("slow", 0.1, 0.1, "stress"), ("peak", 100.0, 5.0, "strain"), ("fast", 1e4, 1.0, "stress"))
RUNGS = {
    "preset": tuple(PRESETS),
    "start": tuple(f"{accuracy:g} from {start:g}" for accuracy, values in STARTS.items() for start in values),
    "mesh": ("0.5", "1", "2"),
    "surface": ("0.5", "1"),
    "rows": ("1.2", "1.1"),
    "first_row": ("2", "1"),
    "element": ("pointwise", "mean"),
    "kinematics": ("small", "auto", "finite"),
    "folding": ("1", "0"),
    "tolerance": ("0.001", "1e-06"),
    "steps": ("8", "64"),
    "wavelengths": ("1", "8"),
}
# Friction on the mesh of fineness 1 is 0.2; turned down, the knobs change it by these shares, times 1, 2 and 3.
CHANGES = {"surface": 0.01, "rows": 0.02, "first_row": 0.005, "kinematics": 0.1, "folding": 0.001, "tolerance": 1e-4}
TURNED = {
    "surface": "0.5",
    "rows": "1.2",
    "first_row": "2",
    "kinematics": "small",
    "folding": "1",
    "tolerance": "0.001",
}


def make_ladder(*without: str) -> pd.DataFrame:
    """Return a ladder of the scenes whose errors are a tenth of what is asked for; some knobs have no rows."""
    rows = []
    for number, (scene, velocity, pressure, plane) in enumerate(SCENES):
        for knob, names in RUNGS.items():
            for place, name in enumerate(names if knob not in without else ()):
                accuracy = PRESETS.get(name, float(name.split(" from ")[0]) if knob == "start" else 0.01 / (place + 1))
                change = CHANGES[knob] * (number + 1) if TURNED.get(knob) == name else 0.0
                row: dict[str, Any] = {"scene": scene, "velocity": velocity, "pressure": pressure, "plane": plane}
                row |= {"knob": knob, "rung": name, "friction_coefficient": 0.2 * (1.0 + change)}
                row |= {"reference": 0.2, "reference_error": 2e-5 * (number + 1)}
                row |= {"error": 0.1 * accuracy * (number + 1), "estimate": 0.4 * accuracy}
                row |= {"seconds": 1.0 + place, "cost": 0.5 * (1.0 + place), "memory_MB": 120.0}
                rows.append(row)
    return pd.DataFrame(rows)


def make_calibration(covered: int = 20) -> pd.DataFrame:
    """Return 20 runs, inside, whose estimates are three times the error; so many of them are covered."""
    flags = [True] * covered + [False] * (20 - covered)
    return pd.DataFrame({"set": "inside", "estimate": 0.01, "covered": flags, "ratio": 3.0})


def tables(text: str) -> list[list[list[str]]]:
    """Return the cells of the Markdown tables of a text, headings first, without the line below them."""
    found: list[list[list[str]]] = []
    for part in text.split("\n\n"):
        lines = part.strip("\n").split("\n")
        if lines[0].startswith("|"):
            cells = [line[2:-2].split(" | ") for line in lines]
            assert set("".join(cells[1])) == {"-", ":"}
            assert len({len(line) for line in cells}) == 1
            found.append([cells[0], *cells[2:]])
    return found


@pytest.fixture(scope="module")
def page() -> str:
    return accuracy_page(make_ladder(), make_calibration(), PRESETS)


def test_page_has_a_row_for_every_preset(page: str) -> None:
    presets = tables(page)[0]
    assert presets[1:] == [
        ["`draft`", "5 %", "1 %", "1.5 %", "2 %", "0.5", "3.0 s", "120 MB"],
        ["`standard`", "1 %", "0.2 %", "0.3 %", "0.4 %", "1", "6.0 s", "120 MB"],
        ["`reference`", "0.2 %", "0.04 %", "0.06 %", "0.08 %", "1.5", "9.0 s", "120 MB"],
    ]
    assert presets[0][-2] == "3 scenes"
    assert tables(preset_text(make_ladder(), PRESETS))[0] == presets


def test_page_marks_the_first_mesh_that_was_chosen(page: str) -> None:
    heading, *rows = tables(page)[1]
    assert heading == ["accuracy", "fineness", "typical error", "worst error", "cost", "seconds", "chosen"]
    assert [row[:2] for row in rows] == [
        [f"{100.0 * accuracy:g} %", f"{start:g}"] for accuracy, values in STARTS.items() for start in values
    ]
    assert [row[1] for row in rows if row[-1] == "yes"] == [
        "0.25",
        "0.35",
        "0.7",
    ]


@pytest.mark.parametrize(("covered", "word"), [(20, "The target is met"), (18, "The target is not met")])
def test_page_has_the_verdict_on_the_estimates(page: str, covered: int, word: str) -> None:
    text = calibration_text(make_calibration(covered))
    assert f"{word}: at least 95 % of the true errors within the estimate" in text
    assert "at most 10 times the true error at the median" in text
    share = f"{5 * covered:.1f} %"
    assert tables(text)[0][1:] == [["inside", "20", "0", share, "3.0"], ["all", "20", "0", share, "3.0"]]
    assert (text in page) == (covered == 20)


def test_knobs_are_turned_down_regime_by_regime(page: str) -> None:
    table = dominance(make_ladder()).set_index("regime")
    assert len(table) == 7
    assert table.loc["slow (up to 1 mm/s)", "half the columns"] == "1 % (1 %)"
    assert table.loc["near the peak (10 to 1000 mm/s)", "small strain"] == "20 % (20 %)"
    assert table.loc["fast (10^4 mm/s)", "rows that grow twice as fast"] == "6 % (6 %)"
    assert table.loc["plane stress", "half the columns"] == "2 % (3 %)"  # of 1 % and 3 %
    assert table.loc["heavy (5 MPa)", "tolerance 0.001"] == "0.02 % (0.02 %)"
    assert tables(page)[3][1:] == [[name, *row] for name, row in zip(table.index, table.to_numpy(), strict=True)]
    assert "- Slow (up to 1 mm/s): `kinematics` (10 %), then `rows` (2 %)." in page
    assert "- Plane strain: `kinematics` (20 %), then `rows` (4 %)." in page


def test_every_knob_has_its_words_and_its_table(page: str) -> None:
    knobs = [knob for knob in RUNGS if knob not in ("preset", "start")]
    assert re.findall(r"^### `(.*)`$", page, re.MULTILINE) == knobs
    for knob, table in zip(knobs, tables(page)[4:], strict=True):
        assert tuple(row[0] for row in table[1:]) == RUNGS[knob]
    sentence = (
        "From 0.5 to 2 the typical error goes from 0.2 % to 0.067 % and the worst from 0.3 % to 0.1 %, "
        "at 3 times the cost."
    )
    assert sentence in page.partition("### `mesh`")[2].partition("###")[0]


def test_rung_that_every_scene_refused_has_dashes_for_numbers() -> None:
    ladder = make_ladder()
    refused = (ladder["knob"] == "steps") & (ladder["rung"] == "8") | (ladder["knob"] == "wavelengths")
    ladder.loc[refused, ["friction_coefficient", "error", "estimate", "seconds", "cost", "memory_MB"]] = np.nan
    page = accuracy_page(ladder, make_calibration(), PRESETS)
    steps, slid = page.partition("### `steps`")[2].split("### `wavelengths`")
    assert tables(steps)[0][1] == ["8", "0", "3", "-", "-", "-", "-", "0.0", "-"]
    assert "From 64 to 64 " in steps  # what was solved
    assert "No scene could be solved." in slid
    assert "nan" not in steps + slid


def test_ways_to_the_total_have_a_row_for_each_scene_of_the_whole_road() -> None:
    rows = [
        {"scene": "small_all", "knob": "multiscale", "rung": way, "velocity": 100.0, "pressure": 5.0, "plane": "strain"}
        | {"kinematics": "small", "friction_coefficient": 0.66, "reference": 0.65, "reference_error": 0.05}
        | {"error": error, "estimate": 0.6, "cost": cost, "seconds": 0.25 * cost, "memory_MB": 120.0}
        for way, error, cost in (("sum", 0.5556, 2.437), ("cascade", np.nan, np.nan), ("direct", 0.0062, 1.0))
    ]
    page = accuracy_page(pd.concat([make_ladder(), pd.DataFrame(rows)]), make_calibration(), PRESETS)
    rungs, scenes = tables(page.partition("### `multiscale`")[2])
    assert [row[0] for row in rungs[1:]] == ["sum", "cascade", "direct"]
    assert scenes[0][-3:] == ["sum", "cascade", "direct"]
    assert scenes[1] == ["small", "strain", "100", "5", "0.25", "56 % (2.4)", "- (-)", "0.62 % (1)"]
    # What is said of the scenes of single scales is theirs alone.
    assert (
        page.partition("### `mesh`")[0]
        == accuracy_page(make_ladder(), make_calibration(), PRESETS).partition("### `mesh`")[0]
    )
