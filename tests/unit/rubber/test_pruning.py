"""Branches that a scene does not need: left out or gathered, within a bound that holds."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from rubfric.mechanics.steady.solution import fold_scene
from rubfric.rubber.material import Material
from rubfric.rubber.pruning import fold
from rubfric.scene.numerics import Numerics
from rubfric.scene.scene import Scene

SceneMaker = Callable[..., Scene]
BULK = pytest.mark.parametrize("bulk", ["elastic", "proportional"])
HARMONICS = np.arange(1, 65)
# A rubber keeps the twelve digits of a number that can be written.
WRITTEN = 1e-12
SPEEDS = pytest.mark.parametrize("frequency", [1e-4, 3.5, 35.0, 3.5e3, 3.5e5, 3e6, 1e12])


def largest_change(material: Material, folded: Material, frequencies: np.ndarray) -> float:
    """Return the largest change of the complex shear modulus over its loss part."""
    before, after = (rubber.complex_shear_modulus(frequencies) for rubber in (material, folded))
    return float((np.abs(after - before) / before.imag).max())


@BULK
@SPEEDS
@pytest.mark.parametrize("tolerance", [1e-4, 1e-2, 0.3])
def test_bound_bounds_the_change_of_the_modulus(
    paper_rubber: Material, bulk: str, frequency: float, tolerance: float
) -> None:
    rubber, frequencies = replace(paper_rubber, bulk=bulk), frequency * HARMONICS
    folding = fold(rubber, frequencies, tolerance)
    modulus = rubber.complex_shear_modulus(frequencies)
    round_off = WRITTEN / rubber.long_term_fraction * float((np.abs(modulus) / modulus.imag).max())
    assert folding.bound <= tolerance
    assert largest_change(rubber, folding.material, frequencies) <= folding.bound + round_off


@SPEEDS
def test_constants_of_the_relaxed_rubber_stay(paper_rubber: Material, frequency: float) -> None:
    folded = fold(paper_rubber, frequency * HARMONICS, 0.1).material
    assert folded.long_term_shear_modulus == pytest.approx(paper_rubber.long_term_shear_modulus, rel=1e-12)
    assert folded.long_term_bulk_modulus == pytest.approx(paper_rubber.long_term_bulk_modulus, rel=1e-12)
    assert (folded.bulk, folded.density) == (paper_rubber.bulk, paper_rubber.density)


@SPEEDS
def test_proportional_bulk_stays_proportional(paper_rubber: Material, frequency: float) -> None:
    rubber, frequencies = replace(paper_rubber, bulk="proportional"), frequency * HARMONICS
    folded = fold(rubber, frequencies, 0.1).material
    ratio = folded.complex_bulk_modulus(frequencies) / folded.complex_shear_modulus(frequencies)
    np.testing.assert_allclose(ratio, rubber.long_term_bulk_modulus / rubber.long_term_shear_modulus, rtol=1e-12)


@SPEEDS
def test_nothing_is_folded_at_a_tight_tolerance(paper_rubber: Material, frequency: float) -> None:
    folding = fold(paper_rubber, frequency * HARMONICS, 1e-30)
    assert folding.material is paper_rubber
    assert (folding.relaxed, folding.frozen, folding.bound) == ((), (), 0.0)


def test_fast_branches_are_left_out_at_low_speed(paper_rubber: Material) -> None:
    folding = fold(paper_rubber, 1e-4 * HARMONICS, 0.2)
    assert folding.frozen == ()
    assert set(folding.relaxed) >= {4, 5}
    assert 0 not in folding.relaxed
    kept = [time for index, time in enumerate(paper_rubber.relaxation_times) if index not in folding.relaxed]
    assert folding.material.relaxation_times == tuple(kept)


def test_slow_branches_are_gathered_at_high_speed(paper_rubber: Material) -> None:
    folding = fold(paper_rubber, 1e12 * HARMONICS, 0.1)
    assert folding.relaxed == ()
    assert folding.frozen == (0, 1, 2, 3, 4)
    assert len(folding.material.relaxation_times) == 2
    gathered = paper_rubber.branch_shear_moduli[:5].sum()
    np.testing.assert_allclose(
        folding.material.branch_shear_moduli, [paper_rubber.branch_shear_moduli[5], gathered], rtol=1e-12
    )


def test_gathered_branch_never_relaxes(paper_rubber: Material) -> None:
    folded = fold(paper_rubber, 1e12 * HARMONICS, 0.1).material
    np.testing.assert_allclose(folded.branch_transfer([1e-6, 1e12])[-1], 1.0, rtol=1e-12)


def test_branches_of_both_kinds_are_folded_in_between() -> None:
    rubber = Material("wide", 4.17, 0.49, (0.1, 0.1, 0.2, 0.1, 0.1), (1e6, 1e7, 1.0, 1e-6, 1e-7))
    folding = fold(rubber, np.array([0.5, 1.0, 2.0]), 0.01)
    assert (folding.frozen, folding.relaxed) == ((0, 1), (3, 4))
    assert folding.material.relaxation_times[0] == 1.0
    assert len(folding.material.relaxation_times) == 2


def test_one_frozen_branch_is_left_as_it_is() -> None:
    rubber = Material("two", 4.17, 0.49, (0.2, 0.5), (1e9, 1.0))
    folding = fold(rubber, np.array([1.0]), 0.01)
    assert folding.material is rubber
    assert folding.bound == 0.0


def test_rubber_without_branches_has_none_to_fold(elastic_rubber: Material) -> None:
    assert fold(elastic_rubber, 35.0 * HARMONICS, 0.5).material is elastic_rubber


def test_instantaneous_moduli_are_read_before_folding(paper_rubber: Material) -> None:
    rubber = replace(paper_rubber, moduli="instantaneous")
    for frequency in (1e-4, 3.5e3, 1e12):
        folding = fold(rubber, frequency * HARMONICS, 0.1)
        assert folding.relaxed or folding.frozen
        folded = folding.material
        assert folded.long_term_shear_modulus == pytest.approx(rubber.long_term_shear_modulus, rel=1e-12)
        incompressible = rubber.long_term_bulk_modulus / rubber.long_term_shear_modulus
        assert folded.long_term_bulk_modulus == pytest.approx(
            rubber.long_term_bulk_modulus, rel=WRITTEN * incompressible
        )
        assert largest_change(rubber, folded, frequency * HARMONICS) <= 0.1


@BULK
def test_bulk_modulus_changes_no_more_than_the_shear_modulus(paper_rubber: Material, bulk: str) -> None:
    rubber, frequencies = replace(paper_rubber, bulk=bulk), 3.5e5 * HARMONICS
    folded = fold(rubber, frequencies, 0.01).material
    before, after = (material.complex_bulk_modulus(frequencies) for material in (rubber, folded))
    allowed = np.maximum(0.01 * before.imag, 1e-12 * np.abs(before))
    assert np.all(np.abs(after - before) <= allowed)


def test_scene_folds_at_its_frequencies_within_its_accuracy(paper_scene: SceneMaker) -> None:
    scene = paper_scene(0.1, 1.0, numerics=Numerics(accuracy=0.1))
    folding = fold_scene(scene, 35.0 * HARMONICS)
    assert folding == fold(scene.material, 3.5 * HARMONICS, 1e-3)
    assert folding.relaxed
    assert fold_scene(replace(scene, numerics=Numerics(accuracy=1e-6)), 35.0 * HARMONICS).bound <= 1e-8
