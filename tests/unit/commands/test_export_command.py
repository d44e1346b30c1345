"""The friction of a campaign, written for other programs from the shell."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from synthetic_campaign import make_campaign, make_totals

import rubfric
from rubfric import cli
from rubfric.results.dataset import load, write
from rubfric.results.tables import write_table


@pytest.fixture(scope="module")
def results(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder of results: one friction is below zero, as its error allows."""
    folder = tmp_path_factory.mktemp("results")
    campaign = make_campaign()
    totals = make_totals(campaign)
    totals.loc[0, "friction_total"] = -1e-4
    write_table(totals, folder / "tables" / "friction_total.csv")
    write_table(totals, folder / "totals" / "soft" / "street" / "friction_total.csv")
    road = {name: ("scale", [1.0, 0.5, 0.2, 0.1]) for name in ("amplitude", "wavenumber")}
    about = {"rubber": "soft", "plane": "stress", "kinematics": "auto", "source": "rubfric 0.0.9"}
    write(campaign.assign(road).assign_attrs(about), folder / "campaign.nc")
    (folder / "scenes" / "soft" / "street").mkdir(parents=True)
    return folder


@pytest.mark.parametrize("form", ["abaqus", "ansys", "csv"])
def test_text_says_which_campaign_and_version_made_it(
    form: str, results: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    output = tmp_path / "friction"
    for _ in range(2):  # a file of its own may be written anew
        assert cli.main(["export", str(results), "--to", form, "-o", str(output)]) == 0
    out, err = capsys.readouterr()
    text = output.read_text()
    assert "friction of rubber soft on road street; plane stress, auto kinematics; simulated by rubfric 0.0.9" in text
    assert f"made by rubfric {rubfric.__version__} from {results}/tables/friction_total.csv (sha256 " in text
    assert "of 1 pairs of rubber and road this is the first of the config" in err
    points = 18 if form == "csv" else 3 * 51
    assert out.splitlines()[-1] == f"{points} points written to {output}"
    assert ("-0.0001, which its error allows, is written as 0" in text) == (form != "csv")
    if form == "csv":
        assert pd.read_csv(output, comment="#")["friction_total"][0] == -1e-4
    assert cli.main(["export", str(results), "--to", form, "--per-decade", "0"]) == 0
    printed = capsys.readouterr().out
    assert printed.count("+- ") == (0 if form == "csv" else 18)


def test_netcdf_holds_the_lookup_table(results: Path, tmp_path: Path) -> None:
    output = tmp_path / "friction.nc"
    pair = results / "totals" / "soft" / "street" / "friction_total.csv"
    for _ in range(2):
        assert cli.main(["export", str(pair), "--to", "netcdf", "-o", str(output)]) == 0
    data = load(output)
    assert "rubber soft on road street" in data.attrs["history"]
    expected = pd.read_csv(pair).set_index(["pressure_MPa", "velocity_mm_per_s"])["friction_total"].unstack()
    np.testing.assert_array_equal(data["friction_coefficient"], expected)


def test_wrong_use_is_refused_in_a_sentence(results: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    own = tmp_path / "model.inp"
    own.write_text("*HEADING\n")
    for options, sentence in (
        (["--to", "netcdf"], "--output is missing: netCDF cannot be printed"),
        (["--to", "abaqus", "-o", str(own)], "exists and was not written by this command"),
        (
            ["--to", "abaqus", "--material", "3"],
            "--material numbers a material of Ansys: leave it out with --to abaqus",
        ),
        (["--to", "ansys", "--material", "0"], "--material is 0, but must be a whole number of at least 1"),
        (["--to", "csv", "--temperature", "20"], "temperature is 20 degC, but the table has no temperatures"),
    ):
        assert cli.main(["export", str(results), *options]) == 2
        assert sentence in capsys.readouterr().err
    assert own.read_text() == "*HEADING\n"
