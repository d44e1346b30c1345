"""Contact with roads of many waves, from coarse to fine: closed forms, invariances, robustness and cost."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from rubfric.errors import NotConverged
from rubfric.mechanics.block import contact as contact_module
from rubfric.mechanics.block import surface as surface_module
from rubfric.mechanics.block.contact import Contact, follow, full_contact, pivot, solve_contact
from rubfric.mechanics.block.surface import Convolution
from rubfric.mechanics.theory.layer import layer_compliance
from rubfric.road.sine import SineScale
from rubfric.rubber.material import Material

Real = NDArray[np.float64]
Complex = NDArray[np.complex128]
PERIOD, HEIGHT = 2.0 * np.pi / 5.0, 0.75 * 2.0 * np.pi / 35.0  # mm
WAVES = tuple(SineScale(*wave) for wave in ((0.015, 35.0), (0.006, 80.0), (0.003, 200.0), (0.002, 300.0)))
# Over velocity, mm/s, of boundary elements on 4096 points, at 5 MPa in plane strain.
FRICTION = {0.1: 0.0290, 1.0: 0.0938, 10.0: 0.3390, 100.0: 0.6543, 500.0: 0.6437, 1000.0: 0.5510, 1e4: 0.2751}


def spectrum(material: Material, nodes: int, velocity: float, fundamental: float = 5.0) -> Complex:
    wavenumber = fundamental * np.arange(1, nodes // 2 + 1)
    return np.append(0.0, layer_compliance(material, wavenumber, velocity, HEIGHT, "strain"))


def road(nodes: int, periods: int = 1) -> tuple[Real, Real]:
    """Return height, mm, and slope of the paper's four scales at once."""
    x = periods * PERIOD / nodes * np.arange(nodes)
    return sum(wave.height(x) for wave in WAVES), sum(wave.slope(x) for wave in WAVES)


def random_road(nodes: int, slope: float, rng: np.random.Generator) -> Real:
    """Return a road of 64 waves of random phases, mm, with a steepest slope."""
    harmonics = rng.choice(np.arange(1, 150), 64, replace=False)
    angle = 2.0 * np.pi * np.outer(harmonics, np.arange(nodes) / nodes) + rng.uniform(0.0, 2.0 * np.pi, (64, 1))
    amplitude = rng.uniform(0.2, 1.0, 64) / harmonics**1.3
    profile = amplitude @ np.sin(angle)
    return profile * slope / np.abs((5.0 * amplitude * harmonics) @ np.cos(angle)).max()


def assert_complementary(compliance: Complex, profile: Real, nominal: float, solved: Contact) -> None:
    gap = np.fft.irfft(compliance * np.fft.rfft(solved.pressure), len(profile)) + solved.offset - profile
    np.testing.assert_allclose(gap, solved.gap, atol=1e-9 * np.ptp(profile))
    assert solved.pressure.min() >= 0.0
    assert solved.gap.min() >= 0.0
    assert not (solved.pressure * solved.gap).any()
    assert solved.pressure.mean() == pytest.approx(nominal, rel=1e-9)


@pytest.mark.parametrize(("velocity", "friction"), FRICTION.items())
def test_friction_of_four_scales_at_once_is_that_of_boundary_elements(
    paper_rubber: Material, velocity: float, friction: float
) -> None:
    compliance, (profile, slope) = spectrum(paper_rubber, 2048, velocity), road(2048)
    solved = solve_contact(compliance, profile, 5.0)
    assert np.mean(solved.pressure * slope) / 5.0 == pytest.approx(friction, rel=0.005)
    assert_complementary(compliance, profile, 5.0, solved)


@pytest.mark.parametrize("nominal", [0.1, 1.0])
@pytest.mark.parametrize("velocity", FRICTION)
def test_few_pivots_are_enough_on_every_mesh(paper_rubber: Material, velocity: float, nominal: float) -> None:
    compliance, (profile, _) = spectrum(paper_rubber, 4096, velocity), road(4096)
    assert solve_contact(compliance, profile, nominal).iterations < 9 * 8  # from 16 nodes to 4096


@pytest.mark.parametrize("nodes", [1000, 1023])
def test_any_start_and_gmres_or_not_the_contact_is_one(
    paper_rubber: Material, rng: np.random.Generator, monkeypatch: pytest.MonkeyPatch, nodes: int
) -> None:
    compliance, profile = spectrum(paper_rubber, nodes, 10.0), random_road(nodes, 1.0, rng)
    expected = solve_contact(compliance, profile, 2.0)
    assert 200 < np.count_nonzero(expected.touching) < 900
    for krylov, start in ((0.0, None), (0.0, profile > 0.0), (np.inf, None), (np.inf, profile > 0.0)):
        monkeypatch.setattr(surface_module, "_DENSE", krylov)
        found = solve_contact(compliance, profile, 2.0, start)
        np.testing.assert_allclose(found.pressure, expected.pressure, atol=1e-9 * expected.pressure.max())
        assert found.offset == pytest.approx(expected.offset, abs=1e-12)


@pytest.mark.parametrize(("velocity", "nominal"), [(0.1, 5.0), (0.1, 0.05), (10.0, 1.0), (1e3, 5.0), (1e4, 0.05)])
@pytest.mark.parametrize("slope", [0.3, 3.0])
def test_random_roads_are_solved(
    paper_rubber: Material, rng: np.random.Generator, velocity: float, nominal: float, slope: float
) -> None:
    for nodes in (777, 2048):
        compliance, profile = spectrum(paper_rubber, nodes, velocity), random_road(nodes, slope, rng)
        assert_complementary(compliance, profile, nominal, solve_contact(compliance, profile, nominal))


def test_round_off_of_the_road_changes_nothing(paper_rubber: Material, rng: np.random.Generator) -> None:
    compliance, profile = spectrum(paper_rubber, 2048, 10.0), random_road(2048, 2.0, rng)
    expected = solve_contact(compliance, profile, 2.0)
    assert np.count_nonzero(expected.touching) > 700  # GMRES
    for _ in range(3):
        found = solve_contact(compliance, profile * (1.0 + 1e-13 * rng.uniform(-1.0, 1.0, 2048)), 2.0)
        np.testing.assert_allclose(found.pressure, expected.pressure, atol=1e-8 * expected.pressure.max())


@pytest.mark.parametrize("shift", [1, 700])
def test_shifted_road_has_shifted_pressures(paper_rubber: Material, shift: int) -> None:
    compliance, (profile, _) = spectrum(paper_rubber, 2048, 10.0), road(2048)
    here, there = (solve_contact(compliance, np.roll(profile, by), 2.0).pressure for by in (0, shift))
    np.testing.assert_allclose(there, np.roll(here, shift), atol=1e-9 * here.max())


def test_sliding_the_other_way_over_the_mirrored_road_is_the_same(
    paper_rubber: Material, rng: np.random.Generator
) -> None:
    compliance, profile = spectrum(paper_rubber, 2048, 10.0), random_road(2048, 1.0, rng)
    there = solve_contact(compliance, profile, 2.0).pressure
    back = solve_contact(compliance.conj(), profile[::-1], 2.0).pressure
    np.testing.assert_allclose(back, there[::-1], atol=1e-9 * there.max())


def test_road_of_twice_the_period_is_the_same(paper_rubber: Material) -> None:
    once = solve_contact(spectrum(paper_rubber, 1024, 10.0), road(1024)[0], 2.0)
    twice = solve_contact(spectrum(paper_rubber, 2048, 10.0, 2.5), road(2048, 2)[0], 2.0)
    np.testing.assert_allclose(twice.pressure, np.tile(once.pressure, 2), atol=1e-9 * once.pressure.max())
    assert twice.offset == pytest.approx(once.offset, abs=1e-12)


def test_load_that_fills_the_road_gives_the_pressures_of_its_waves(
    paper_rubber: Material, rng: np.random.Generator
) -> None:
    compliance, profile = spectrum(paper_rubber, 4096, 100.0), random_road(4096, 0.5, rng)
    series = np.fft.rfft(profile)
    series[1:] /= compliance[1:]
    series[0] = 0.0
    series[150:] = 0.0
    filling = np.fft.irfft(series, 4096)
    nominal = -1.02 * filling.min()
    recognised, found = full_contact(compliance, profile, nominal), solve_contact(compliance, profile, nominal)
    assert recognised is not None
    np.testing.assert_allclose(found.pressure, nominal + filling, atol=1e-8 * nominal)
    np.testing.assert_allclose(recognised.pressure, nominal + filling, atol=1e-8 * nominal)


@pytest.mark.parametrize("ratio", [0.1, 0.5, 0.9])
def test_elastic_half_space_on_a_sine_is_that_of_westergaard(ratio: float) -> None:
    """With psi = k x / 2 and sin(psi_a)^2 = pbar / p*: p = 2 p* cos(psi) sqrt(sin(psi_a)^2 - sin(psi)^2)."""
    nodes, modulus = 4096, 7.0  # MPa
    compliance = np.append(0.0, 2.0 / (modulus * np.arange(1, nodes // 2 + 1))).astype(complex)  # k = n
    x = 2.0 * np.pi / nodes * np.arange(nodes)
    fills = 0.5 * modulus * 0.1  # E* k a / 2
    found = solve_contact(compliance, 0.1 * np.cos(x), ratio * fills)
    half = np.where(x > np.pi, x - 2.0 * np.pi, x) / 2.0
    beside = np.maximum(ratio - np.sin(half) ** 2, 0.0)
    expected = 2.0 * fills * np.cos(half) * np.sqrt(beside)
    np.testing.assert_allclose(found.pressure, expected, atol=0.02 * expected.max())
    assert np.mean(np.abs(found.pressure - expected)) < 1e-3 * expected.max()
    assert np.mean(found.touching) == pytest.approx(2.0 / np.pi * np.arcsin(np.sqrt(ratio)), abs=2.5 / nodes)


def test_cost_grows_little_faster_than_the_transforms(paper_rubber: Material, monkeypatch: pytest.MonkeyPatch) -> None:
    costs: dict[int, int] = dict.fromkeys((1024, 4096, 16384), 0)

    class Counted(Convolution):
        def deflection(self, pressure: Real) -> Real:
            costs[nodes] += len(pressure)
            return super().deflection(pressure)

    monkeypatch.setattr(contact_module, "Convolution", Counted)
    monkeypatch.setattr(surface_module, "_DENSE", 0.0)
    for nodes in costs:
        solved = solve_contact(spectrum(paper_rubber, nodes, 1.0), road(nodes)[0], 2.0)
        assert 0.55 * nodes < np.count_nonzero(solved.touching) < 0.65 * nodes
    applications = [cost / nodes for nodes, cost in costs.items()]  # each costs n log n
    assert applications[0] < 400
    assert applications[2] < 2.2 * applications[0]


def lossy(nodes: int, nominal: float) -> tuple[Complex, Real, float]:
    """Return the contact of a rubber whose compliance lags by 80 degrees with a sine: block pivots cycle."""
    rubber, wavenumber = Material("one", 1.0, 0.49, (0.999,), (1e-4,)), 80.0 * np.arange(1, nodes // 2 + 1)
    compliance = np.append(0.0, layer_compliance(rubber, wavenumber, 0.0375, 0.06, "stress"))
    return compliance, SineScale(0.006, 80.0).height(2.0 * np.pi / 80.0 / nodes * np.arange(nodes)), nominal


@pytest.mark.parametrize("nominal", [0.05, 0.1, 0.2])
def test_pivots_that_cycle_follow_a_road_that_turns_into_the_road(
    nominal: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    problem = lossy(64, nominal)
    with pytest.raises(NotConverged, match="number of surface nodes that violate contact"):
        pivot(Convolution(problem[0], 64), *problem[1:], np.ones(64, dtype=bool), most_steps=30)
    roads: list[Real] = []

    def watched(surface: Convolution, profile: Real, *rest: object) -> Contact:
        roads.append(profile)
        return pivot(surface, profile, *rest)

    monkeypatch.setattr(contact_module, "pivot", watched)
    flat = Contact(np.full(64, nominal), np.zeros(64), 0.0, 0)
    found = follow(Convolution(problem[0], 64), *problem[1:], flat)
    assert_complementary(*problem, found)
    heights = [float(np.ptp(road)) for road in roads]
    assert min(heights) < 0.5 * heights[0]
    assert heights[0] == pytest.approx(heights[-1], rel=1e-12)
    assert_complementary(*problem, solve_contact(*problem))
    assert_complementary(*problem, solve_contact(*problem, np.ones(64, dtype=bool)))


def test_any_contact_can_be_followed(
    paper_rubber: Material, rng: np.random.Generator, monkeypatch: pytest.MonkeyPatch
) -> None:
    nodes = 128
    compliance, profile = spectrum(paper_rubber, nodes, 10.0), random_road(nodes, 1.0, rng)
    expected = solve_contact(compliance, profile, 2.0)
    monkeypatch.setattr(contact_module, "_STEPS_AT_ONCE", 4)
    touching = rng.random(nodes) < 0.5
    pressure, gap = np.where(touching, rng.random(nodes), 0.0), np.where(touching, 0.0, 0.01 * rng.random(nodes))
    near = Contact(2.0 * pressure / pressure.mean(), gap, 0.0, 0)
    found = follow(Convolution(compliance, nodes), profile, 2.0, near)
    np.testing.assert_allclose(found.pressure, expected.pressure, atol=1e-9 * expected.pressure.max())
    assert found.iterations > 4


def test_what_no_road_leads_to_is_not_converged(paper_rubber: Material, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(contact_module, "_STEPS_AT_ONCE", 1)
    monkeypatch.setattr(contact_module, "_MOST_STEPS_ALONG", 5)
    with pytest.raises(NotConverged, match=r"^rough: not converged after 1 steps, number of surface nodes that"):
        solve_contact(spectrum(paper_rubber, 512, 10.0), road(512)[0], 0.5, label="rough")
