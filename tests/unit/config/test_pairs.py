"""Several rubbers and roads in one config."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from rubfric import InvalidInput, load
from rubfric.config.pairs import not_covered, which

SOFT = {"youngs_modulus": 2.5, "poissons_ratio": 0.49, "shear_fractions": [0.2, 0.6], "relaxation_times": [1e-3, 1e-5]}
OWN: dict[str, Any] = {
    "rubbers": {"soft": SOFT},
    "roads": {"fine": [{"amplitude": 0.01, "wavelength": 0.2}, {"amplitude": 0.003, "wavelength": 0.05}]},
    "grid": {"velocities": [1, 100], "pressures": [0.5], "aspect": 0.75},
}
ROOT = Path(__file__).resolve().parents[3]


def test_every_pair_is_the_campaign_of_its_own_names() -> None:
    phases = {"phases": {"draws": 3}}
    both = load(OWN, phases | {"rubber": ["soft", "zhou2019"], "road": ["zhou2019", "fine"]})
    assert [*both.pairs] == [(rubber, road) for rubber in ("soft", "zhou2019") for road in ("zhou2019", "fine")]
    for (rubber, road), one in both.pairs.items():
        alone = load(OWN, phases | {"rubber": rubber, "road": road})
        assert one.scenes() == alone.scenes()
        assert one.whole_scenes() == alone.whole_scenes()
        assert one.whole_parameters() == alone.whole_parameters()
    said = which(both)
    assert said == "of rubbers soft, zhou2019 and roads zhou2019, fine, this is soft on zhou2019, the first"


def test_a_list_of_one_is_its_name() -> None:
    listed, plain = (load(OWN, {"rubber": rubber, "road": "fine"}) for rubber in (["soft"], "soft"))
    assert listed == plain
    assert which(listed) == ""


def test_sections_beyond_the_grid_are_of_the_first_pair() -> None:
    study = {"aspect_study": {"aspects": [0.5], "scales": [4]}, "claims": {"compare": []}, "rig": {}, "transient": {}}
    first, other = load(OWN, study | {"road": ["zhou2019", "fine"]}).pairs.values()
    assert len(first.scenes()) == 4 * 2 + 2
    assert len(other.scenes()) == 2 * 2
    assert first.rig
    assert (other.rig, other.claims, other.transient) == (None, None, None)
    with pytest.raises(InvalidInput, match=r"aspect_study.scales is 4, but must be one of the road's scales, 1 to 2"):
        load(OWN, study | {"road": ["fine", "zhou2019"]})


def test_faults_of_all_rubbers_and_roads_are_named_each_once() -> None:
    measured = {"rubbers": {"x": {"measurements": "x.csv"}, "y": {"measurements": "y.csv"}}}
    with pytest.raises(InvalidInput) as caught:
        load(OWN, measured | {"rubber": ["x", "soft", "y"], "road": ["fine", "zhou2019"]})
    assert [fault.partition(",")[0] for fault in caught.value.faults] == [
        "rubbers.x.measurements is 'x.csv'",
        "rubbers.y.measurements is 'y.csv'",
    ]
    with pytest.raises(
        InvalidInput, match=r"20 degC, but rubber soft is known at one temperature only: .*rubbers.soft"
    ):
        load(OWN, {"rubber": ["shifted", "soft"], "rubbers": {"shifted": SHIFTED}, "grid": {"temperatures": [20]}})
    steep = {"roads": {"steep": [{"amplitude": 10, "wavelength": 0.1}]}}
    with pytest.raises(InvalidInput) as caught:
        load(OWN, steep | {"rubber": ["soft", "zhou2019"], "road": ["fine", "steep"]})
    (fault,) = caught.value.faults
    assert fault.startswith("scale 1 of road steep, ")


SHIFTED = {**SOFT, "shift": {"law": "wlf", "c1": 8, "c2": 100, "reference_temperature": 20}}


@pytest.mark.thorough
def test_what_no_error_covers_is_named() -> None:
    assert not_covered(load(OWN)) == ["data of rubber zhou2019", "other phases of road zhou2019"]
    assert not_covered(load(OWN, {"phases": {"draws": 2}, "rubber": "soft"})) == ["data of rubber soft"]
    street = {"profile": str(ROOT / "examples/own_road/street.csv"), "scales": 2, "cutoff": 4}
    roads = {
        "fine": OWN["roads"]["fine"],
        "sines": street,
        "one": street | {"windows": 1},
        "two": street | {"windows": 2},
    }
    dma = {"measurements": str(ROOT / "examples/own_rubber/dma.csv")}
    rubbers = {"fit": dma, "banded": dma | {"uncertainty": 10}}
    several = load({"rubbers": rubbers, "roads": roads, "rubber": [*rubbers], "road": [*roads], "grid": OWN["grid"]})
    said = {pair: not_covered(one) for pair, one in several.pairs.items()}
    assert said["fit", "two"] == ["scatter of the data of rubber fit"]
    assert said["banded", "two"] == []
    assert said["banded", "one"] == ["other windows of road one"]
    assert said["banded", "sines"] == ["other phases of road sines, what its sines leave out of the profile"]
    assert said["fit", "fine"][1:] == ["other phases of road fine"]
