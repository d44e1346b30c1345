from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import simpson

from rubfric.errors import InvalidInput
from rubfric.rubber.material import Material

FREQUENCIES = np.logspace(-6.0, 14.0, 81)  # rad/s, from below the slowest branch to above the fastest
EXTREMES = np.array([0.0, 5e-324, 1e-300, 1e-12, 1e12, 1e150, 1e300])  # rad/s
TWO_BRANCHES = Material("two", 3.0, 0.3, (0.5, 0.3), (1.0, 0.3), "instantaneous", "proportional")
CONFIG = {
    "youngs_modulus": 4.17,
    "poissons_ratio": 0.49,
    "shear_fractions": [0.5, 0.25],
    "relaxation_times": [1.0, 0.1],
}


@pytest.fixture(params=["long_term", "instantaneous"])
def moduli(request: pytest.FixtureRequest) -> str:
    return request.param


@pytest.fixture(params=["elastic", "proportional"])
def bulk(request: pytest.FixtureRequest) -> str:
    return request.param


@pytest.fixture(params=["strain", "stress"])
def plane(request: pytest.FixtureRequest) -> str:
    return request.param


def test_table_1_read_as_long_term(paper_rubber: Material) -> None:
    assert paper_rubber.long_term_fraction == pytest.approx(0.00143699, abs=5e-9)
    assert paper_rubber.long_term_shear_modulus == pytest.approx(1.3993, abs=5e-5)
    assert paper_rubber.long_term_bulk_modulus == pytest.approx(69.5, rel=1e-12)
    assert paper_rubber.instantaneous_shear_modulus == pytest.approx(973.8, abs=0.05)


def test_table_1_read_as_instantaneous_leaves_six_kilopascals(paper_rubber: Material) -> None:
    soft = replace(paper_rubber, moduli="instantaneous")
    assert soft.instantaneous_shear_modulus == pytest.approx(1.3993, abs=5e-5)
    assert soft.long_term_shear_modulus == pytest.approx(1.3993288590604 * 0.001436994, rel=1e-10)
    assert soft.long_term_bulk_modulus == pytest.approx(69.5, rel=1e-12)
    assert 3.0 * soft.long_term_shear_modulus == pytest.approx(0.006, abs=5e-5)  # E at rest, nearly incompressible


def test_relaxing_bulk_modulus_is_instantaneous_where_the_moduli_are(paper_rubber: Material) -> None:
    long_term = replace(paper_rubber, bulk="proportional")
    instantaneous = replace(long_term, moduli="instantaneous")
    assert long_term.long_term_bulk_modulus == pytest.approx(69.5, rel=1e-12)
    assert long_term.bulk_relaxation(0.0) == pytest.approx(69.5 / 0.001436994, rel=1e-10)
    assert instantaneous.long_term_bulk_modulus == pytest.approx(69.5 * 0.001436994, rel=1e-10)
    assert instantaneous.bulk_relaxation(0.0) == pytest.approx(69.5, rel=1e-12)


def test_relaxation_curve_over_eighteen_decades(paper_rubber: Material, moduli: str) -> None:
    rubber = replace(paper_rubber, moduli=moduli)
    times = np.logspace(-14.0, 4.0, 181)
    shear_now = 4.17 / (2.0 * 1.49) / (0.001436994 if moduli == "long_term" else 1.0)
    expected = []
    for time in times:
        share = 1.0
        for fraction, relaxation in zip(rubber.shear_fractions, rubber.relaxation_times, strict=True):
            share -= fraction * (1.0 - math.exp(-time / relaxation))
        expected.append(shear_now * share)
    np.testing.assert_allclose(rubber.shear_relaxation(times), expected, rtol=1e-9)


def test_bulk_modulus_of_table_1_does_not_relax(paper_rubber: Material) -> None:
    np.testing.assert_allclose(paper_rubber.bulk_relaxation(np.logspace(-14, 4, 19)), 69.5, rtol=1e-12)
    np.testing.assert_allclose(paper_rubber.complex_bulk_modulus(FREQUENCIES), 69.5, rtol=1e-12)


def test_relaxing_bulk_modulus_follows_the_shear_modulus(paper_rubber: Material, moduli: str) -> None:
    rubber = replace(paper_rubber, moduli=moduli, bulk="proportional")
    times = np.logspace(-12.0, 2.0, 57)
    ratio = 2.0 * (1.0 + 0.49) / (3.0 * (1.0 - 2.0 * 0.49))
    np.testing.assert_allclose(rubber.bulk_relaxation(times) / rubber.shear_relaxation(times), ratio, rtol=1e-12)


def test_complex_shear_modulus_runs_from_rubber_to_glass(paper_rubber: Material) -> None:
    assert paper_rubber.complex_shear_modulus(0.0) == paper_rubber.long_term_shear_modulus
    glass = paper_rubber.complex_shear_modulus(1e16)
    assert glass.real == pytest.approx(paper_rubber.instantaneous_shear_modulus, rel=1e-9)
    assert glass.imag == pytest.approx(0.0, abs=1e-3)


def test_one_branch_stores_and_loses_as_the_textbook_says() -> None:
    rubber = Material("one", 3.0, 0.25, (0.8,), (2.0,), "instantaneous")
    turns = 2.0 * FREQUENCIES
    shear = rubber.complex_shear_modulus(FREQUENCIES)
    np.testing.assert_allclose(shear.real, 1.2 * (0.2 + 0.8 * turns**2 / (1.0 + turns**2)), rtol=1e-12)
    np.testing.assert_allclose(shear.imag, 1.2 * 0.8 * turns / (1.0 + turns**2), rtol=1e-12)


@pytest.mark.parametrize("frequency", [0.2, 1.0, 3.0])
def test_complex_modulus_is_the_fourier_integral_of_the_relaxation(frequency: float) -> None:
    time = np.linspace(0.0, 40.0, 40001)
    turn = np.exp(-1j * frequency * time)
    for relaxation, modulus in (
        (TWO_BRANCHES.shear_relaxation, TWO_BRANCHES.complex_shear_modulus),
        (TWO_BRANCHES.bulk_relaxation, TWO_BRANCHES.complex_bulk_modulus),
    ):
        at_rest = modulus(0.0)
        integral = at_rest + 1j * frequency * simpson((relaxation(time) - at_rest.real) * turn, x=time)
        assert modulus(frequency) == pytest.approx(integral, rel=1e-9)


def test_branch_transfer_tends_to_zero_and_one(paper_rubber: Material) -> None:
    transfer = paper_rubber.branch_transfer(np.array([0.0, 1e20]))
    assert transfer.shape == (6, 2)
    assert np.all(transfer[:, 0] == 0.0)
    np.testing.assert_allclose(transfer[:, 1], 1.0, atol=1e-9)


def test_branch_carries_half_its_strain_at_its_own_frequency(paper_rubber: Material) -> None:
    own = 1.0 / np.array(paper_rubber.relaxation_times)
    np.testing.assert_allclose(np.diagonal(paper_rubber.branch_transfer(own)), 0.5 + 0.5j, rtol=1e-12)


def test_negative_frequency_gives_the_conjugate(paper_rubber: Material, plane: str, bulk: str) -> None:
    rubber = replace(paper_rubber, bulk=bulk)
    for modulus in (
        rubber.complex_shear_modulus,
        rubber.complex_bulk_modulus,
        lambda frequency: rubber.plane_modulus(frequency, plane),
        lambda frequency: rubber.thickness_ratio(frequency, plane),
    ):
        np.testing.assert_allclose(modulus(-FREQUENCIES), np.conj(modulus(FREQUENCIES)), rtol=1e-12)


def test_relaxing_bulk_keeps_poissons_ratio_at_every_frequency(paper_rubber: Material, moduli: str) -> None:
    rubber = replace(paper_rubber, moduli=moduli, bulk="proportional")
    np.testing.assert_allclose(rubber.effective_poissons_ratio(FREQUENCIES), 0.49, rtol=1e-10)


def test_elastic_bulk_turns_poissons_ratio_negative_at_high_speed(paper_rubber: Material) -> None:
    ratio = paper_rubber.effective_poissons_ratio(np.array([0.0, 300.0 * 1e4]))
    assert ratio[0] == pytest.approx(0.49, rel=1e-12)
    assert ratio[1] == pytest.approx(-0.31, abs=0.005)  # finest scale of the paper at 10 m/s


def test_rubber_without_branches_is_elastic(elastic_rubber: Material, plane: str) -> None:
    shear = 4.17 / 2.98
    assert elastic_rubber.long_term_fraction == 1.0
    assert elastic_rubber.instantaneous_shear_modulus == elastic_rubber.long_term_shear_modulus
    np.testing.assert_allclose(elastic_rubber.shear_relaxation(np.logspace(-9, 9, 7)), shear, rtol=1e-12)
    np.testing.assert_allclose(elastic_rubber.complex_shear_modulus(FREQUENCIES).real, shear, rtol=1e-12)
    assert np.all(elastic_rubber.complex_shear_modulus(FREQUENCIES).imag == 0.0)
    assert np.all(elastic_rubber.plane_modulus(FREQUENCIES, plane).imag == 0.0)


@pytest.mark.parametrize("ratio", [-0.5, 0.0, 0.3, 0.49, 0.4999])
def test_plane_moduli_of_an_elastic_solid(ratio: float) -> None:
    solid = Material("solid", 5.0, ratio, (), ())
    assert solid.plane_modulus(0.0, "strain").real == pytest.approx(5.0 / (1.0 - ratio**2), rel=1e-12)
    assert solid.plane_modulus(0.0, "stress").real == pytest.approx(5.0, rel=1e-12)


@pytest.mark.parametrize("ratio", [-0.5, 0.0, 0.3, 0.49])
def test_plane_moduli_keep_their_formulas_where_poissons_ratio_does_not_relax(ratio: float, plane: str) -> None:
    rubber = Material("rubber", 5.0, ratio, (0.6, 0.3), (1.0, 1e-4), bulk="proportional")
    youngs = 2.0 * (1.0 + ratio) * rubber.complex_shear_modulus(FREQUENCIES)
    expected = youngs / (1.0 - ratio**2) if plane == "strain" else youngs
    np.testing.assert_allclose(rubber.plane_modulus(FREQUENCIES, plane), expected, rtol=1e-11)


@pytest.mark.parametrize("ratio", [-0.5, 0.0, 0.3, 0.49])
def test_thickness_ratio_leaves_no_stress_across_the_thickness(ratio: float) -> None:
    solid = Material("solid", 5.0, ratio, (), ())
    across = solid.thickness_ratio(0.0, "stress").real
    assert across == pytest.approx(-ratio / (1.0 - ratio), abs=1e-12)


def test_thickness_ratio_of_rubber_makes_the_stress_across_vanish_at_every_frequency(paper_rubber: Material) -> None:
    shear, bulk = (
        paper_rubber.complex_shear_modulus(FREQUENCIES),
        paper_rubber.complex_bulk_modulus(FREQUENCIES),
    )
    across = paper_rubber.thickness_ratio(FREQUENCIES, "stress")
    trace = 1.0 + across  # for an in-plane dilatation of one
    stress = bulk * trace + 2.0 * shear * (across - trace / 3.0)
    assert np.abs(stress / bulk).max() < 1e-13


def test_no_strain_across_the_thickness_in_plane_strain(paper_rubber: Material) -> None:
    assert np.all(paper_rubber.thickness_ratio(FREQUENCIES, "strain") == 0.0)


@pytest.mark.parametrize("ratio", [0.0, 0.3, 0.49])
def test_confined_modulus_is_the_oedometers(ratio: float) -> None:
    solid = Material("solid", 5.0, ratio, (), ())
    oedometer = 5.0 * (1.0 - ratio) / ((1.0 + ratio) * (1.0 - 2.0 * ratio))
    assert solid.confined_modulus("strain") == pytest.approx(oedometer, rel=1e-12)
    assert solid.confined_modulus("stress") == pytest.approx(5.0 / (1.0 - ratio**2), rel=1e-12)


def test_confined_modulus_is_the_relaxed_one(paper_rubber: Material) -> None:
    assert paper_rubber.confined_modulus("strain") == pytest.approx(69.5 + 4.0 / 3.0 * 1.3993288590604, rel=1e-12)
    assert paper_rubber.confined_modulus("stress") == pytest.approx(4.17 / (1.0 - 0.49**2), rel=1e-12)


def test_shear_wave_speed_of_rubber_and_of_glass(paper_rubber: Material) -> None:
    speeds = paper_rubber.shear_wave_speed(np.array([0.0, 1e18]))
    np.testing.assert_allclose(speeds, np.sqrt(np.array([1.39932886, 973.788936]) / 1.1e-9), rtol=1e-8)


def test_extreme_frequencies_overflow_nowhere(paper_rubber: Material, bulk: str, plane: str) -> None:
    rubber = replace(paper_rubber, bulk=bulk)
    for values in (
        rubber.branch_transfer(EXTREMES),
        rubber.complex_shear_modulus(EXTREMES),
        rubber.complex_bulk_modulus(EXTREMES),
        rubber.plane_modulus(EXTREMES, plane),
        rubber.thickness_ratio(EXTREMES, plane),
        rubber.effective_poissons_ratio(EXTREMES),
        rubber.shear_wave_speed(EXTREMES),
        rubber.shear_relaxation(EXTREMES[:-1]),
    ):
        assert np.all(np.isfinite(values))
    losses = rubber.complex_shear_modulus(EXTREMES).imag
    assert np.all(losses >= 0.0)


def test_results_keep_the_shape_of_what_is_asked(paper_rubber: Material) -> None:
    def shapes(values: NDArray[np.float64]) -> set[tuple[int, ...]]:
        return {
            np.shape(paper_rubber.complex_shear_modulus(values)),
            np.shape(paper_rubber.shear_relaxation(values)),
            np.shape(paper_rubber.plane_modulus(values, "stress")),
        }

    assert shapes(np.ones((3, 2))) == {(3, 2)}
    assert shapes(np.float64(1.0)) == {()}


def test_equal_rubbers_are_equal_and_hash_alike() -> None:
    one = Material("rubber", 0.1 + 0.2, 0.49, [0.5], [1])
    two = Material("rubber", 0.3, 0.49, (0.5,), (1.0,))
    assert one == two
    assert hash(one) == hash(two)


@pytest.mark.parametrize(
    ("key", "value", "complaint"),
    [
        ("youngs_modulus", 0.0, "is 0 MPa, but must be greater than 0"),
        ("poissons_ratio", 0.5, "is 0.5, but must lie between -1 and 0.5, both excluded"),
        ("shear_fractions", [0.5, -0.1], None),
        ("relaxation_times", [1.0], "has 1 numbers, but must have as many as shear_fractions, 2"),
        ("relaxation_times", [1.0, 0.0], None),
        ("moduli", "longterm", r"is 'longterm', .*\(did you mean long_term\?\)"),
    ],
)
def test_bad_values_are_refused_with_their_key(key: str, value: object, complaint: str | None) -> None:
    sentence = rf"^rubbers\.table1\.{key} {complaint}" if complaint else rf"^rubbers\.table1\.{key}\[1\] is .*than 0$"
    with pytest.raises(InvalidInput, match=sentence):
        Material("table1", **{**CONFIG, key: value})


def test_name_unfit_for_a_path_is_refused() -> None:
    with pytest.raises(InvalidInput, match=r"^name of the rubber is 'a/b', but must be a word"):
        Material("a/b", 4.17, 0.49, (), ())


@pytest.mark.parametrize("fractions", [[0.7, 0.2, 0.1], [0.1] * 10, [0.5, 0.3, 0.2]])
def test_shares_that_add_up_to_one_are_refused_whatever_their_order(fractions: list[float]) -> None:
    # In floating point the first two add up to less than 1.
    with pytest.raises(InvalidInput, match=r"^rubbers\.r\.shear_fractions add up to 1, but must stay below 1$"):
        Material("r", 3.0, 0.49, fractions, [1.0] * len(fractions))  # type: ignore[arg-type]
