from __future__ import annotations

import numpy as np
import pytest

from rubfric.mechanics.theory import cascade
from rubfric.mechanics.theory.cascade import cascade_friction
from rubfric.mechanics.theory.layer import full_contact_friction
from rubfric.mechanics.theory.layer_contact import Layer, load_sine
from rubfric.road.sine import SineScale
from rubfric.rubber.material import Material

SINES = tuple(SineScale(a, k) for a, k in ((0.015, 35.0), (0.006, 80.0), (0.003, 200.0), (0.002, 300.0)))
HEIGHT = 0.75 * SINES[0].wavelength


@pytest.mark.parametrize(
    ("velocity", "friction"),
    [(0.1, 0.029), (1.0, 0.095), (10.0, 0.357), (100.0, 0.847), (500.0, 0.929), (1000.0, 0.829), (1e4, 0.487)],
)
def test_total_of_the_papers_road(paper_rubber: Material, velocity: float, friction: float) -> None:
    # Computed apart, 5 MPa, to three digits.
    found = cascade_friction(Layer(paper_rubber, velocity, HEIGHT, "strain"), SINES, 5.0)
    assert found == pytest.approx(friction, rel=0.01, abs=5e-4)


@pytest.mark.parametrize("pressure", [0.03, 1.0, 20.0])
def test_one_scale_is_alone(paper_rubber: Material, pressure: float) -> None:
    layer = Layer(paper_rubber, 100.0, HEIGHT, "stress")
    assert cascade_friction(layer, SINES[:1], pressure) == load_sine(layer, SINES[0], pressure).friction


def test_two_filled_scales_add_up(paper_rubber: Material) -> None:
    layer = Layer(paper_rubber, 0.1, HEIGHT, "strain")
    sines = SINES[:2]
    # Heavy enough that the lowest pressure on the coarser scale fills the finer one: friction is c / p at every place.
    pressure = 1.05 * sum(float(layer.filling(sine)[0]) for sine in sines)
    full = [full_contact_friction(paper_rubber, sine, 0.1, pressure, HEIGHT, "strain") for sine in sines]
    assert cascade_friction(layer, sines, pressure) == pytest.approx(sum(full), rel=2e-3)


def test_second_scale_is_the_mean_over_the_pressures_of_the_first(paper_rubber: Material) -> None:
    layer = Layer(paper_rubber, 100.0, HEIGHT, "strain")
    first = load_sine(layer, SINES[0], 0.5)
    # Every node's own contact with the finer scale, instead of a table.
    finer = np.array([load_sine(layer, SINES[1], float(p)).friction for p in first.pressure])
    expected = first.friction + first.fraction * float(np.mean(first.pressure * finer)) / 0.5
    assert cascade_friction(layer, SINES[:2], 0.5) == pytest.approx(expected, rel=0.02)


@pytest.mark.parametrize(("velocity", "pressure"), [(1.0, 5.0), (100.0, 1.0), (1e4, 0.2)])
def test_finer_ladder_changes_little(
    paper_rubber: Material, velocity: float, pressure: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    layer = Layer(paper_rubber, velocity, HEIGHT, "strain")
    coarse = cascade_friction(layer, SINES, pressure)
    monkeypatch.setattr(cascade, "_RUNGS", 12)
    monkeypatch.setattr(cascade, "_LOWEST", 0.01)
    assert coarse == pytest.approx(cascade_friction(layer, SINES, pressure), rel=0.01)
