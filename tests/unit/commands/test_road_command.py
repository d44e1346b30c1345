"""A road from the shell: a measured profile to a config that the program takes, and a page."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from rubfric import Scene, load
from rubfric.cli import main
from rubfric.errors import InvalidInput, NotConverged
from rubfric.profile.analysis import analyse
from rubfric.profile.cleaning import clean
from rubfric.profile.reading import read
from rubfric.profile.virtual import as_measured, self_affine
from rubfric.results.road_friction import Block
from rubfric.results.tables import read_table
from rubfric.studies import windows

ROOT = Path(__file__).resolve().parents[3]


@pytest.fixture
def street(tmp_path: Path, rng: np.random.Generator, monkeypatch: pytest.MonkeyPatch) -> str:
    monkeypatch.chdir(tmp_path)
    heights = as_measured(rng, self_affine(rng, 8192, 0.05, 0.8, 0.01, longest=30.0), 30, 20)[0]
    rows = "\n".join(f"{0.05 * at:.2f},{'' if np.isnan(z) else f'{z:.4f}'}" for at, z in enumerate(heights))
    Path("street.csv").write_text(f"distance (mm),height (mm)\n{rows}\n", encoding="utf-8")
    return "street.csv"


def test_from_a_profile_to_a_config_and_a_page(street: str, capsys: pytest.CaptureFixture[str]) -> None:
    # What it wrote itself it may write again.
    Path("road_street.yaml").write_text("# Written by rubfric road read, from street.csv\n", encoding="utf-8")
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


def test_sliding_over_windows_gives_friction_with_the_error_of_the_road(
    street: str, capsys: pytest.CaptureFixture[str]
) -> None:
    given = ["road", "slide", street, "--velocity", "100", "10", "--pressure", "0.3", "--windows", "3"]
    assert main([*given, "--kinematics", "small", "--plane", "strain", "--cutoff", "4", "2", "--scales", "2"]) == 0
    assert "± " in capsys.readouterr().out
    table = read_table("friction_street.csv", ["way", "note"])
    direct = table[table["way"] == "direct"]
    assert direct["windows"].tolist() == [3] * 4
    assert direct["friction_road_error"].to_numpy() == pytest.approx(
        direct["friction_scatter"] / np.sqrt(3.0), rel=1e-5
    )
    assert direct["friction_coefficient"].to_numpy() == pytest.approx(direct["friction_persson"], rel=0.4)
    # A finer cutoff adds friction, and so does theory for the cutoffs beyond.
    assert ((direct["contact_fraction"] / direct["contact_persson"]).between(0.5, 2.0)).all()
    whole, total = (table.loc[table["way"] == way, "friction_coefficient"].to_numpy() for way in ("sines", "sum"))
    assert (whole < total).all()
    assert whole == pytest.approx(direct.loc[direct["cutoff_mm"] == 2.0, "friction_coefficient"].to_numpy(), rel=0.5)
    for _, rows in table[table["way"].isin(["direct", "persson"])].groupby("velocity_mm_per_s"):
        assert rows["cutoff_mm"].is_monotonic_decreasing
        assert rows["friction_coefficient"].is_monotonic_increasing
        assert rows["way"].tolist()[:3] == ["direct", "direct", "persson"]
    page = Path("friction_street.html").read_text(encoding="utf-8")
    assert page.count("data:image/png;base64,") == 2
    assert main([*given, "--windows", "99"]) == 2
    assert "--windows is 99, but the profile has 10 of 40 mm" in capsys.readouterr().err


def test_length_blend_and_height_are_varied_one_by_one_over_the_same_stretch(street: str) -> None:
    given = ["road", "slide", street, "--velocity", "100", "--pressure", "0.3", "--windows", "2", "--cutoff", "4"]
    few = ["--kinematics", "small", "--window", "40", "20", "--blend", "0.1", "0.3", "--block-height", "8", "16"]
    assert main([*given, *few]) == 0
    table = read_table("friction_street.csv", ["way", "note"])
    names = ["window_mm", "blend", "block_height_mm", "windows"]
    assert table[names].to_numpy().tolist() == [[40, 0.1, 8, 2], [20, 0.1, 8, 4], [40, 0.3, 8, 2], [40, 0.1, 16, 2]]
    assert table["friction_coefficient"].nunique() == 4
    assert "Windows and block on street" in Path("friction_street.html").read_text(encoding="utf-8")
    # The first row is what the same command without the others gives.
    assert main([*given, "--kinematics", "small"]) == 0
    alone = read_table("friction_street.csv", ["way", "note"])
    assert alone["friction_coefficient"].iloc[0] == pytest.approx(table["friction_coefficient"].iloc[0], rel=1e-5)
    assert main([*given, *few, "--scales", "2"]) == 2


@pytest.mark.parametrize("too_light", [True, False])
def test_a_window_that_is_refused_is_counted_and_left_out(
    street: str, monkeypatch: pytest.MonkeyPatch, too_light: bool
) -> None:
    def refusing(scene: Scene) -> dict[str, float]:
        if scene.road.amplitudes[0] == roads[1].amplitudes[0]:
            raise InvalidInput(f"{scene.name} is light") if too_light else NotConverged(scene.name, 3, 0.5, "residual")
        return dict.fromkeys(("friction_coefficient", "friction_coefficient_error", "contact_fraction"), 0.25)

    found = analyse(clean(read(street)), cutoff=4.0, scales=1)
    roads = [found.road(number) for number in (1, 2, 3)]
    monkeypatch.setattr(windows, "simulate", refusing)
    campaign = load()
    block = Block(campaign.material, 8.0, "strain", "small", campaign.numerics)
    row = windows.slide(found, block, [100.0], [0.3], [4.0], 3).iloc[0]
    assert (row["windows"], row["refused"], row["friction_coefficient"]) == (2, 1, 0.25)
    assert row["note"].startswith("window 2: all_v100_p0.3")
