"""Rubbers from the shell: measured moduli to a config that the program takes, and decks."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from synthetic_dma import measured, table_1

from rubfric import load
from rubfric.cli import main

ROOT = Path(__file__).resolve().parents[3]
CONFIG = ROOT / "config/config.yaml"


@pytest.fixture
def dma(tmp_path: Path, rng: np.random.Generator, monkeypatch: pytest.MonkeyPatch) -> str:
    monkeypatch.chdir(tmp_path)
    points = measured(table_1(), np.array([-45.0, -35, -25, -10, 0, 20]), np.geomspace(0.1, 100.0, 8), 0.01, rng)
    rows = "\n".join(",".join(f"{value:.5g}" for value in row) for row in zip(*points, strict=True))
    Path("dma.csv").write_text(f"T (C),omega (rad/s),storage (MPa),loss (MPa)\n{rows}\n", encoding="utf-8")
    return "dma.csv"


def test_from_measured_moduli_to_a_config_and_a_deck(dma: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["rubber", "fit", dma]) == 2
    assert "say --modulus E or --modulus G" in capsys.readouterr().err
    arguments = ["rubber", "fit", dma, "--modulus", "E", "--name", "mine", "--samples", "20", "--law", "wlf"]
    assert main(arguments) == 0
    said = capsys.readouterr().out
    assert "Law of shifting: WLF" in said
    assert "Written to rubber_mine.yaml and rubber_mine.html" in said
    material = load(CONFIG, "rubber_mine.yaml").material
    assert material.name == "mine"
    warm = load(CONFIG, "rubber_mine.yaml", {"grid": {"temperatures": [0, 40]}})
    assert warm.shift
    assert warm.shift.law == "wlf"
    assert warm.scene(1, 1.0, 1.0, temperature=40.0).material.relaxation_times[0] == pytest.approx(
        warm.shift.factor(40.0) * material.relaxation_times[0], rel=1e-11
    )
    assert material.long_term_shear_modulus == pytest.approx(4.17 / 2.98, rel=0.02)
    page = Path("rubber_mine.html").read_text(encoding="utf-8")
    assert page.count("data:image/png;base64,") == 7
    assert "C2" in page
    given = ["rubber", "write", "--config", str(CONFIG), "--config", "rubber_mine.yaml"]
    for _ in range(2):  # what it wrote itself it may write again
        assert main([*given, "--code", "ansys", "--output", "mine.mac"]) == 0
        assert main(["rubber", "read", "mine.mac", "--name", "back", "--output", "back.yaml"]) == 0
    frequency = np.geomspace(1.0, 1e10, 20)
    back = load(CONFIG, "back.yaml").material
    assert back.complex_shear_modulus(frequency) == pytest.approx(material.complex_shear_modulus(frequency), rel=1e-8)
    assert main([*given, "--code", "abaqus"]) == 0
    assert "*TRS" in capsys.readouterr().out
    assert main([*given, "--code", "lsdyna", "--temperature", "40"]) == 0
    assert main([*given, "--code", "abaqus", "--rubber", "zhou2019"]) == 0
    assert "*MATERIAL, NAME=zhou2019" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["fit", "none.csv"], "none.csv"),
        (["fit", "dma.csv", "--output", "dma.csv"], "dma.csv exists and was not written by this command"),
        (["fit", "dma.csv", "--output", "a.html"], "must be the file of the rubber"),
        (["fit", "dma.csv", "--samples", "1"], "--samples is 1, but must be at least 20"),
        (["fit", "dma.csv", "--columns", "wrong.yaml"], "columns in wrong.yaml"),
        (["fit", "dma.csv", "--name", "a b"], "--name is 'a b'"),
        (["read", "dma.csv"], "no Prony series of a code that is known"),
        (["write", "--config", str(CONFIG), "--code", "abaqus", "--rubber", "zhou"], "did you mean zhou2019?"),
    ],
)
def test_wrong_arguments(arguments: list[str], words: str, dma: str, capsys: pytest.CaptureFixture[str]) -> None:
    Path("wrong.yaml").write_text("columns: {speed: v}\n", encoding="utf-8")
    assert main(["rubber", *arguments]) == 2
    assert words in capsys.readouterr().err
