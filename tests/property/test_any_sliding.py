"""Any scene of small strain: the conditions of contact, the balances of load and energy, what must change nothing."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from admissible import magnitudes, scenes
from hypothesis import given, settings
from hypothesis import strategies as st

from rubfric.errors import InvalidInput, NotConverged
from rubfric.mechanics.block.block import Block
from rubfric.mechanics.block.contact import solve_contact
from rubfric.mechanics.small.response import respond
from rubfric.mechanics.theory import layer as reference
from rubfric.road.sine import SineScale
from rubfric.rubber.material import BULK, MODULI, PLANES, Material
from rubfric.scene.scene import Scene
from rubfric.simulation import evaluate, simulate, solve

MOST_BRANCHES = 8


@st.composite
def sliding_rubbers(draw: st.DrawFn, wave_time: float, least_branches: int = 0) -> Material:
    """Rubbers of moduli of 1 MPa or so whose branches are up to six decades slower or faster than a time in s."""
    branches = draw(st.integers(least_branches, MOST_BRANCHES))
    weights = draw(st.lists(magnitudes(1e-3, 1.0), min_size=branches, max_size=branches))
    total = draw(st.floats(0.05, 0.999))
    powers = draw(st.lists(st.floats(-6.0, 6.0), min_size=branches, max_size=branches))
    moduli = draw(st.sampled_from(MODULI))
    stiffness = draw(magnitudes(0.1, 100.0))
    return Material(
        name="any",
        # The relaxed modulus is what carries the load: the same range by either convention.
        youngs_modulus=stiffness / (1.0 - total if moduli == "instantaneous" and branches else 1.0),
        poissons_ratio=draw(st.floats(-0.5, 0.4995)),
        shear_fractions=tuple(total * weight / sum(weights) for weight in weights),
        relaxation_times=tuple(wave_time * 10.0**power for power in powers),
        moduli=moduli,
        bulk=draw(st.sampled_from(BULK)),
    )


@st.composite
def slidings(draw: st.DrawFn, least_branches: int = 0) -> Scene:
    """Scenes from a hundredth to a hundred times the pressure that fills the road, of any size and speed."""
    wavenumber, velocity = draw(magnitudes(1e-3, 1e4)), draw(magnitudes(1e-3, 1e5))
    road = SineScale(draw(magnitudes(1e-3, 2.0)) / wavenumber, wavenumber)
    rubber = draw(sliding_rubbers(1.0 / (wavenumber * velocity), least_branches))
    plane, aspect = draw(st.sampled_from(PLANES)), draw(magnitudes(0.1, 5.0))
    filling = reference.full_contact_pressure(rubber, road, velocity, aspect * road.wavelength, plane)
    return Scene(
        scale=1,
        road=road,
        velocity=velocity,
        pressure=draw(magnitudes(0.01, 100.0)) * filling,
        aspect=aspect,
        material=rubber,
        plane=plane,
        kinematics="small",
    )


@given(slidings())
@settings(max_examples=60)
def test_contact_presses_never_pulls_and_carries_the_load(scene: Scene) -> None:
    contact = solve(scene).contact
    assert (contact.pressure >= 0.0).all()
    assert (contact.gap >= 0.0).all()
    assert not (contact.pressure * contact.gap).any()
    assert contact.pressure.mean() == pytest.approx(scene.pressure, rel=1e-9)


@pytest.mark.thorough
@given(slidings())
@settings(max_examples=60)
def test_friction_is_never_negative_and_the_same_by_three_routes(scene: Scene) -> None:
    result = simulate(scene)
    power, lost, contact = (float(result[f"friction_coefficient{route}"]) for route in ("", "_dissipation", "_contact"))
    assert power >= 0.0
    assert lost >= 0.0
    assert lost == pytest.approx(power, rel=1e-7, abs=1e-11)
    # Twice the share of the edges of the contact, one node each.
    assert contact == pytest.approx(power, rel=0.1, abs=1e-9)
    assert float(result["energy_closure"]) >= 0.0
    assert result.attrs["scene_digest"] == scene.digest
    for name, variable in result.data_vars.items():
        assert np.isfinite(variable.values).all(), name


@given(slidings())
@settings(max_examples=20)
def test_elastic_rubber_has_no_friction_at_all(scene: Scene) -> None:
    elastic = replace(scene, material=replace(scene.material, shear_fractions=(), relaxation_times=()))
    energies = evaluate(solve(elastic))
    assert (energies.stress_power, energies.dissipation) == (0.0, 0.0)
    assert abs(energies.contact) < 1e-9


def frictions(scene: Scene) -> tuple[int, float]:
    solution = solve(scene)
    return solution.block.columns, evaluate(solution).stress_power


powers_of_ten = st.integers(-6, 6).map(lambda power: 10.0**power)


@pytest.mark.thorough
@given(slidings(least_branches=1), powers_of_ten, powers_of_ten, powers_of_ten)
@settings(max_examples=12)
def test_friction_depends_on_ratios_only(scene: Scene, length: float, time: float, stress: float) -> None:
    rubber = replace(
        scene.material,
        youngs_modulus=stress * scene.material.youngs_modulus,
        relaxation_times=tuple(time * tau for tau in scene.material.relaxation_times),
    )
    scaled = replace(
        scene,
        road=SineScale(length * scene.road.amplitude, scene.road.wavenumber / length),
        velocity=scene.velocity * length / time,
        pressure=stress * scene.pressure,
        material=rubber,
    )
    (columns, friction), (others, other) = frictions(scene), frictions(scaled)
    assert others == columns
    assert other == pytest.approx(friction, rel=1e-5, abs=1e-11)


@given(slidings(least_branches=1), st.floats(0.0, 1.0), st.floats(0.0, 6.0))
@settings(max_examples=20)
def test_sliding_the_other_way_over_the_mirrored_road_is_the_same(scene: Scene, share: float, phase: float) -> None:
    road, columns = scene.road, 64
    block = Block.graded(road.wavelength, scene.height, columns, scene.plane, 1.3)
    x = block.column_positions
    profile = road.height(x) + share * road.height(2.0 * x + phase / road.wavenumber)
    there, back = (_pressure(scene, block, sign, line) for sign, line in ((1, profile), (-1, _mirrored(profile))))
    np.testing.assert_allclose(back, _mirrored(there), atol=1e-7 * there.max())


def _pressure(scene: Scene, block: Block, sign: int, profile: np.ndarray) -> np.ndarray:
    response = respond(block, scene.material, sign * scene.velocity, block.harmonics[1:])
    spectrum = np.append(0.0, response.compliance)
    return solve_contact(spectrum, profile, scene.pressure, np.ones(block.columns, dtype=bool)).pressure


def _mirrored(values: np.ndarray) -> np.ndarray:
    return np.roll(values[::-1], 1)


@given(slidings(least_branches=1), st.floats(1.01, 50.0))
@settings(max_examples=30)
def test_full_contact_is_that_of_the_closed_form(scene: Scene, times: float) -> None:
    parts = scene.material, scene.road, scene.velocity
    filling = reference.full_contact_pressure(*parts, scene.height, scene.plane)
    filled = replace(scene, pressure=1.02 * times * filling)
    solution = solve(filled)
    assert solution.contact_fraction == 1.0
    expected = reference.full_contact_friction(*parts, filled.pressure, scene.height, scene.plane)
    assert evaluate(solution).stress_power == pytest.approx(expected, rel=0.01, abs=1e-12)


@given(slidings(least_branches=1))
@settings(max_examples=15)
def test_heavier_load_touches_no_less(scene: Scene) -> None:
    light, heavy = (solve(replace(scene, pressure=factor * scene.pressure)) for factor in (1.0, 2.0))
    assert heavy.contact_fraction >= light.contact_fraction - 2.0 / light.block.columns


@st.composite
def extremes(draw: st.DrawFn) -> Scene:
    """Scenes far outside of what anybody slides, in slope, size, speed, load and flatness."""
    wavenumber, stiffness = draw(magnitudes(1e-6, 1e6)), draw(magnitudes(1e-9, 1e9))
    scene = draw(scenes(most_branches=4))
    return replace(
        scene,
        road=SineScale(draw(magnitudes(1e-12, 1e6)) / wavenumber, wavenumber),
        velocity=draw(magnitudes(1e-12, 1e12)),
        pressure=stiffness * draw(magnitudes(1e-9, 1e6)),
        aspect=draw(magnitudes(1e-2, 100.0)),
        material=replace(scene.material, youngs_modulus=stiffness),
        kinematics="small",
    )


@given(extremes())
@settings(max_examples=12)
def test_extreme_scene_has_a_friction_or_a_reason_why_not(scene: Scene) -> None:
    try:
        result = simulate(scene)
    except (NotConverged, InvalidInput) as error:
        reason = str(error)
    else:
        reason = ""
        assert float(result["friction_coefficient"]) >= 0.0
        assert float(result["energy_closure"]) <= 0.25
    refusals = (
        f"{scene.name}: not converged after ",
        f"pressure of {scene.name} is {scene.pressure:g} MPa, but must ",
        f"rubbers.{scene.material.name}.poissons_ratio is {scene.material.poissons_ratio!r}, but must be at most ",
    )
    assert reason == "" or reason.startswith(refusals)
