"""Areal roads against closed forms, the plane block, symmetry, and themselves on finer nodes."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from rubfric.errors import InvalidInput, NotConverged
from rubfric.mechanics.areal.steady import ArealSolution, solve_areal
from rubfric.mechanics.small.steady import solve_small
from rubfric.mechanics.theory.kinematics import Decision
from rubfric.mechanics.theory.layer import layer_compliance
from rubfric.mechanics.theory.persson import contact_fractions, persson_friction
from rubfric.mechanics.theory.persson_areal import persson_areal
from rubfric.road.areal import ArealSpectrum
from rubfric.road.areal_scan import ScannedRoad
from rubfric.road.areal_waves import ArealWaves
from rubfric.road.self_affine import SelfAffine
from rubfric.road.sine import SineScale
from rubfric.road.waves import WaveRoad
from rubfric.rubber.material import Material
from rubfric.scene.areal import ArealNumerics, ArealScene
from rubfric.scene.numerics import Numerics
from rubfric.scene.scene import Scene

ROUGH = SelfAffine(hurst=0.8, period=1.0, cut_off=0.125, rms_slope=0.25)
DECISION = Decision("small", 0.25, "small strain was asked for")
# Half a wave on each axis: s = a (sin(k x) + sin(k y)) has crests in a square, of the height 2 a.
SQUARE = ArealWaves((0.01, 0.01), (10.0, 10.0), (0.0, 90.0), (0.0, 0.0))


def nodes(most: int, per_wave: int = 8) -> ArealNumerics:
    return ArealNumerics(accuracy=1e-4, nodes_max=most, nodes_per_wave=per_wave)


def moved(road: ArealSpectrum, away: tuple[float, float]) -> ScannedRoad:
    """Return a road that begins elsewhere."""
    turned = road.amplitudes * np.exp(1j * (road.wavevectors @ np.array(away)))
    return ScannedRoad(ArealSpectrum(road.periods, road.harmonics, turned), 0, np.zeros(1))


def mirrored(road: ArealSpectrum) -> ScannedRoad:
    """Return a road seen in a mirror along x."""
    shape = (64, 64)
    heights = np.roll(road.heights(shape)[::-1], 1, axis=0)
    return ScannedRoad.of_heights(heights, (1.0 / 64, 1.0 / 64), degree=0, blend=0.0, cut_off=0.125)


@pytest.mark.parametrize(("velocity", "pressure"), [(10.0, 1.0), (1000.0, 2.0)])
def test_ridges_are_the_plane_block(paper_rubber: Material, velocity: float, pressure: float) -> None:
    amplitude, wavenumber = 0.015, 35.0
    plane = Scene(1, SineScale(amplitude, wavenumber), velocity, pressure, 0.75, paper_rubber, "strain")
    fine = replace(plane, kinematics="small", numerics=Numerics(accuracy=0.001))
    expected = solve_small(fine, DECISION)
    for direction, along in ((0.0, 0.0), (90.0, 90.0)):
        road = ArealWaves((amplitude,), (wavenumber,), (along,), (0.0,))
        scene = ArealScene(road, velocity, pressure, paper_rubber, direction, numerics=nodes(256))
        found = solve_areal(scene)
        assert found.friction_coefficient == pytest.approx(expected.friction.stress_power, rel=0.01)
        assert abs(found.friction_coefficient - expected.friction.stress_power) <= found.friction_error + 1e-3
        assert found.contact.fraction == pytest.approx(expected.contact_fraction, abs=0.02)


def test_ridges_along_the_way_do_not_rub_and_oblique_ones_push_aside(paper_rubber: Material) -> None:
    road = ArealWaves((0.015,), (35.0,), (0.0,), (0.0,))
    scene = ArealScene(road, 100.0, 5.0, paper_rubber, 90.0, numerics=nodes(64))
    assert abs(solve_areal(scene).friction_coefficient) < 1e-9
    # Ridges meet oblique sliding as straight sliding that is slower, and the force stays square to them.
    oblique = solve_areal(replace(scene, direction=60.0, velocity=200.0)).meshes[-1]
    straight = solve_areal(replace(scene, direction=0.0, velocity=100.0)).meshes[-1]
    assert oblique.contact == pytest.approx(0.5 * straight.contact, rel=1e-6)
    assert oblique.across == pytest.approx(-math.sqrt(0.75) * straight.contact, rel=1e-6)


@pytest.mark.parametrize("bulk", ["elastic", "proportional"])
def test_full_contact_on_crossed_waves_is_the_sum_of_both(paper_rubber: Material, bulk: str) -> None:
    rubber = replace(paper_rubber, bulk=bulk)
    road = ArealWaves((0.002, 0.003), (10.0, math.hypot(10.0, 20.0)), (0.0, math.degrees(math.atan(2.0))), (0.3, 1.0))
    velocity, pressure = 5.0, 3.0
    scene = ArealScene(road, velocity, pressure, rubber, numerics=nodes(64))
    found = solve_areal(scene)
    assert found.contact.fraction == 1.0
    total = 0.0
    for amplitude, wavenumber in zip(road.amplitudes, road.wavenumbers, strict=True):  # both have k_x = 10
        stiffness = 1.0 / layer_compliance(rubber, wavenumber, velocity * 10.0 / wavenumber, scene.height, "strain")
        total += 0.5 * amplitude**2 * 10.0 * float(stiffness.imag) / pressure
    assert found.friction_coefficient == pytest.approx(total, rel=1e-4)
    assert found.meshes[-1].contact == pytest.approx(total, rel=1e-4)


def test_square_crests_follow_johnson_greenwood_and_higginson(elastic_rubber: Material) -> None:
    """Johnson, Greenwood and Higginson 1985, Int. J. Mech. Sci. 27, 383, for s = 2 a cos cos turned by 45 degrees.

    Its heights a (sin + sin) are those of crossed waves, of the amplitude D = 2 a and of the pressure of full contact
    p* = E* k a; lightly loaded crests are Hertz's, A = pi (3 p / (8 pi p*'))^(2/3) in the units of their paper.
    """
    modulus = float(elastic_rubber.plane_modulus(0.0, "strain").real)
    curvature, cell = 0.01 * 10.0**2, (2.0 * math.pi / 10.0) ** 2
    filling = modulus * 10.0 * 0.01  # k E* / 2 for each wave of amplitude a, at its trough
    scene = ArealScene(SQUARE, 1.0, 1.02 * filling, elastic_rubber, aspect=20.0, numerics=nodes(64))
    assert solve_areal(scene).contact.fraction == 1.0
    assert solve_areal(replace(scene, pressure=0.9 * filling)).contact.fraction < 1.0
    light = replace(scene, pressure=2e-3 * filling, numerics=nodes(256, 256))
    found = solve_areal(light)
    radius = (0.75 * light.pressure * cell / (curvature * modulus)) ** (1.0 / 3.0)
    edge = 2.0 * math.sqrt(math.pi / found.contact.pressure.size) * 0.5
    assert found.contact.fraction == pytest.approx(math.pi * radius**2 / cell, rel=0.1 + edge)
    peak = 1.5 * light.pressure * cell / (math.pi * radius**2)
    assert found.contact.pressure.max() == pytest.approx(peak, rel=0.04)


def test_light_elastic_contact_grows_in_proportion(elastic_rubber: Material) -> None:
    """A / A0 = kappa p / (E* h'), h' the root mean square of the gradient.

    Kappa is between sqrt(8 / pi) (Persson 2001) and sqrt(2 pi) (Bush, Gibson and Thomas 1975, Wear 35, 87), as all
    simulations find it (Hyun, Pei, Molinari and Robbins 2004, Phys. Rev. E 70, 026117); it falls with the load.
    """
    kappa: list[float] = []
    modulus = float(elastic_rubber.plane_modulus(0.0, "strain").real)
    road = replace(ROUGH, roll_off=0.5)
    for share in (0.03, 0.06):
        scene = ArealScene(road, 1.0, share * modulus * 0.25, elastic_rubber, numerics=nodes(256, 64))
        found = solve_areal(scene)
        # Edges of contact jump from node to node: the area is too large by the order of their distance.
        coarse, fine = (mesh.fraction for mesh in found.meshes)
        area = 2.0 * fine - coarse
        assert math.sqrt(8.0 / math.pi) < area / share < 1.05 * math.sqrt(2.0 * math.pi)
        kappa.append(area / share)
        assert abs(found.friction_coefficient) < 1e-12
        assert abs(found.meshes[-1].contact) < 5e-3
    assert 0.85 * kappa[0] < kappa[1] < kappa[0]


def solved(road: object, rubber: Material, direction: float = 0.0) -> ArealSolution:
    return solve_areal(ArealScene(road, 100.0, 0.5, rubber, direction, numerics=nodes(64)))


def test_roads_moved_mirrored_and_turned_rub_alike(paper_rubber: Material) -> None:
    base, road = solved(ROUGH, paper_rubber), ROUGH.spectrum
    step = 1.0 / 64
    whole = solved(moved(road, (5 * step, 3 * step)), paper_rubber)
    assert whole.friction_coefficient == pytest.approx(base.friction_coefficient, rel=1e-6)
    assert whole.contact.fraction == pytest.approx(base.contact.fraction, abs=3 / 64**2)
    np.testing.assert_allclose(
        np.roll(whole.contact.pressure, (3, 5), axis=(0, 1)),
        base.contact.pressure,
        atol=1e-5 * base.contact.pressure.max(),
    )
    parts = solved(moved(road, (0.4 * step, 0.3 * step)), paper_rubber)
    assert parts.friction_coefficient == pytest.approx(base.friction_coefficient, abs=base.friction_error)
    mirror = solved(mirrored(road), paper_rubber)
    assert mirror.friction_coefficient == pytest.approx(base.friction_coefficient, rel=1e-6)
    assert mirror.meshes[-1].across == pytest.approx(-base.meshes[-1].across, abs=1e-7)
    # The road turned by a quarter under sliding turned by a quarter.
    turned = ScannedRoad.of_heights(
        np.roll(road.heights((64, 64)).T[:, ::-1], 1, axis=1), (step, step), degree=0, blend=0.0, cut_off=0.125
    )
    quarter = solved(turned, paper_rubber, 90.0)
    assert quarter.friction_coefficient == pytest.approx(base.friction_coefficient, rel=1e-6)


def test_friction_vanishes_where_nothing_is_dissipated(paper_rubber: Material) -> None:
    for velocity in (1e-12, 1e20):
        found = solve_areal(ArealScene(ROUGH, velocity, 0.5, paper_rubber, numerics=nodes(64)))
        assert abs(found.friction_coefficient) < 1e-7
    flat = ArealScene(ArealWaves((0.0,), (10.0,), (0.0,), (0.0,)), 1.0, 0.5, paper_rubber, numerics=nodes(64))
    assert solve_areal(flat).friction_coefficient == 0.0


@pytest.mark.parametrize(("velocity", "pressure"), [(1.0, 0.3), (10.0, 0.05), (100.0, 1.0), (1e4, 0.3)])
def test_estimated_error_covers_what_finer_nodes_change(
    paper_rubber: Material, velocity: float, pressure: float
) -> None:
    scene = ArealScene(ROUGH, velocity, pressure, paper_rubber, numerics=nodes(256))
    fine = solve_areal(scene)
    coarse = solve_areal(replace(scene, numerics=nodes(64)))
    assert [mesh.shape[0] for mesh in fine.meshes] == [32, 64, 128, 256]
    assert fine.meshes[1].dissipation == pytest.approx(coarse.friction_coefficient, rel=1e-3)
    assert abs(fine.friction_coefficient - coarse.friction_coefficient) <= coarse.friction_error
    assert fine.friction_error < 0.6 * coarse.friction_error


def test_nodes_are_doubled_until_the_error_is_small_enough(paper_rubber: Material) -> None:
    scene = ArealScene(ROUGH, 100.0, 0.5, paper_rubber, numerics=ArealNumerics(accuracy=0.02))
    found = solve_areal(scene)
    assert found.resolved
    assert found.meshes[-1].shape[0] < 1024
    assert found.friction_error <= 0.02 * found.friction_coefficient
    rough = solve_areal(replace(scene, numerics=ArealNumerics(accuracy=1e-4, nodes_max=64)))
    assert not rough.resolved


def test_what_nodes_do_not_resolve_is_refused(paper_rubber: Material) -> None:
    scene = ArealScene(replace(ROUGH, cut_off=0.03125), 1.0, 0.3, paper_rubber, numerics=nodes(64))
    words = r"nodes_max is 64, but must be at least 128: .* 0.03125 mm long, .* waves shorter than 0.0625 mm"
    with pytest.raises(InvalidInput, match=words):
        solve_areal(scene)
    light = replace(scene, road=ROUGH, velocity=1e4, pressure=1e-4)
    with pytest.raises(NotConverged, match=r"nodes in contact, out of 4096, is \d+; at least 16 .* pressure to about"):
        solve_areal(light)


def test_persson_is_exact_in_full_contact_and_near_in_half(paper_rubber: Material) -> None:
    scene = ArealScene(replace(ROUGH, rms_slope=0.02), 10.0, 3.0, paper_rubber, 30.0, numerics=nodes(64))
    found = solve_areal(scene)
    theory = persson_areal(paper_rubber, scene.road.spectrum, 10.0, 3.0, scene.height, 30.0)
    assert found.contact.fraction == 1.0
    assert theory.friction_coefficient == pytest.approx(found.friction_coefficient, rel=1e-3)
    half = replace(scene, road=ROUGH, pressure=0.6, numerics=nodes(128))
    found = solve_areal(half)
    theory = persson_areal(paper_rubber, ROUGH.spectrum, 10.0, 0.6, half.height, 30.0)
    assert 0.2 < found.contact.fraction < 0.7
    assert theory.contact_fraction == pytest.approx(found.contact.fraction, abs=0.1)
    assert theory.friction_coefficient == pytest.approx(found.friction_coefficient, rel=0.25)
    reduced = persson_areal(paper_rubber, ROUGH.spectrum, 10.0, 0.6, half.height, 30.0, gamma=0.5)
    assert 0.5 < reduced.friction_coefficient / theory.friction_coefficient < 1.0


def test_persson_on_ridges_is_that_of_the_plane_theory(paper_rubber: Material) -> None:
    amplitudes, wavenumbers = (0.015, 0.006), (35.0, 105.0)
    plane = WaveRoad(amplitudes, wavenumbers, (0.0, 0.0))
    areal = ArealWaves(amplitudes, wavenumbers, (0.0, 0.0), (0.0, 0.0)).spectrum
    found = persson_areal(paper_rubber, areal, 100.0, 2.0, 0.1, gamma=0.5)
    expected = persson_friction(paper_rubber, plane, 100.0, 2.0, 0.1, "strain", gamma=0.5)
    np.testing.assert_allclose(found.friction, expected, rtol=1e-9)
    shares = contact_fractions(paper_rubber, plane, 100.0, 2.0, 0.1, "strain")
    np.testing.assert_allclose(found.contact, shares, rtol=1e-9)


@pytest.mark.parametrize("share", [0.05, 0.3])
@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_standing_elastic_contact_is_that_of_tamaas(elastic_rubber: Material, share: float) -> None:
    """Frérot, Anciaux, Rey, Pham-Ba and Molinari 2020, J. Open Source Softw. 5, 2121; where it is installed."""
    tamaas = pytest.importorskip("tamaas", reason="Tamaas is not installed")
    tamaas.set_log_level(tamaas.LogLevel.error)
    modulus = float(elastic_rubber.plane_modulus(0.0, "strain").real)
    road, pressure = replace(ROUGH, cut_off=0.0625), share * modulus * 0.25
    model = tamaas.ModelFactory.createModel(tamaas.model_type.basic_2d, [1.0, 1.0], [128, 128])
    model.E, model.nu = modulus, 0.0
    tamaas.PolonskyKeerRey(model, road.spectrum.heights((128, 128)), 1e-8).solve(pressure)
    scene = ArealScene(road, 1.0, pressure, elastic_rubber, aspect=20.0, numerics=nodes(128, 256))
    found = solve_areal(scene).contact
    expected = np.array(model.traction)
    np.testing.assert_allclose(found.pressure, expected, atol=2e-4 * expected.max())
    assert found.fraction == pytest.approx(float((expected > 0.0).mean()), abs=1e-3)


@pytest.mark.parametrize(
    ("velocity", "pressure", "aspect"),
    [(1e-30, 1.0, 0.75), (1e30, 1.0, 0.75), (1.0, 1e-30, 0.75), (1.0, 1e30, 0.75), (100.0, 0.3, 0.01), (1.0, 0.3, 1e6)],
)
def test_extremes_give_a_number_or_a_refusal(velocity: float, pressure: float, aspect: float) -> None:
    for youngs, ratio in ((4.17, 0.49), (1e30, 0.49), (1e-30, -0.9), (4.0, -1.0 + 1e-11), (4.0, 0.5 - 1e-11)):
        rubber = Material("r", youngs, ratio, (0.5, 0.499), (1e-3, 1e-5))
        scene = ArealScene(ROUGH, velocity, pressure, rubber, aspect=aspect, numerics=nodes(32, 4))
        try:
            found = solve_areal(scene)
        except NotConverged:  # too few nodes in contact
            assert pressure < 1e-6 * youngs or ratio < -0.9
            continue
        assert 0.0 <= found.friction_coefficient < 10.0
        assert found.contact.pressure.mean() == pytest.approx(pressure, rel=1e-9)
