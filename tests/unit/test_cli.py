"""One scene from the shell: the numbers of the API, and a sentence for every mistake."""

from __future__ import annotations

import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

import rubfric
from rubfric import cli
from rubfric.config.campaign import load
from rubfric.config.default import PAPER, base_configs, layers
from rubfric.config.overlay import read_yaml
from rubfric.mechanics.block import contact
from rubfric.results import dataset
from rubfric.simulation import simulate

CONFIG = Path(__file__).resolve().parents[2] / "config" / "config.yaml"
SCENE = ["simulate", "--config", str(CONFIG), "--scale", "1", "--velocity", "100", "--pressure", "5"]
SCENE += ["--kinematics", "small"]  # the faster one


def printed_friction(text: str) -> str:
    found = re.search(r"^friction coefficient +(\S+) \+- \S+$", text, re.MULTILINE)
    assert found
    return found[1]


def test_prints_the_friction_that_the_api_gives(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(SCENE) == 0
    expected = simulate(load(CONFIG).scene(1, 100, 5, kinematics="small"))
    captured = capsys.readouterr()
    assert printed_friction(captured.out) == f"{float(expected['friction_coefficient']):.5g}"
    assert captured.err == ""


def test_plane_and_aspect_replace_those_of_the_config(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main([*SCENE, "--plane", "strain", "--aspect", "0.5"]) == 0
    expected = simulate(load(CONFIG).scene(1, 100, 5, aspect=0.5, plane="strain", kinematics="small"))
    out = capsys.readouterr().out
    assert printed_friction(out) == f"{float(expected['friction_coefficient']):.5g}"
    assert "height/width 0.5, plane strain" in out


def test_temperature_is_that_of_the_rubber(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    overlay = tmp_path / "warm.yaml"
    shift = "{law: wlf, c1: 8.0, c2: 100.0, reference_temperature: 20}"
    overlay.write_text(f"rubbers: {{zhou2019: {{shift: {shift}}}}}\n")
    for options, temperature in ((["--temperature", "-10"], -10.0), ([], None)):
        assert cli.main([*SCENE, "--config", str(overlay), *options]) == 0
        expected = simulate(load(CONFIG, overlay).scene(1, 100, 5, kinematics="small", temperature=temperature))
        out = capsys.readouterr().out
        assert printed_friction(out) == f"{float(expected['friction_coefficient']):.5g}"
        assert ("100 mm/s, 5 MPa, -10 degC, height" in out) == (temperature is not None)
    assert cli.main([*SCENE, "--temperature", "60"]) == 2
    assert "rubber zhou2019 is known at one temperature only: give its shift factors" in capsys.readouterr().err


@pytest.mark.parametrize("kinematics", ["small", pytest.param("finite", marks=pytest.mark.thorough)])
def test_kinematics_replaces_that_of_the_config(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], kinematics: str
) -> None:
    overlay = tmp_path / "coarse.yaml"
    overlay.write_text("numerics:\n  finite_columns_min: 64\n  finite_contact_nodes: 8\n  row_growth: 1.4\n")
    assert cli.main([*SCENE, "--kinematics", kinematics, "--config", str(overlay)]) == 0
    expected = simulate(load(CONFIG, overlay).scene(1, 100, 5, kinematics=kinematics))
    out = capsys.readouterr().out
    assert printed_friction(out) == f"{float(expected['friction_coefficient']):.5g}"
    assert f"plane stress, {kinematics} strain\n" in out
    assert re.search(rf"^kinematics +{kinematics} strain was asked for$", out, re.MULTILINE)


def test_writes_the_result_where_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    target = tmp_path / "new" / "scene.nc"
    assert cli.main([*SCENE, "--output", str(target)]) == 0
    out = capsys.readouterr().out
    assert out.endswith(f"\nWritten to {target}\n")
    result = dataset.read(target)
    assert result.attrs["scene"] == "scale1_v100_p5_aspect0.75_stress"
    assert printed_friction(out) == f"{float(result['friction_coefficient']):.5g}"


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (["--velocity", "-1"], "velocity is -1 mm/s, but must be greater than 0"),
        (["--pressure", "0"], "pressure is 0 MPa, but must be greater than 0"),
        (["--pressure", "nan"], "pressure is nan, but must be a finite number"),
        (["--velocity", "inf"], "velocity is inf, but must be a finite number"),
        (["--aspect", "0"], "aspect is 0, but must be greater than 0"),
        (["--scale", "5"], "scale is 5, but must be one of the road's scales, 1 to 4"),
        (["--scale", "0"], "scale is 0, but must be a whole number of at least 1"),
    ],
)
def test_bad_value_gives_one_sentence(options: list[str], sentence: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main([*SCENE, *options]) == 2
    captured = capsys.readouterr()
    assert captured.err == f"rubfric: {sentence}\n"
    assert captured.out == ""


def test_bad_config_gives_one_sentence(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    overlay = tmp_path / "bad.yaml"
    overlay.write_text("grid:\n  velocity: [1]\n")
    assert cli.main([*SCENE, "--config", str(overlay)]) == 2
    error = capsys.readouterr().err
    assert error.startswith("rubfric: grid has the unknown key 'velocity'; allowed are velocities, pressures, aspect")
    assert error.count("\n") == 1
    for given, says in {
        tmp_path / "bod.yaml": f"there is no file {tmp_path}/bod.yaml (did you mean {overlay}?)",
        tmp_path / "street.yaml": f"there is no file {tmp_path}/street.yaml",
        tmp_path: f"{tmp_path} is a folder, but must be a file in YAML",
    }.items():
        assert cli.main([*SCENE, "--config", str(given)]) == 2
        assert capsys.readouterr().err == f"rubfric: {says}\n"


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["simulate", "--scale", "1", "--velocity", "1"], "required: --pressure"),
        ([*SCENE, "--velocity", "fast"], "invalid float value: 'fast'"),
        ([*SCENE, "--scale", "1.5"], "'1.5' is neither the number of a scale nor 'all'"),
        ([*SCENE, "--plane", "flat"], "invalid choice: 'flat'"),
        ([*SCENE, "--kinematics", "large"], "invalid choice: 'large'"),
        ([*SCENE, "--aspct=1"], "rubfric simulate: error: unrecognized arguments: --aspct=1 (did you mean --aspect?)"),
        (["simulat"], "invalid choice: 'simulat'"),
    ],
)
def test_wrong_usage_is_refused(arguments: list[str], says: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as caught:
        cli.main(arguments)
    assert caught.value.code == 2
    assert says in capsys.readouterr().err


def test_scene_without_a_result_is_no_bad_input(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(contact, "MOST_STEPS", 1)
    target = tmp_path / "scene.nc"
    assert cli.main([*SCENE, "--pressure", "0.5", "--output", str(target)]) == 1
    error = capsys.readouterr().err
    assert re.fullmatch(
        r"rubfric: scale1_v100_p0.5_aspect0.75_stress: not converged after 1 steps, .* is \d+; .*\n", error
    )
    assert not target.exists()


def test_place_that_cannot_be_written_is_no_bad_input(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "file").touch()
    assert cli.main([*SCENE, "--output", str(tmp_path / "file" / "scene.nc")]) == 1
    out, error = capsys.readouterr()
    assert "friction coefficient" in out  # the answer is not lost
    assert str(tmp_path / "file") in error
    assert error.count("\n") == 1


def test_folder_is_no_output(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main([*SCENE, "--output", str(tmp_path)]) == 2
    assert capsys.readouterr() == ("", f"rubfric: --output is the folder {tmp_path}, but must be a file\n")


def test_overlay_needs_no_more_than_its_changes(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    overlay = tmp_path / "mine.yaml"
    overlay.write_text("plane: strain\n")
    scene = [word for word in SCENE if word not in {"--config", str(CONFIG)}]
    assert cli.main([*scene, "--config", str(overlay)]) == 0
    assert "plane strain" in capsys.readouterr().out


def test_first_of_several_is_taken_and_named(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "two.yaml").write_text("road: [fine, zhou2019]\nroads: {fine: [{amplitude: 0.01, wavelength: 0.2}]}")
    options = ["--scale", "1", "--velocity", "100", "--pressure", "1", "--kinematics", "small"]
    assert cli.main(["simulate", *options, "--config", str(tmp_path / "two.yaml")]) == 0
    said = capsys.readouterr()
    assert said.err == "rubfric: of rubber zhou2019 and roads fine, zhou2019, this is zhou2019 on fine, the first\n"
    assert "zhou2019 on scale 1: 0.01 mm sin(31.4159/mm x)" in said.out


def test_version_is_that_of_the_package(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as caught:
        cli.main(["--version"])
    assert caught.value.code == 0
    assert capsys.readouterr().out == f"rubfric {rubfric.__version__}\n"


def test_config_of_the_working_folder_is_laid_over_the_default_unless_it_is_something_else(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert base_configs() == [PAPER]
    assert PAPER.read_text() == CONFIG.read_text()
    local = Path("config/config.yaml")
    local.parent.mkdir()
    for text, found in (
        ("samples: samples.tsv\n", [PAPER]),
        ("plane: strain\n", [PAPER, local]),
        (CONFIG.read_text(), [local]),
    ):
        local.write_text(text)
        assert base_configs() == found


def test_complete_config_takes_the_place_of_the_default() -> None:
    whole, mine = read_yaml(PAPER), {"grid": {"aspect": 0.5}}
    assert layers(mine, mine)[-1] == mine
    assert layers(mine, mine)[0] == whole
    # That of a module may hold what the command line of the run gave, which is laid over it then, as elsewhere.
    assert layers(whole, mine) == [whole]
    merged = whole | {"grid": whole["grid"] | mine["grid"]}
    assert layers(merged, mine) == [merged, mine]


def test_reader_that_is_gone_is_no_error_and_files_are_written_all_the_same(tmp_path: Path) -> None:
    """As in ``rubfric ... | head -1``, here with a reader that is gone from the start."""
    reading, writing = os.pipe()
    os.close(reading)
    command = [sys.executable, "-m", "rubfric.cli", *SCENE, "--output", str(tmp_path / "scene.nc")]
    done = subprocess.run(command, stdout=writing, stderr=subprocess.PIPE, text=True, check=False, cwd=tmp_path)
    os.close(writing)
    assert (done.returncode, done.stderr) == (0, "")
    assert dataset.read(tmp_path / "scene.nc").attrs["scene"] == "scale1_v100_p5_aspect0.75_stress"


@pytest.mark.parametrize(
    ("redirection", "status", "error"),
    [(">&-", 0, "usage: rubfric"), (">/dev/full", 1, "rubfric: standard output could not be written (No space left")],
)
def test_output_that_is_closed_or_full(tmp_path: Path, redirection: str, status: int, error: str) -> None:
    command = f"exec {shlex.quote(sys.executable)} -m rubfric.cli --help {redirection}"
    done = subprocess.run(["sh", "-c", command], stderr=subprocess.PIPE, text=True, check=False, cwd=tmp_path)
    assert done.returncode == status
    assert done.stderr.startswith(error)
    assert "Error" not in done.stderr


def test_shell_sees_exit_code_and_sentence(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "rubfric.cli", *SCENE, "--velocity", "0"]
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=tmp_path)
    assert done.returncode == 2
    assert done.stderr == "rubfric: velocity is 0 mm/s, but must be greater than 0\n"
