"""A march step by step: what it records, the first law, restart, halved steps; small and finite strain alike."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from finite_fields import ELASTIC, PROPORTIONAL, RUBBER

from rubfric.errors import BrokenResult, NotConverged
from rubfric.marching import begin
from rubfric.mechanics.march.march import FRESH, March, Record, wavelength_means
from rubfric.mechanics.march.step import Outcome
from rubfric.rubber.material import Material
from rubfric.scene.numerics import Numerics
from rubfric.scene.procedure import PHASES, Procedure
from rubfric.scene.scene import Scene

SceneMaker = Callable[..., Scene]
KINDS = pytest.mark.parametrize("kinematics", ["small", "finite"])
PLANES = pytest.mark.parametrize("plane", ["strain", "stress"])
# The soft rubber relaxes in 1e-3 s and 1e-5 s; at 100 mm/s a wavelength lasts 1.8e-3 s.
QUICK = Procedure(
    columns=16, steps_per_wavelength=16, loading_steps=8, hold_steps=4, wavelengths=2, until_saturated=False
)


@pytest.fixture
def soft_scene(paper_scene: SceneMaker) -> SceneMaker:
    def build(kinematics: str, plane: str = "strain", material: Material = RUBBER, velocity: float = 100.0) -> Scene:
        coarse = Numerics(row_growth=1.6, contact_nodes=4, finite_contact_nodes=4)
        return paper_scene(velocity, 0.5, kinematics=kinematics, plane=plane, material=material, numerics=coarse)

    return build


@KINDS
@PLANES
@pytest.mark.parametrize("dilatation", ["auto", "pointwise", "mean"])
def test_march_integrates_dilatation_as_asked_for(
    soft_scene: SceneMaker, kinematics: str, plane: str, dilatation: str
) -> None:
    scene = soft_scene(kinematics, plane)
    march = begin(replace(scene, numerics=replace(scene.numerics, dilatation=dilatation)), QUICK)
    assert march.block.dilatation == dilatation
    march.step()
    assert march.position == 1


def marched(scene: Scene, procedure: Procedure = QUICK) -> March:
    march = begin(scene, procedure)
    while not march.ended:
        march.step()
    return march


@KINDS
@PLANES
def test_everything_is_recorded(soft_scene: SceneMaker, kinematics: str, plane: str) -> None:
    march = marched(soft_scene(kinematics, plane))
    records = march.records
    assert tuple(records) == Record._fields
    assert {len(column) for column in records.values()} == {march.position} == {8 + 4 + 8 + 32}
    slides = records["phase"] == PHASES.index("slide")
    np.testing.assert_allclose(np.diff(records["slid"][slides]), march.scene.road.wavelength / 16)
    assert np.all(np.diff(records["time"]) > 0.0)
    assert np.all(records["dissipated"] >= 0.0)
    assert np.all(records["stored_energy"] > 0.0)
    assert np.all((records["contact_fraction"] > 0.0) & (records["contact_fraction"] <= 1.0))
    assert np.isnan(records["friction_work"][records["phase"] <= PHASES.index("hold")]).all()
    assert np.all(
        records["road_work"][records["phase"] == PHASES.index("hold")] < 1e-3 * records["stored_energy"].max()
    )
    # The block rises over the crests by less than the road is high, and stays pressed.
    assert np.ptp(records["top_displacement"][slides]) < 0.5 * march.scene.road.amplitude


@KINDS
@pytest.mark.parametrize(
    "material", [pytest.param(RUBBER, marks=pytest.mark.thorough), PROPORTIONAL], ids=["elastic bulk", "both"]
)
def test_first_law_closes_in_every_step_the_better_the_shorter_it_is(
    soft_scene: SceneMaker, kinematics: str, material: Material
) -> None:
    missing = []
    for finer in (1, 4):
        procedure = Procedure(
            columns=16,
            steps_per_wavelength=32 * finer,
            loading_steps=8 * finer,
            hold_steps=4 * finer,
            wavelengths=1,
            until_saturated=False,
        )
        records = marched(soft_scene(kinematics, material=material), procedure).records
        turned = np.abs(records["road_work"]).sum() + np.abs(records["load_work"]).sum()
        missing.append(np.abs(records["imbalance"]).sum() / turned)
    assert missing[0] < 0.03
    # Nodes that come into contact within a step keep this from a factor of 16.
    assert missing[1] < missing[0] / 5.0


@KINDS
@PLANES
def test_elastic_rubber_has_no_friction_over_a_wavelength(soft_scene: SceneMaker, kinematics: str, plane: str) -> None:
    march = marched(soft_scene(kinematics, plane, ELASTIC))
    records = march.records
    slides = records["phase"] == PHASES.index("slide")
    assert not records["dissipated"].any()
    friction = records["friction_contact"][slides]
    assert np.all(np.abs(friction.reshape(2, 16).mean(axis=1)) < 2e-4)
    # Steps of one column find the block as it was, and the same on the way there as on the way back.
    np.testing.assert_allclose(records["stored_energy"][slides], records["stored_energy"][slides][0], rtol=1e-4)


@KINDS
@PLANES
def test_restart_goes_on_to_the_last_digit(soft_scene: SceneMaker, kinematics: str, plane: str, tmp_path: Path) -> None:
    scene = soft_scene(kinematics, plane, PROPORTIONAL)
    march = begin(scene, QUICK)
    while not march.ended:
        if march.position == FRESH:
            march.save(tmp_path / "march.npz")
        march.step()
    again = begin(scene, QUICK)
    again.restore(tmp_path / "march.npz")
    assert again.position == FRESH
    while not again.ended:
        again.step()
    for name, column in march.records.items():
        np.testing.assert_array_equal(again.records[name], column, err_msg=name)


def test_restart_may_slide_further_but_not_otherwise(soft_scene: SceneMaker, tmp_path: Path) -> None:
    scene = soft_scene("small")
    marched(scene).save(tmp_path / "march.npz")
    further = Procedure(**{**vars(QUICK), "wavelengths": 3})
    march = begin(scene, further)
    march.restore(tmp_path / "march.npz")
    assert not march.ended
    march.step()
    for other, procedure in ((soft_scene("small", velocity=50.0), QUICK), (scene, Procedure(columns=16))):
        with pytest.raises(BrokenResult, match="belongs to other work"):
            begin(other, procedure).restore(tmp_path / "march.npz")


@KINDS
@PLANES
def test_start_from_steady_sliding_goes_on_so(soft_scene: SceneMaker, kinematics: str, plane: str) -> None:
    procedure = Procedure(start="steady", columns=16, steps_per_wavelength=32, wavelengths=2, until_saturated=False)
    march = marched(soft_scene(kinematics, plane), procedure)
    first, last = wavelength_means(march.records["friction_contact"], 32)
    assert last == pytest.approx(first, rel=0.03)
    assert last > 0.01


def outcome(**changes: float) -> Outcome:
    given = dict.fromkeys(Outcome.__annotations__, 1.0) | {"iterations": 1, "krylov": 1} | changes
    return Outcome(**given)


def test_steps_that_find_no_contact_are_halved(soft_scene: SceneMaker, monkeypatch: pytest.MonkeyPatch) -> None:
    march = begin(soft_scene("finite"), QUICK)
    length = march.procedure.steps(march.scene).duration[0]
    durations = []

    def advance(duration: float, offset: float, pressure: float) -> Outcome:
        if duration > 0.3 * length:
            raise NotConverged("step", 1, 0.5, "distance from balance and contact")
        durations.append(duration)
        return outcome()

    monkeypatch.setattr(march._model, "advance", advance)
    march.step()
    np.testing.assert_allclose(durations, 0.25 * length)
    records = march.records
    assert records["halvings"] == 3
    assert records["road_work"] == records["dissipated"] == 4.0
    assert records["stored_energy"] == 1.0


def test_steps_that_halving_does_not_help_raise(soft_scene: SceneMaker, monkeypatch: pytest.MonkeyPatch) -> None:
    march = begin(soft_scene("finite"), QUICK)

    def advance(*_: float) -> Outcome:
        raise NotConverged("step", 1, 0.5, "distance from balance and contact")

    monkeypatch.setattr(march._model, "advance", advance)
    with pytest.raises(
        NotConverged, match=r"scale1_v100_p0\.5_aspect0\.75_strain: not converged after 1 steps"
    ) as caught:
        march.step()
    assert caught.value.residual == 0.5


def test_saturation_ends_the_march(soft_scene: SceneMaker) -> None:
    procedure = Procedure(columns=16, steps_per_wavelength=16, wavelengths=30)
    march = marched(soft_scene("small"), procedure)
    assert march.saturation.reached
    assert 2 <= march.saturation.wavelengths < 30
    assert march.position == 32 + 16 + 8 + 16 * march.saturation.wavelengths
