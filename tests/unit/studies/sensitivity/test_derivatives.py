"""Sensitivities against closed forms, boundary elements and exact identities, and what they say where there is none."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from boundary_element import friction_coefficient

import rubfric
from rubfric.errors import InvalidInput, NotConverged
from rubfric.mechanics.theory.layer import full_contact_friction, full_contact_pressure
from rubfric.rubber.material import Material
from rubfric.rubber.shift import Shift, ShiftedRubber
from rubfric.scene.numerics import Numerics
from rubfric.scene.scene import Scene
from rubfric.studies.sensitivity import sharing, study
from rubfric.studies.sensitivity.differences import difference, errors, solved
from rubfric.studies.sensitivity.parameters import parameters, with_branch

SceneMaker = Callable[..., Scene]
SMALL = {"kinematics": "small", "multiscale": "sum"}


def filled(scene: Scene) -> Scene:
    pressure = full_contact_pressure(scene.material, scene.road, scene.velocity, scene.height, scene.plane)
    return replace(scene, pressure=1.6 * pressure)


def closed_form(scene: Scene) -> float:
    where = (scene.material, scene.road, scene.velocity, scene.pressure, scene.height, scene.plane)
    return math.log(full_contact_friction(*where))


@pytest.mark.parametrize(
    ("plane", "moduli", "bulk", "velocity"),
    [("strain", "long_term", "elastic", 1.0), ("stress", "instantaneous", "proportional", 0.1)],
)
def test_every_sensitivity_in_full_contact_is_that_of_the_closed_form(
    paper_scene: SceneMaker, paper_rubber: Material, plane: str, moduli: str, bulk: str, velocity: float
) -> None:
    material = replace(paper_rubber, moduli=moduli, bulk=bulk)
    scene = filled(paper_scene(velocity, 1.0, plane=plane, material=material, aspect=0.4))
    base, known = solved(scene), parameters(scene)
    found = [difference(base, one, math.log(1.1)) for one in known]
    for one, of, error in zip(known, found, errors(base, found), strict=True):
        exact = (closed_form(one.change(scene, 1e-4)) - closed_form(one.change(scene, -1e-4))) / 2e-4
        assert abs(of.derivative - exact) <= error, one.name
        assert error < 0.05 * abs(exact) + 1e-4, one.name
    assert {one.name for one in known} >= {"E", "nu", "g_1", "g_6", "tau_1", "tau_6", "a", "lambda", "aspect", "p", "v"}


def test_sensitivities_in_partial_contact_are_those_of_boundary_elements(paper_scene: SceneMaker) -> None:
    scene = paper_scene(100.0, 0.5)
    base = solved(scene)
    known = [one for one in parameters(scene) if one.name in ("p", "nu", "g_2", "g_3", "tau_2", "tau_4", "a", "v")]
    found = [difference(base, one, math.log(1.1)) for one in known]
    for one, of, error in zip(known, found, errors(base, found), strict=True):
        there, back = (math.log(friction_coefficient(one.change(scene, t), 1024)) for t in (0.1, -0.1))
        assert abs(of.derivative - (there - back) / 0.2) <= error + 0.002, one.name
        assert error < 0.1 * abs(of.derivative) or one.name == "v", one.name


def test_invariances_hold_on_any_mesh_and_are_reported_with_their_residual() -> None:
    campaign = rubfric.load(SMALL)
    found = rubfric.sensitivity(campaign, 100, 0.5, scale=1, preset="draft")
    residuals = {one.sum: abs(one.residual) for one in found.identities}
    assert residuals.keys() == {"E + p", "sum of tau_i - v", "sum of a_i + lambda + v"}
    assert residuals["E + p"] < 1e-9
    # Steps of each part end in other contacts, so that these vanish within the errors only.
    assert all(abs(one.residual) <= one.error for one in found.identities)
    assert list(found.table["friction_change"].abs()) == sorted(found.table["friction_change"].abs(), reverse=True)
    assert "a 10 % larger p raises friction at 100 mm/s and 0.5 MPa by 3.0" in "\n".join(found.sentences())
    assert repr(found).startswith("<Sensitivities of scale1_v100_p0.5_aspect0.75_stress: friction 0.2")


def test_of_the_whole_road_each_amplitude_counts_and_lengths_change_together() -> None:
    found = rubfric.sensitivity(rubfric.load(SMALL), 1000, 1, only=["a_1", "a_4", "lambda", "v"], preset="draft")
    assert set(found.table["parameter"]) == {"a_1", "a_4", "lambda", "v"}
    assert found.identities == ()
    changed = found.table.set_index("parameter")["changed_to"]
    assert changed["lambda"] == pytest.approx(1.1 * 2 * math.pi / 35)


@pytest.mark.parametrize("moduli", ["long_term", "instantaneous"])
def test_a_branch_changes_while_the_given_modulus_is_held(paper_rubber: Material, moduli: str) -> None:
    material = replace(paper_rubber, moduli=moduli)
    other = with_branch(material, 1.1, branch=2)
    ratios = other.branch_shear_moduli / material.branch_shear_moduli
    assert ratios[2] / ratios[0] == pytest.approx(1.1)
    assert np.ptp(np.delete(ratios, 2)) < 1e-9
    held = f"{moduli}_shear_modulus"
    assert getattr(other, held) == pytest.approx(getattr(material, held), rel=1e-8)
    assert other.long_term_bulk_modulus == pytest.approx(material.long_term_bulk_modulus)


def test_temperature_acts_as_speed_does_through_its_shift_factor(
    paper_scene: SceneMaker, paper_rubber: Material
) -> None:
    shift = Shift(law="wlf", reference_temperature=20.0, c1=8.86, c2=101.6)
    rubber = ShiftedRubber(paper_rubber, shift)
    scene = filled(paper_scene(1.0, 1.0, material=rubber.at(30.0), temperature=30.0))
    base = solved(scene)
    known = {one.name: one for one in parameters(scene, rubber)}
    speed, warmth = (difference(base, known[name], 0.05) for name in ("v", "T"))
    per_kelvin = -8.86 * 101.6 / (101.6 + 10.0) ** 2 * math.log(10.0)
    # At constant amplitude and load only k v a_T counts: d ln mu / dT = d ln mu / d ln v  d ln a_T / dT.
    assert warmth.derivative / 10.0 == pytest.approx(speed.derivative * per_kelvin, rel=0.01)
    assert known["T"].slope == pytest.approx(10.0 / 303.15)


def test_friction_that_is_zero_has_no_sensitivities(paper_scene: SceneMaker, paper_rubber: Material) -> None:
    elastic = replace(paper_rubber, shear_fractions=(), relaxation_times=())
    with pytest.raises(InvalidInput, match="must be clear of zero for sensitivities: choose another speed"):
        solved(paper_scene(1.0, 5.0, material=elastic))


def test_what_has_no_solution_is_noted_and_leaves_the_others(monkeypatch: pytest.MonkeyPatch) -> None:
    def refusing(base: object, one: object, step: float) -> object:
        if getattr(one, "name", "") == "p":
            raise NotConverged("scene", 3, 1.0, "residual")
        return difference(base, one, step)  # type: ignore[arg-type]

    monkeypatch.setattr(study, "difference", refusing)
    found = rubfric.sensitivity(rubfric.load(SMALL), 1, 5, scale=1, only=["p", "v"], preset="draft")
    notes = found.table.set_index("parameter")["note"]
    assert notes["v"] == ""
    assert notes["p"] == "scene: not converged after 3 steps, residual is 1"
    assert all("larger p" not in one for one in found.sentences())


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        ({"change": 0.5}, "change is 0.5, but must be at most 0.3"),
        ({"sobol": 48}, "sobol is 48, but must be a power of 2: 32 for one"),
        ({"only": ["tau_7"]}, "the parameter 'tau_7' is unknown; this scene has E, nu, g_1"),
        ({"scale": 5}, "scale is 5, but must be"),
    ],
)
def test_bad_input_is_refused_before_anything_is_solved(given: dict[str, object], sentence: str) -> None:
    with pytest.raises(InvalidInput) as refused:
        rubfric.sensitivity(rubfric.load(SMALL), 100, 0.5, **({"scale": 1} | given))  # type: ignore[arg-type]
    assert sentence in str(refused.value)


def test_sobol_indices_of_a_power_law_are_the_squares_of_its_exponents() -> None:
    arguments = {"scale": 1, "only": ["a", "p", "tau_1", "v"], "preset": "draft", "change": 0.05, "sobol": 32}
    found = rubfric.sensitivity(rubfric.load(SMALL), 0.1, 10, **arguments)  # type: ignore[arg-type]
    again = rubfric.sensitivity(rubfric.load(SMALL), 0.1, 10, **arguments)  # type: ignore[arg-type]
    assert found.sobol is not None
    assert again.sobol is not None
    assert found.sobol.equals(again.sobol)
    table = found.table.merge(found.sobol, on="parameter")
    expected = table["sensitivity"] ** 2 / (table["sensitivity"] ** 2).sum()
    assert np.allclose(table["total_order"], expected, atol=0.15)
    assert np.all(table["total_order_low"] <= table["total_order"])
    assert np.all(table["total_order"] <= table["total_order_high"])
    assert np.all((table["first_order_low"] <= expected) & (expected <= table["first_order_high"]))


@pytest.mark.thorough
def test_finite_strain_has_the_same_invariances_and_the_change_of_two_solves(paper_scene: SceneMaker) -> None:
    numerics = Numerics(accuracy=0.05)
    scene = paper_scene(100.0, 0.5, plane="stress", kinematics="finite", numerics=numerics)
    base = solved(scene)
    known = {one.name: one for one in parameters(scene)}
    found = {name: difference(base, known[name], math.log(1.1)) for name in ("E", "p", "a", "lambda", "v", "tau_2")}
    error = dict(zip(found, errors(base, [*found.values()]), strict=True))
    assert found["E"].derivative == pytest.approx(-found["p"].derivative, abs=1e-4)
    lengths = sum(found[name].derivative for name in ("a", "lambda", "v"))
    assert abs(lengths) <= math.hypot(*(error[name] for name in ("a", "lambda", "v")))
    fine = replace(numerics, accuracy=0.0005)
    for name in ("p", "tau_2"):
        there, back = (
            float(rubfric.simulate(replace(known[name].change(scene, t), numerics=fine)).friction_coefficient)
            for t in (0.1, -0.1)
        )
        assert abs(math.log(there / back) / 0.2 - found[name].derivative) <= error[name] + 0.005, name


@pytest.mark.thorough
def test_workers_find_what_one_process_finds(monkeypatch: pytest.MonkeyPatch) -> None:
    campaign, arguments = rubfric.load(SMALL), {"scale": 1, "only": ["E", "tau_2", "a"], "sobol": 16}
    alone = rubfric.sensitivity(campaign, 100, 0.5, jobs=1, **arguments)  # type: ignore[arg-type]
    monkeypatch.setattr(sharing, "_PATIENCE", 0.0)
    shared = rubfric.sensitivity(campaign, 100, 0.5, jobs=2, **arguments)  # type: ignore[arg-type]
    assert np.allclose(alone.table["sensitivity"], shared.table["sensitivity"], rtol=1e-8)
    assert alone.sobol is not None
    assert shared.sobol is not None
    assert np.allclose(alone.sobol["total_order"], shared.sobol["total_order"], rtol=1e-8)
