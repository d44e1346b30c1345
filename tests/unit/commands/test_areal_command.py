"""``rubfric simulate --road``: a scene on an areal road from the shell."""

from __future__ import annotations

from pathlib import Path

import pytest
import yaml

from rubfric.cli import main
from rubfric.results.dataset import read
from rubfric.road.self_affine import SelfAffine

ROUGH = {"hurst": 0.8, "period": 1.0, "cut_off": 0.125, "rms_slope": 0.25}
SCENE = ["--velocity", "100", "--pressure", "0.5", "--nodes", "64"]


@pytest.fixture
def config(tmp_path: Path) -> str:
    path = tmp_path / "mine.yaml"
    path.write_text(yaml.safe_dump({"roads": {"runway": {"areal": {"self_affine": ROUGH}}}}), encoding="utf-8")
    return str(path)


def test_scene_is_simulated_and_written(config: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    output = tmp_path / "areal.nc"
    given = ["simulate", "--road", "runway", *SCENE, "--direction", "30", "--config", config, "--output", str(output)]
    assert main(given) == 0
    said = capsys.readouterr().out
    result = read(output)
    assert f"friction coefficient {float(result.friction_coefficient):.4g}, estimated error" in said
    assert result.attrs["direction"] == 30.0
    assert result.contact_pressure.shape == (64, 64)


def test_scan_is_a_road(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    heights = SelfAffine(**ROUGH).spectrum.heights((64, 64))
    lines = "\n".join(" ".join(f"{1e9 * 1e-3 * one:.3f}" for one in line) for line in heights)
    header = ["aISO-1.0", "NumPoints = 64", "NumProfiles = 64", f"Xscale = {1e-3 / 64}", f"Yscale = {1e-3 / 64}"]
    header += ["Zscale = 1e-9", "Compression = 0", "DataType = 7", "CheckType = 0"]
    scan = tmp_path / "scan.sdf"
    scan.write_text("\n".join(header) + f"\n*\n{lines}\n*\n", encoding="ascii")
    assert main(["simulate", "--road", str(scan), *SCENE, "--cut-off", "0.125"]) == 0
    assert "estimated error" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("more", "says"),
    [
        (["--road", "runway", "--scale", "1"], "--scale is given, but does not go with --road"),
        (
            ["--road", "street"],
            "--road is 'street', but must be an areal road of the config, one of runway, or the file",
        ),
        ([], "--scale is missing: give the number of a scale, or all; or --road and an areal road"),
        (["--road", "runway", "--nodes", "16"], "nodes_max is 16, but must be at least 32"),
    ],
)
def test_wrong_input_is_refused(config: str, more: list[str], says: str, capsys: pytest.CaptureFixture[str]) -> None:
    given = ["simulate", *SCENE, "--config", config, *more]
    assert main(given) == 2
    assert says in capsys.readouterr().err
