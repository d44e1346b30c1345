"""The rig from the shell: points of a run, a run of the virtual rig, and a sentence for every mistake."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import xarray as xr

from rubfric import cli
from rubfric.results.campaign import AXES, read
from rubfric.results.dataset import write
from rubfric.results.friction_map import FrictionMap
from rubfric.results.tables import write_table

CONFIG = Path(__file__).resolve().parents[3] / "config" / "config.yaml"


@pytest.fixture(scope="module")
def campaign(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A campaign whose friction, of one scale, peaks near 30 mm/s."""
    axes = {"scale": [1], "velocity": [0.1, 1.0, 10.0, 100.0, 1000.0], "pressure": [0.5, 5.0], "aspect": [0.75]}
    _, speed, _, _ = np.meshgrid(*axes.values(), indexing="ij")
    friction = 0.7 * np.exp(-0.4 * (np.log10(speed) - 1.5) ** 2)
    fields = {"friction_coefficient": friction, "friction_coefficient_error": 0.01 * friction}
    made = xr.Dataset({name: (tuple(AXES), field) for name, field in fields.items()}, coords=axes)
    path = tmp_path_factory.mktemp("campaign") / "campaign.nc"
    write(made, path)
    totals = made.sel(scale=1, aspect=0.75)[list(fields)].to_dataframe().reset_index()
    names = {"velocity": "velocity_mm_per_s", "pressure": "pressure_MPa", "friction_coefficient": "friction_total"}
    totals = totals.rename(columns=names | {"friction_coefficient_error": "friction_total_error"})
    write_table(totals, path.parent / "tables" / "friction_total.csv")
    return path


def run(*arguments: object) -> int:
    return cli.main(["rig", *map(str, arguments)])


@pytest.fixture
def simulated(campaign: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Path:
    path = tmp_path / "run.csv"
    command = ["simulate", "--pressure", 1, "--speed", 5, "--sampling", 500, "--campaign", campaign]
    assert run(*command, "--config", CONFIG, "--seed", 3, "-o", path) == 0
    out = capsys.readouterr().out
    assert out.startswith("virtual rig (simulated): ")
    assert out.endswith(f"Written to {path}\n")
    return path


def test_simulated_run_is_reduced_to_its_speed(
    simulated: Path, campaign: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    points, rejected = tmp_path / "points.csv", tmp_path / "rejected.csv"
    assert run("reduce", simulated, "--area", 100, "-o", points, "--rejected", rejected) == 0
    out = capsys.readouterr().out
    assert "points, " in out.splitlines()[0]
    assert "(simulated runs)" in out.splitlines()[0]
    table = pd.read_csv(points)
    assert set(table["source"]) == {"simulated"}
    assert table["speed_mm_per_s"].iloc[-1] == pytest.approx(5.0, rel=0.01)
    truth = float(FrictionMap.from_campaign(read(campaign), 0.75, 1).at(1.0)(5.0))
    assert table["friction_coefficient"].iloc[-1] == pytest.approx(truth, rel=0.01)
    assert list(pd.read_csv(rejected).columns)[-2:] == ["reason", "source"]


def test_settings_come_from_the_yaml_file(simulated: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    settings = tmp_path / "rig.yaml"
    settings.write_text("area: 50\ncolumns: {traction: traction}\n")
    points = tmp_path / "points.csv"
    assert run("reduce", simulated, "--columns", settings, "-o", points) == 0
    assert pd.read_csv(points)["pressure_MPa"].iloc[-1] == pytest.approx(2.0, rel=0.01)


def test_known_load_is_an_option(simulated: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    points = tmp_path / "points.csv"
    assert run("reduce", simulated, "--area", 100, "--normal", 80, "-o", points) == 0
    assert pd.read_csv(points)["pressure_MPa"].iloc[-1] == 0.8
    assert "the column 'normal force (N)' is not used: normal gives the load" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("arguments", "code", "says"),
    [
        (["reduce", "absent.csv", "--area", 1], 2, "absent.csv"),
        (["reduce", "RUN"], 2, "area is not given, but pressure needs the nominal area of the rubber, mm²"),
        (["reduce", "RUN", "--area", -1], 2, "area is -1 mm², but must be greater than 0"),
        (["reduce", "RUN", "--area", 1e-4], 2, "mm²: it is probably in m², 100 mm²"),
        (["reduce", "RUN", "--area", 1, "--normal", 0], 2, "normal is 0 N, but must be greater than 0"),
        (["reduce", "RUN", "--area", 1, "--traction", "rope"], 2, "traction is rope, so sled_mass must be given"),
        (["reduce", "RUN", "--columns", "absent.yaml"], 2, "absent.yaml"),
        (["simulate", "--pressure", 9, "--weight", 1, "-o", "x.csv"], 2, "pressure is 9 MPa, but must lie within"),
        (["simulate", "--pressure", 1, "--weight", 0.01, "-o", "x.csv"], 2, "weight is 0.01 kg, which pulls with"),
        (["simulate", "--pressure", 1, "--speed", 9000, "-o", "x.csv"], 2, "outside the speeds simulated"),
        (["simulate", "--pressure", 1, "--weight", 1, "--area", 0, "-o", "x.csv"], 2, "rig.virtual.area is 0 mm²"),
        (
            ["simulate", "--pressure", 1, "--weight", 1, "--scale", 9, "-o", "x.csv"],
            2,
            "scale 9 is not in the campaign",
        ),
        (["simulate", "--pressure", 1, "--weight", 1, "-o", "."], 2, "--output is the folder"),
    ],
)
def test_mistakes_give_one_sentence(
    arguments: list[object],
    code: int,
    says: str,
    simulated: Path,
    campaign: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    more = ["--campaign", campaign, "--config", CONFIG] if arguments[0] == "simulate" else []
    assert run(*(simulated if word == "RUN" else word for word in arguments), *more) == code
    captured = capsys.readouterr()
    assert captured.err.startswith("rubfric: ")
    assert says in captured.err
    assert captured.err.count("\n") == 1
    assert not (tmp_path / "x.csv").exists()


def test_missing_campaign_says_what_to_do(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert run("simulate", "--pressure", 1, "--weight", 1, "--config", CONFIG, "-o", "x.csv") == 2
    assert capsys.readouterr().err == (
        "rubfric: there is no results/tables/friction_total.csv: run snakemake first, or give --campaign FILE\n"
    )


@pytest.mark.parametrize("command", ["reduce", "simulate"])
def test_help_names_every_option_and_its_unit(command: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as caught:
        run(command, "--help")
    assert caught.value.code == 0
    out = " ".join(capsys.readouterr().out.split())
    assert "mm²" in out
    assert "kg" in out
    assert f"rubfric rig {command}" in out
