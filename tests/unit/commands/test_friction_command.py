"""The friction of the whole road from the shell and from Python: the workflow's numbers, without the workflow."""

from __future__ import annotations

import io
import json
import re
import runpy
from pathlib import Path

import pandas as pd
import pytest

import rubfric
from rubfric import cli, scene_jobs, total_simulation
from rubfric.errors import InvalidInput
from rubfric.results import kept, totals
from rubfric.results.dataset import read, write
from rubfric.results.kept import take_up
from rubfric.scene.scene import ALL, Scene
from rubfric.simulation import simulate

ROAD = [{"amplitude": 0.5, "wavelength": 10.0}, {"amplitude": 0.05, "wavelength": 1.0}]
WHOLE = Path(rubfric.__file__).resolve().parents[1] / "workflow" / "scripts" / "simulate_whole.py"
POINT = ["friction", "--velocity", "100", "--pressure", "0.5"]


@pytest.fixture
def config(tmp_path: Path) -> Path:
    path = tmp_path / "mine.yaml"
    path.write_text(f"results: {tmp_path}\nmultiscale: sum\nkinematics: small\n")
    return path


def test_prints_the_sum_over_the_scales_with_its_errors(config: Path, capsys: pytest.CaptureFixture[str]) -> None:
    campaign = rubfric.load(config)
    results = {
        name: simulate(scene) for name, scene in total_simulation.at_points(campaign, [100], [0.5]).scenes().items()
    }
    expected = sum(float(result["friction_coefficient"]) for result in results.values())
    for name, result in list(results.items())[1:]:
        write(result, config.parent / "scenes" / "zhou2019" / "zhou2019" / f"{name}.nc")
    assert cli.main([*POINT, "--config", str(config)]) == 0
    out, err = capsys.readouterr()
    first, *_ = results
    assert re.fullmatch(rf"rubfric: 1 of 1 scene; slowest {re.escape(first)} [0-9.]+ s\n", err)
    assert f"{expected:.4g}" in out.splitlines()[3].split()
    shares = [float(word[:-1]) for word in out.splitlines()[3].split() if word.endswith("%")]
    assert len(shares) == 4
    assert sum(shares) == pytest.approx(100.0, abs=0.21)
    assert "no error covers: data of rubber zhou2019; other phases of road zhou2019; finite strain\n" in out

    assert cli.main([*POINT, "--config", str(config), "--json"]) == 0
    out, err = capsys.readouterr()
    assert not err  # all is known
    found = json.loads(out)
    assert found["rows"][0]["friction_total"] == pytest.approx(expected, rel=1e-12)
    assert found["rows"][0]["friction_road_error"] is None
    about = rubfric.run(campaign, 100, 0.5, progress=False).attrs
    assert about["not_covered"] == "; ".join(found["not_covered"])
    assert found["rows"][0]["way"] == "sum"

    assert cli.main([*POINT, "--config", str(config), "--csv"]) == 0
    table = pd.read_csv(io.StringIO(capsys.readouterr().out))
    assert table["friction_total"][0] == pytest.approx(expected, rel=1e-5)
    parts = table["friction_numerical_error"] + table["friction_coupling_error"]
    assert table["friction_total_error"][0] == pytest.approx(parts[0], rel=1e-5)


def test_files_that_do_not_fit_are_solved_anew(config: Path) -> None:
    campaign = rubfric.load(config)
    folder = config.parent / "scenes" / "zhou2019" / "zhou2019"
    scenes = total_simulation.at_points(campaign, [100], [0.5]).scenes()
    for place, (name, scene) in enumerate(scenes.items()):
        write(simulate(scene if place else campaign.scene(2, 100, 0.5)), folder / f"{name}.nc")
    damaged = folder / f"{list(scenes)[1]}.nc"
    damaged.write_bytes(damaged.read_bytes()[:-1] + b"!")
    lines: list[str] = []
    rubfric.friction(campaign, [100], [0.5], progress=lines.append)
    assert [line.partition(";")[0] for line in lines] == ["1 of 2 scenes", "2 of 2 scenes"]
    lines.clear()
    known = rubfric.run(campaign, [100], [0.5], progress=lines.append)
    assert not lines
    (answer,) = (path for path in config.parent.glob(".cache/*/*.nc") if re.fullmatch("[0-9a-f]{16}.nc", path.name))
    answer.write_bytes(answer.read_bytes()[:-1] + b"!")
    assert rubfric.run(campaign, [100], [0.5], progress=lines.append).identical(known)
    assert not lines


def test_dataset_holds_the_table_and_every_scale(config: Path) -> None:
    campaign = rubfric.load(config, {"road": "two", "roads": {"two": ROAD}})
    found = campaign.run([100, 10], 0.5, jobs=1, progress=False)
    table = rubfric.friction(campaign, [10, 100], [0.5])
    assert dict(found.sizes) == {"pressure": 1, "velocity": 2, "scale": 2}
    assert found["friction_total"].values.ravel().tolist() == table["friction_total"].tolist()
    assert list(table.columns[:5]) == [*totals.AXES, *totals.TOTAL, "way"]
    assert found["friction_scale"].sel(scale=2).values.ravel().tolist() == table["friction_scale_2"].tolist()
    assert found["friction_scale"].sum("scale").values == pytest.approx(found["friction_sum"].values, rel=1e-14)
    assert found["friction_scale_error"].sum("scale").values == pytest.approx(found["friction_numerical_error"].values)
    assert found["wavelength"].values == pytest.approx([10.0, 1.0])
    assert set(found["way"].values.ravel()) == {"sum"}
    assert found["velocity"].attrs["units"] == "mm s-1"
    assert found.attrs["road"] == "two"
    assert json.loads(found.attrs["material"])["name"] == "zhou2019"


def test_workers_find_what_one_process_does(config: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    changes = {"multiscale": "auto", "road": "one", "roads": {"one": ROAD[:1]}}
    alone = rubfric.friction(rubfric.load(config, changes), [10, 100], [0.5], jobs=1)
    monkeypatch.setattr(scene_jobs, "_ALONE", 0.0)
    monkeypatch.setattr(scene_jobs, "_FIRST", 0)
    elsewhere = rubfric.load(config, changes, {"results": str(tmp_path / "elsewhere")})
    lines: list[str] = []
    together = rubfric.friction(elsewhere, [10, 100], [0.5], jobs=2, progress=lines.append)
    assert lines[-1].startswith("2 of 2 scenes, 2 of 2 scenes of the whole road; slowest ")
    pd.testing.assert_frame_equal(together, alone, rtol=1e-9)


def test_workflow_takes_up_what_is_kept_and_nothing_else(
    config: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    campaign = rubfric.load(config, {"multiscale": "direct", "road": "one", "roads": {"one": ROAD[:1]}})
    campaign.run([100], [0.5], jobs=1, progress=False)
    results = config.parent
    asked = total_simulation.at_points(campaign, [100], [0.5])
    for place, scenes in (("scenes", asked.scenes()), ("whole", asked.whole_scenes())):
        for name, scene in scenes.items():
            output = results / place / "zhou2019" / "one" / f"{name}.nc"
            assert take_up(output, scene)
            assert read(output, scene.digest).attrs["scene"] == name
    assert not take_up(output, campaign.scene(1, 101, 0.5))
    capsys.readouterr()
    runpy.run_path(str(WHOLE))["main"](str(output), scene.parameters(), {})
    assert "friction coefficient  " in capsys.readouterr().out  # as where it is solved: the log has the warnings
    monkeypatch.setattr(kept, "code", lambda module: "of another version")
    assert not take_up(output, scene)


def test_scene_that_is_refused_is_named(config: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refused(scene: Scene) -> object:
        raise InvalidInput("the load is too light")

    monkeypatch.setattr(scene_jobs, "simulate", refused)
    with pytest.raises(InvalidInput, match=r"^scale1_v100_p0\.5_aspect0\.75_stress: the load is too light$"):
        rubfric.friction(rubfric.load(config), [100], [0.5])


def test_folder_that_cannot_be_written_is_done_without(config: Path) -> None:
    campaign = rubfric.load(config, {"results": "/dev/null/results", "road": "one", "roads": {"one": ROAD[:1]}})
    assert rubfric.friction(campaign, [100], [0.5])["way"].tolist() == ["sum"]


def test_corrected_sum_stands_in_for_a_whole_road_without_solution(
    config: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refused(scene: Scene) -> object:
        if scene.scale == ALL:
            raise InvalidInput("no solution")
        return simulate(scene)

    monkeypatch.setattr(scene_jobs, "simulate", refused)
    table = rubfric.friction(rubfric.load(config, {"multiscale": "direct"}), [100], [0.5])
    assert table["way"][0] == "corrected"
    assert table["note"][0].endswith("was refused: no solution")
    assert table["refused"][0] == 1


def test_every_temperature_is_a_row(config: Path) -> None:
    shift = {"law": "wlf", "c1": 8.0, "c2": 100.0, "reference_temperature": 20}
    campaign = rubfric.load(
        config,
        {
            "rubbers": {"zhou2019": {"shift": shift}},
            "road": "one",
            "roads": {"one": ROAD[:1]},
        },
    )
    table = rubfric.friction(campaign, [100], [0.5], [60, 20])
    assert table["temperature_degC"].tolist() == [20.0, 60.0]
    assert table["friction_total"].nunique() == 2


@pytest.mark.parametrize(
    ("option", "sentence"),
    [
        (["--velocity", "1;10"], "--velocity is '1;10', but must be numbers with commas between, 1,10,100 say"),
        (["--velocity", "1,-10"], "velocities[1] is -10 mm/s, but must be greater than 0"),
        (["--pressure", "0.5,0.5"], "pressures[1] is 0.5 MPa, the same as pressures[0]; keep one"),
        (["--temperature", "20"], "temperature is 20 degC, but rubber zhou2019 is known at one temperature only"),
    ],
)
def test_wrong_points_are_refused_in_a_sentence(
    option: list[str], sentence: str, config: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert cli.main([*POINT, "--config", str(config), *option]) == 2
    assert sentence in capsys.readouterr().err
