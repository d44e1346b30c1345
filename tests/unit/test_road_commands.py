"""A road from the shell: a measured profile to a config that the program takes, and a page."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from rubfric import load
from rubfric.cli import main
from rubfric.profile.virtual import as_measured, self_affine

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture
def street(tmp_path: Path, rng: np.random.Generator, monkeypatch: pytest.MonkeyPatch) -> str:
    monkeypatch.chdir(tmp_path)
    heights = as_measured(rng, self_affine(rng, 8192, 0.05, 0.8, 0.01, longest=30.0), 30, 20)[0]
    rows = "\n".join(f"{0.05 * at:.2f},{'' if np.isnan(z) else f'{z:.4f}'}" for at, z in enumerate(heights))
    Path("street.csv").write_text(f"distance (mm),height (mm)\n{rows}\n", encoding="utf-8")
    return "street.csv"


def test_from_a_profile_to_a_config_and_a_page(street: str, capsys: pytest.CaptureFixture[str]) -> None:
    for _ in range(2):  # what it wrote itself it may write again
        assert main(["road", "read", street, "--scales", "3", "--cutoff", "0.5"]) == 0
    said = capsys.readouterr().out
    for words in (
        "Gaps bridged",
        "Mean profile depth",
        "Hurst exponent",
        "Written to road_street.yaml and road_street",
    ):
        assert words in said
    campaign = load(ROOT / "config/config.yaml", "road_street.yaml")
    assert (campaign.road_name, len(campaign.road)) == ("street", 3)
    assert campaign.whole_road.period < 500.0
    page = Path("road_street.html").read_text(encoding="utf-8")
    assert page.count("data:image/png;base64,") == 6
    assert "wavenumber:" in page


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["none.csv"], "none.csv"),
        (["street.csv", "--output", "street.csv"], "street.csv exists and was not written by this command"),
        (["street.csv", "--output", "a.html"], "must be the file of the road"),
        (["street.csv", "--spacing", "0"], "--spacing is 0 mm"),
        (["street.csv", "--blend", "0.9"], "--blend is 0.9, but must be at most 0.5"),
        (["street.csv", "--scales", "0"], "--scales is 0"),
        (["street.csv", "--window", "500"], "the window is 500 mm long"),
        (["street.csv", "--name", "a b"], "--name is 'a b'"),
    ],
)
def test_wrong_arguments(arguments: list[str], words: str, street: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["road", "read", *arguments]) == 2
    assert words in capsys.readouterr().err
