"""A rubber of the config that was measured: where its file is, what is refused, and that it is fitted once."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml

from rubfric import InvalidInput, Scene, load
from rubfric.config import fitting
from rubfric.config.campaign import Campaign
from rubfric.config.measured import MeasuredRubber
from rubfric.config.models import Config
from rubfric.config.overlay import overlaid, placed, read_yaml
from rubfric.runner.opening import understood

ROOT = Path(__file__).resolve().parents[3]
CONFIG, DMA = ROOT / "config" / "config.yaml", ROOT / "examples" / "own_rubber" / "dma.csv"
ENTRY = {"measurements": "data/dma.csv", "law": "wlf", "uncertainty": 10}


@pytest.fixture
def mine(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A config in a folder below the working folder, and its data below that."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "configs" / "data").mkdir(parents=True)
    (tmp_path / "configs" / "data" / "dma.csv").write_bytes(DMA.read_bytes())
    path = Path("configs/mine.yaml")
    path.write_text(yaml.safe_dump({"rubber": "mine", "rubbers": {"mine": ENTRY}}))
    return path


def entry(**changes: Any) -> MeasuredRubber:
    return MeasuredRubber.read("rubbers.mine", {**ENTRY, "measurements": str(DMA), **changes})


def test_file_counts_from_the_folder_of_the_config_that_names_it(mine: Path) -> None:
    campaign = load(CONFIG, mine)
    assert campaign.fitted is not None
    assert campaign.fitted.source == str(Path("configs/data/dma.csv"))
    assert campaign.material.youngs_modulus == pytest.approx(4.17, rel=0.01)
    # What Snakemake has read is the same, whatever other files say.
    other = Path("other.yaml")
    other.write_text("rubbers: {mine: {measurements: x.csv, seed: 2}}")
    held = yaml.safe_load(mine.read_text())
    assert placed(held, [CONFIG, mine])["rubbers"]["mine"] == read_yaml(mine)["rubbers"]["mine"]
    assert placed(held, [other, mine]) == placed(held, [mine, other]) == read_yaml(mine)
    assert placed({"rubbers": {"mine": {"measurements": "from/here.csv"}}}, [mine]) == {
        "rubbers": {"mine": {"measurements": "from/here.csv"}}
    }
    for path in ("/data/dma.csv", "~/dma.csv", "$HOME/dma.csv"):
        mine.write_text(yaml.safe_dump({"rubbers": {"mine": {"measurements": path}}}))
        assert read_yaml(mine)["rubbers"]["mine"]["measurements"] == path


def test_scenes_have_the_fitted_rubber_and_what_it_leaves_open(mine: Path) -> None:
    campaign = load(CONFIG, mine, {"claims": {"compare": []}})
    scene = campaign.scene(1, 100, 0.5)
    assert scene.material == campaign.material
    assert scene.measured is not None
    assert len(scene.measured.samples) == 10
    assert Scene.from_parameters(json.loads(json.dumps(scene.parameters()))) == scene
    assert scene.digest != replace(scene, measured=None).digest
    assert campaign.reading("plane_strain").fitted == campaign.fitted
    assert campaign.reading("instantaneous_moduli").fitted is None  # another rubber than the one that was fitted
    assert replace(campaign, fitted=None).scene(1, 100, 0.5).measured is None
    lines = understood(campaign, own=True)
    (said,) = (line for line in lines if "is fitted to" in line)
    assert said.startswith(
        "rubber mine is fitted to configs/data/dma.csv: 6 branches, WLF shifts, measured from 0.628 "
    )
    assert "beyond" not in said
    fast = understood(replace(campaign, velocities=(1e-3, 1e9)), own=True)
    assert any("from 0.035 rad/s up and up to 3e+11 rad/s, beyond that" in line for line in fast)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"measurements": "none.csv"}, "rubbers.mine.measurements is 'none.csv', but there is no such file"),
        (
            {"law": "wfl"},
            "rubbers.mine.law is 'wfl', but must be one of auto, wlf, arrhenius, free (did you mean wlf?)",
        ),
        ({"youngs_modulus": 3.0}, "both measurements and youngs_modulus, but youngs_modulus follows from"),
        ({"uncertainty": 15}, "rubbers.mine.uncertainty is 15, but must be a multiple of 10"),
        ({"columns": {"storge": "E"}}, "rubbers.mine.columns has the unknown key 'storge'"),
        ({"poissons_ratio": 0.4, "bulk_modulus": 2000}, "has both poissons_ratio and bulk_modulus"),
        ({"bulk_modulus": 2}, "rubbers.mine: the bulk modulus is 2 MPa, but must be at least"),
        ({"units": {"storage": "furlong"}}, "rubbers.mine: "),
        ({"columns": {"storage": "E"}}, "under columns"),
        ({"reference_temperature": 90}, "rubbers.mine: "),
        ({"lw": 1}, "rubbers.mine has the unknown key 'lw'; allowed are measurements, reference_temperature"),
    ],
)
def test_a_wrong_entry_is_refused_in_a_sentence(changes: dict[str, Any], words: str) -> None:
    with pytest.raises(InvalidInput) as error:
        fitting.fitted_rubber("mine", entry(**changes))
    assert words in str(error.value)


def test_a_rubber_without_measurements_is_as_before() -> None:
    with pytest.raises(InvalidInput, match=r"rubbers\.mine lacks the key 'poissons_ratio'"):
        load(CONFIG, {"rubbers": {"mine": {"youngs_modulus": 3}}})


def test_same_data_options_and_code_are_fitted_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    found = fitting.fitted_rubber("mine", entry(), tmp_path)
    fits: list[str] = []
    fitting._remembered.cache_clear()

    def fit(digest: str, *_: Any) -> Any:
        fits.append(digest)
        return found

    monkeypatch.setattr(fitting, "_fit", fit)
    copied = tmp_path / "copy.csv"
    copied.write_bytes(DMA.read_bytes())
    again = fitting.fitted_rubber("mine", entry(measurements=str(copied)), tmp_path)
    assert (again, fits) == (replace(found, source=str(copied)), [])
    place = tmp_path / "mine.json"
    for broken in ("", "{}", json.dumps({"digest": json.loads(place.read_text())["digest"], "rubber": {}})):
        place.write_text(broken)
        fitting.fitted_rubber("mine", entry(), tmp_path)
    assert len(fits) == 3
    copied.write_bytes(DMA.read_bytes() + b"\n")
    for changed in (entry(seed=2), entry(measurements=str(copied)), entry(vertical="entropic")):
        fitting.fitted_rubber("mine", changed, tmp_path)
    monkeypatch.setattr(fitting, "_code", lambda: b"other")
    fitting.fitted_rubber("mine", entry(), tmp_path)
    assert len(set(fits)) == 5


def test_at_another_temperature_it_is_the_rubber_fitted_there() -> None:
    warm, cold = (fitting.fitted_rubber("mine", entry(reference_temperature=one)) for one in (20, -10))
    material, measured = warm.at(-10.0)
    frequency = np.geomspace(*measured.window, 20)
    assert warm.at() == warm.at(20.0) == (warm.material, warm.measured)
    assert measured.window == pytest.approx(cold.measured.window, rel=0.02)
    assert material.complex_shear_modulus(frequency) == pytest.approx(
        cold.material.complex_shear_modulus(frequency), rel=0.02
    )
    # Samples are shifted by their own factors: the scatter of C1 and C2 adds to that of the moduli.
    assert len({sample.times[0] for sample in measured.samples}) == 10
    for sample, own in zip(measured.samples, warm.measured.samples, strict=True):
        assert sample.times[0] / own.times[0] == pytest.approx(
            material.relaxation_times[0] / warm.material.relaxation_times[0], rel=0.05
        )


def test_temperatures_of_the_grid_are_those_of_its_own_shift_factors(mine: Path) -> None:
    campaign = load(CONFIG, mine, {"grid": {"temperatures": [-10, 20]}})
    assert campaign.fitted is not None
    scenes = [campaign.scene(1, 100, 0.5, temperature=one) for one in (-10, 20)]
    assert [(scene.material, scene.measured) for scene in scenes] == [campaign.fitted.at(one) for one in (-10.0, 20.0)]
    assert any("from 3.5e-07 rad/s up at -10 degC, measured from 0.006" in line for line in _slow(campaign))
    with pytest.raises(InvalidInput, match=r"grid\.temperatures has -150 degC, but the WLF equation holds above"):
        load(CONFIG, mine, {"grid": {"temperatures": [-150, 20]}})
    master = {"data": "master", "measurements": "master.csv"}
    rows = "\n".join(f"{10.0**n},{2.0 + n / (9.0 - n)},{0.1 + 0.05 * n}" for n in range(8))
    Path("master.csv").write_text(f"frequency (rad/s),E' (MPa),E'' (MPa)\n{rows}\n")
    with pytest.raises(InvalidInput, match="or moduli measured at several temperatures"):
        load(CONFIG, {"rubber": "m", "rubbers": {"m": master}, "grid": {"temperatures": [20]}})


def _slow(campaign: Campaign) -> list[str]:
    return understood(replace(campaign, velocities=(1e-8, 1.0)), own=True)


def test_schema_takes_either_kind_of_rubber() -> None:
    given = overlaid([CONFIG, {"rubbers": {"mine": {**ENTRY, "measurements": str(DMA)}}}], Config.model_fields)
    kinds = {name: type(one).__name__ for name, one in Config.read("", given).rubbers.items()}
    assert kinds == {"zhou2019": "Rubber", "mine": "MeasuredRubber"}
