"""What moves friction from the shell: text, JSON, CSV and a figure of one and the same table."""

from __future__ import annotations

import io
import json
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import rubfric
from rubfric import cli, plot

COMMAND = ["sensitivity", "--scale", "1", "--kinematics", "small", "--preset", "draft", "--velocity", "1"]
ONLY = ["--pressure", "5", "--only", "E,p,tau_1"]


def test_prints_what_python_finds_as_text_json_csv_and_picture(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    picture = tmp_path / "tornado.png"
    campaign = rubfric.load({"kinematics": "small"})
    expected = rubfric.sensitivity(campaign, 1, 5, scale=1, preset="draft", only=["E", "p", "tau_1"])
    assert cli.main([*COMMAND, *ONLY, "--json", "-o", str(picture)]) == 0
    printed = capsys.readouterr()
    assert "rubfric: 3 parameters: 6 scenes on " in printed.err
    point = json.loads(printed.out)["points"][0]
    assert (point["scale"], point["velocity_mm_per_s"], point["pressure_MPa"]) == (1, 1.0, 5.0)
    found = pd.DataFrame(point["rows"])
    assert list(found["parameter"]) == list(expected.table["parameter"])
    assert np.allclose(found["sensitivity"], expected.table["sensitivity"], rtol=1e-9)
    assert point["sentences"] == expected.sentences()
    assert picture.read_bytes().startswith(b"\x89PNG")
    assert plot.sensitivity(expected).get_suptitle() == expected.title

    assert cli.main([*COMMAND, "--pressure", "5,6", "--only", "p,v", "--csv"]) == 0
    table = pd.read_csv(io.StringIO(capsys.readouterr().out))
    assert sorted(zip(table["pressure_MPa"], table["parameter"], strict=True)) == [
        (pressure, name) for pressure in (5, 6) for name in ("p", "v")
    ]

    assert cli.main([*COMMAND, *ONLY]) == 0
    out = capsys.readouterr().out
    assert "the long-term modulus is held, and the moduli of the other branches" in out
    assert all(sentence in out for sentence in expected.sentences())


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (["--range", "much"], "--range is 'much', but must be a share, 10% or 0.1 say"),
        (["--range", "60%"], "--range is 0.6, but must be at most 0.3"),
        (["--pressure", "1;2"], "--pressure is '1;2', but must be numbers with commas between, 1,10,100 say"),
        (["--pressure", "1,2", "-o", "a.png"], "--output draws one speed and pressure, but 2 are given: leave one"),
        (["--velocity", "0"], "velocity is 0 mm/s, but must be greater than 0"),
        (["--only", ""], "--only is empty, but must name numbers with commas between, E,g_1 say"),
        (["--velocity", "-3,5"], "velocity is -3 mm/s, but must be greater than 0"),
        (["--velocity", "-3"], "velocity is -3 mm/s, but must be greater than 0"),
        (["--scale", "x"], "--scale is 'x', but must be the number of a scale, or all"),
        (["-o", "a.svg"], "--output is a.svg, but its name must end in .pdf or .png"),
        (["--only", "g_9"], "the parameter 'g_9' is unknown"),
        (["--temperature", "20"], "temperature is 20 degC, but rubber zhou2019 is known at one temperature only"),
    ],
)
def test_refuses_in_a_sentence(options: list[str], sentence: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main([*COMMAND, *options]) == 2
    assert sentence in capsys.readouterr().err
