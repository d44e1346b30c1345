"""A fitted rubber at other temperatures: its window and its samples move as the rubber does."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rubfric.rubber.fitted import FittedRubber, Measured, Sample
from rubfric.rubber.material import Material
from rubfric.rubber.shift import Shift

SHIFT = Shift("wlf", 20.0, c1=8.86, c2=101.6, vertical="entropic")
SAMPLES = (Sample(1.0, (2.0, 3.0), (1e-3, 1e-5)), Sample(1.1, (2.1, 2.9), (1e-3, 1e-5)))


def fitted(material: Material) -> FittedRubber:
    return FittedRubber(material, SHIFT, Measured((1.0, 1e6), SAMPLES), (SHIFT, replace(SHIFT, c1=9.0)))


def test_each_sample_is_shifted_by_its_own_factors_and_the_window_by_the_fits(paper_rubber: Material) -> None:
    rubber = fitted(paper_rubber)
    material, measured = rubber.at(0.0)
    assert material.youngs_modulus == pytest.approx(paper_rubber.youngs_modulus * 273.15 / 293.15)
    assert measured.window == pytest.approx((1.0 / SHIFT.factor(0.0), 1e6 / SHIFT.factor(0.0)), rel=1e-11)
    for before, after, shift in zip(SAMPLES, measured.samples, rubber.shifts, strict=True):
        times, moduli = shift.factor(0.0), 273.15 / 293.15
        assert after.static == pytest.approx(before.static * moduli, rel=1e-4)
        assert after.moduli == pytest.approx([moduli * one for one in before.moduli], rel=1e-4)
        assert after.times == pytest.approx([times * one for one in before.times], rel=1e-4)
    assert rubber.at() == rubber.at(20.0) == (paper_rubber, rubber.measured)


def test_plain_values_give_it_back(paper_rubber: Material) -> None:
    rubber = fitted(paper_rubber)
    assert FittedRubber.from_parameters(rubber.parameters()) == rubber
