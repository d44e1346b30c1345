from __future__ import annotations

from dataclasses import replace

import pytest

from rubfric.mechanics.theory.coupling import WAYS, Coupling, estimate
from rubfric.road.waves import WaveRoad
from rubfric.rubber.material import Material

ROAD = WaveRoad((0.015, 0.006, 0.003, 0.002), (35.0, 80.0, 200.0, 300.0), (0.0,) * 4)
HEIGHT = 0.75 * ROAD.wavelength
EVERY_WAY = pytest.mark.parametrize("way", WAYS)


def test_heavy_and_slow_needs_no_direct_total(paper_rubber: Material) -> None:
    found = estimate(paper_rubber, ROAD, 0.1, 5.0, HEIGHT, "strain", "small")
    assert found.sum == pytest.approx(0.0291, rel=0.01)
    assert found.direct == pytest.approx(0.0290, rel=0.01)
    assert found.error("sum") < 0.05
    assert found.cheapest(0.05) == "sum"
    assert found.cheapest(0.01) == "direct"


def test_peak_of_friction_needs_the_direct_total(paper_rubber: Material) -> None:
    found = estimate(paper_rubber, ROAD, 100.0, 5.0, HEIGHT, "strain", "small")
    assert found.sum == pytest.approx(1.018, rel=0.01)
    assert found.cascade == pytest.approx(0.847, rel=0.01)
    assert found.persson == pytest.approx(0.720, rel=0.01)
    assert found.direct == pytest.approx(0.654, rel=0.01)
    assert found.error("sum") > 0.36
    assert found.cheapest(0.01) == "direct"
    assert found.cheapest(0.05) == "corrected"
    assert found.cheapest(0.2) == "persson"


@EVERY_WAY
def test_bound_covers_the_ratio_and_its_margin(way: str) -> None:
    found = Coupling(sum=1.0, cascade=0.8, persson=0.5, direct=0.6, margin=0.1)
    total = found.total(way, 2.0)
    assert total == pytest.approx(2.0 * (found.direct if way == "corrected" else getattr(found, way)))
    for truth in (0.9 * 1.2, 1.1 * 1.2):
        assert abs(truth / total - 1.0) <= found.error(way) * (1.0 + 1e-12)


def test_corrected_sum_is_worth_its_margin() -> None:
    found = Coupling(sum=1.0, cascade=0.8, persson=0.5, direct=0.6, margin=0.1)
    assert found.total("corrected", 2.0) == pytest.approx(1.2)
    assert found.error("corrected") == pytest.approx(0.1)


def test_the_cheapest_way_that_will_do_comes_first() -> None:
    found = Coupling(sum=1.0, cascade=1.0, persson=1.0, direct=1.0, margin=0.1)
    assert found.cheapest(0.1 * (1.0 + 1e-12)) == "sum"
    assert found.cheapest(0.05) == "direct"


def test_finite_strain_has_the_wider_margin_and_more_of_it_where_the_block_is_pressed(paper_rubber: Material) -> None:
    light, heavy = (estimate(paper_rubber, ROAD, 1000.0, p, HEIGHT, "stress").margin for p in (0.1, 5.0))
    small = estimate(paper_rubber, ROAD, 1000.0, 5.0, HEIGHT, "stress", "small").margin
    assert small < light < heavy


@EVERY_WAY
def test_no_friction_has_no_error(elastic_rubber: Material, way: str) -> None:
    found = estimate(elastic_rubber, ROAD, 1.0, 1.0, HEIGHT, "strain")
    assert found.error(way) == 0.0
    assert found.total(way, 3e-17) == 3e-17
    assert found.cheapest(0.001) == "sum"


@EVERY_WAY
def test_a_flat_road_has_neither(paper_rubber: Material, way: str) -> None:
    flat = replace(ROAD, amplitudes=(0.0,) * 4)
    found = estimate(paper_rubber, flat, 1.0, 1.0, HEIGHT, "strain")
    assert found.total(way, 0.0) == found.error(way) == 0.0


def test_one_wave_has_no_coupling(paper_rubber: Material) -> None:
    road = WaveRoad((0.015,), (35.0,), (0.0,))
    found = estimate(paper_rubber, road, 100.0, 1.0, HEIGHT, "stress", "small")
    assert found.cascade == found.sum
    assert found.direct == pytest.approx(found.sum, rel=0.01)


def test_lengths_and_speed_scaled_together_change_nothing(paper_rubber: Material) -> None:
    big = WaveRoad(tuple(2.0 * a for a in ROAD.amplitudes), tuple(0.5 * k for k in ROAD.wavenumbers), ROAD.phases)
    one = estimate(paper_rubber, ROAD, 100.0, 1.0, HEIGHT, "strain")
    other = estimate(paper_rubber, big, 200.0, 1.0, 2.0 * HEIGHT, "strain")
    for way in ("sum", "cascade", "persson", "direct"):
        assert getattr(other, way) == pytest.approx(getattr(one, way), rel=1e-6)
