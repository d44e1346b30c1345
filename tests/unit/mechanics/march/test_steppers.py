"""One step of a march, small and finite strain alike: limits of its length, invariances, the first law, snapshots."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import pytest
from finite_fields import ELASTIC, RUBBER

from rubfric.errors import NotConverged
from rubfric.mechanics.block.block import Block
from rubfric.mechanics.finite.march import FiniteStepper
from rubfric.mechanics.march.step import Outcome
from rubfric.mechanics.small.march import SmallStepper
from rubfric.mechanics.theory.compression import pressed
from rubfric.road.sine import SineScale
from rubfric.rubber.material import Material
from rubfric.scene.scene import Scene

SceneMaker = Callable[..., Scene]
PLANES = pytest.mark.parametrize("plane", ["strain", "stress"])
KINDS = pytest.mark.parametrize("kind", [SmallStepper, FiniteStepper])
Kind = type[SmallStepper] | type[FiniteStepper]
PRESSURE, FLAT = 0.5, SineScale(0.0, 35.0)
# The moduli that RUBBER has at once, all elastic.
SHEAR, BULK = RUBBER.instantaneous_shear_modulus, RUBBER.long_term_bulk_modulus
STIFF = Material(
    "stiff", 9.0 * BULK * SHEAR / (3.0 * BULK + SHEAR), (1.5 * BULK - SHEAR) / (3.0 * BULK + SHEAR), (), ()
)


@pytest.fixture
def stepper(paper_scene: SceneMaker) -> Callable[..., SmallStepper | FiniteStepper]:
    def build(
        kind: Kind, plane: str, material: Material = RUBBER, road: SineScale | None = None
    ) -> SmallStepper | FiniteStepper:
        scene = paper_scene(100.0, PRESSURE, plane=plane, material=material)
        scene = replace(scene, road=road or scene.road)
        return kind(scene, Block.graded(scene.road.wavelength, scene.height, 16, plane, 1.6))

    return build


Build = Callable[..., SmallStepper | FiniteStepper]


def depth(kind: Kind, material: Material, plane: str, height: float) -> float:
    """Return u_y of the top of an elastic block pressed on a flat road, mm."""
    if kind is SmallStepper:
        return -PRESSURE / material.confined_modulus(plane) * height
    return (pressed(material, PRESSURE, plane)[0] - 1.0) * height


@KINDS
@PLANES
def test_block_laid_on_the_road_carries_nothing(stepper: Build, kind: Kind, plane: str) -> None:
    model = stepper(kind, plane)
    assert (model.offset, model.pressure) == (0.0, 0.0)
    assert model.stored == pytest.approx(0.0, abs=1e-15)


@KINDS
@PLANES
@pytest.mark.parametrize(("duration", "limit"), [(1e-12, STIFF), (1e6, RUBBER)], ids=["at once", "slowly"])
def test_flat_road_has_the_limits_of_the_moduli(
    stepper: Build, kind: Kind, plane: str, duration: float, limit: Material
) -> None:
    model = stepper(kind, plane, road=FLAT)
    outcome = model.advance(duration, 0.0, PRESSURE)
    expected = depth(kind, limit, plane, model.block.height)
    assert outcome.top == pytest.approx(expected, rel=1e-5)
    assert outcome.friction == pytest.approx(0.0, abs=1e-12)
    assert outcome.contact_fraction == 1.0
    model = stepper(kind, plane, road=FLAT)
    model.press_relaxed(PRESSURE)
    relaxed = model.advance(1.0, 0.0, PRESSURE)
    assert relaxed.top == pytest.approx(depth(kind, RUBBER, plane, model.block.height), rel=1e-6)
    assert abs(relaxed.dissipated) <= 1e-9 * relaxed.stored


@KINDS
@PLANES
def test_elastic_block_keeps_its_energy(stepper: Build, kind: Kind, plane: str) -> None:
    """On a flat road forces follow one line in small strain: the trapezium misses nothing."""
    model = stepper(kind, plane, ELASTIC, FLAT)
    outcome = model.advance(1e-3, 0.0, PRESSURE)
    assert outcome.dissipated == 0.0
    assert outcome.stored_change == outcome.stored == model.stored
    assert abs(outcome.imbalance) <= (1e-12 if kind is SmallStepper else 0.1) * outcome.stored


def slid(model: SmallStepper | FiniteStepper, begin: float) -> list[Outcome]:
    """Press and slide in four steps; the road begins at ``begin``."""
    model.advance(1e-4, begin, PRESSURE)
    return [model.advance(2e-4, begin + 0.02 * step, PRESSURE) for step in (1, 2, 3)]


@KINDS
@PLANES
def test_road_a_period_on_is_the_same_road(stepper: Build, kind: Kind, plane: str) -> None:
    models = [stepper(kind, plane) for _ in range(2)]
    for one, other in zip(slid(models[0], 0.0), slid(models[1], models[0].block.width), strict=True):
        assert one.friction == pytest.approx(other.friction, abs=1e-6)
        assert one.top == pytest.approx(other.top, rel=1e-6)
        assert one.dissipated == pytest.approx(other.dissipated, rel=1e-4)


@KINDS
@PLANES
def test_snapshot_goes_on_to_the_last_digit(stepper: Build, kind: Kind, plane: str) -> None:
    one, other = stepper(kind, plane), stepper(kind, plane)
    slid(one, 0.0)
    other.restore(one.snapshot())
    one.renew()
    assert (other.offset, other.pressure, other.stored) == (one.offset, one.pressure, one.stored)
    assert one.advance(1e-4, 0.07, PRESSURE) == other.advance(1e-4, 0.07, PRESSURE)


@KINDS
def test_step_without_a_contact_leaves_the_state(stepper: Build, kind: Kind, monkeypatch: pytest.MonkeyPatch) -> None:
    model = stepper(kind, "strain")
    slid(model, 0.0)
    before = model.state

    def nowhere(*_: object) -> None:
        raise NotConverged("some scene", 3, 0.5, "number of surface nodes that violate contact")

    for name in ("small.march.pivot", "finite.contact.pivot", "finite.contact.follow"):
        monkeypatch.setattr(f"rubfric.mechanics.{name}", nowhere)
    with pytest.raises(NotConverged):
        model.advance(1e-4, 0.07, PRESSURE)
    assert model.state is before
