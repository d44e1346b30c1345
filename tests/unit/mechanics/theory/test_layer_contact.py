from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rubfric.mechanics.theory.layer import full_contact_friction, westergaard_contact_fraction
from rubfric.mechanics.theory.layer_contact import Layer, load_road, load_sine
from rubfric.road.sine import SineScale
from rubfric.road.waves import WaveRoad
from rubfric.rubber.material import Material

ROAD = WaveRoad((0.015, 0.006, 0.003, 0.002), (35.0, 80.0, 200.0, 300.0), (0.0,) * 4)
HEIGHT = 0.75 * ROAD.wavelength
SINE = SineScale(0.015, 35.0)


@pytest.mark.parametrize("ratio", [1e-3, 0.1, 0.6, 0.95])
def test_elastic_half_space_is_westergaards(elastic_rubber: Material, ratio: float) -> None:
    layer = Layer(elastic_rubber, 1.0, 100.0, "strain")
    filling = float(layer.filling(SINE)[0])
    found = load_sine(layer, SINE, ratio * filling)
    assert found.fraction == pytest.approx(float(westergaard_contact_fraction(ratio)), rel=0.04)
    # p(x) = 2 p* cos(y) sqrt(A' - sin² y) peaks at 2 sqrt(p p*).
    assert found.pressure[-1] == pytest.approx(2.0 * filling * ratio**0.5, rel=0.01)
    assert abs(found.friction) < 1e-9


@pytest.mark.parametrize("velocity", [0.1, 1.0])
def test_filled_sine_is_the_closed_form(paper_rubber: Material, velocity: float) -> None:
    layer = Layer(paper_rubber, velocity, HEIGHT, "stress")
    pressure = 1.1 * float(layer.filling(SINE)[0])
    found = load_sine(layer, SINE, pressure)
    assert found.fraction == 1.0
    full = full_contact_friction(paper_rubber, SINE, velocity, pressure, HEIGHT, "stress")
    assert found.friction == pytest.approx(full, rel=1e-9)
    assert float(np.mean(found.pressure)) == pytest.approx(pressure, rel=1e-12)


@pytest.mark.parametrize(
    ("velocity", "friction"),
    [(0.1, 0.0014), (1.0, 0.0127), (10.0, 0.0291), (100.0, 0.1617), (500.0, 0.3006), (1000.0, 0.2621), (1e4, 0.1140)],
)
def test_coarsest_scale_of_the_paper(paper_rubber: Material, velocity: float, friction: float) -> None:
    # Two boundary-element codes written apart, 512 points, 5 MPa.
    found = load_sine(Layer(paper_rubber, velocity, HEIGHT, "strain"), SINE, 5.0)
    assert found.friction == pytest.approx(friction, rel=0.01, abs=1e-4)


@pytest.mark.parametrize(
    ("velocity", "friction"), [(10.0, 0.3390), (100.0, 0.6543), (500.0, 0.6437), (1000.0, 0.5510), (1e4, 0.2751)]
)
def test_whole_road_of_the_paper(paper_rubber: Material, velocity: float, friction: float) -> None:
    # Computed apart on 4096 points, to 0.1 %.
    found = load_road(Layer(paper_rubber, velocity, HEIGHT, "strain"), ROAD, 5.0)
    assert found.friction == pytest.approx(friction, rel=0.006)


@pytest.mark.parametrize(("velocity", "pressure"), [(0.01, 8.0), (100.0, 5.0), (1000.0, 0.5)])
def test_whole_road_may_begin_anywhere(paper_rubber: Material, velocity: float, pressure: float) -> None:
    layer = Layer(paper_rubber, velocity, HEIGHT, "strain")
    shift = 16.0 * ROAD.period / 1024.0  # a whole number of nodes on every surface
    moved = replace(ROAD, phases=tuple(k * shift for k in ROAD.wavenumbers))
    one, other = (load_road(layer, road, pressure) for road in (ROAD, moved))
    assert other.friction == pytest.approx(one.friction, rel=1e-6)
    assert other.fraction == one.fraction


def test_one_wave_is_its_sine(paper_rubber: Material) -> None:
    layer = Layer(paper_rubber, 100.0, HEIGHT, "strain")
    road = WaveRoad((0.015,), (35.0,), (0.7,))
    assert load_road(layer, road, 0.5).friction == pytest.approx(load_sine(layer, SINE, 0.5).friction, rel=0.01)


def test_every_contact_has_nodes_enough(paper_rubber: Material) -> None:
    light = load_road(Layer(paper_rubber, 1e4, HEIGHT, "strain"), ROAD, 0.5)
    assert len(light.pressure) >= 64
    assert light.friction == pytest.approx(0.1108, rel=0.02)


@pytest.mark.parametrize("pressure", [0.2, 0.5])
def test_friction_of_nearly_relaxed_rubber_is_proportional_to_speed(paper_rubber: Material, pressure: float) -> None:
    # So slow that the contact is that of the relaxed rubber; pressures on slopes alone would give three times as much.
    found = [load_road(Layer(paper_rubber, v, HEIGHT, "stress"), ROAD, pressure).friction for v in (1e-4, 2e-4, 4e-4)]
    assert 0.0 < found[0] < 1e-3
    assert found[1] == pytest.approx(2.0 * found[0], rel=0.1)
    assert found[2] == pytest.approx(4.0 * found[0], rel=0.1)
