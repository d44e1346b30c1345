"""A block marched over the whole road, step by step, has the friction that the steady solver finds at once.

Friction of steady sliding does not vary in time, so a sixteenth of a period is enough. Slow sliding starts from rest:
what it ends in knows nothing of the steady solution. At speeds at which the slowest branch remembers many periods
the march starts from the steady state, and shows that it stays.
"""

from __future__ import annotations

import pytest
from whole_road import pinned, whole_scene

from rubfric.marching import begin
from rubfric.road.road import finest_waves
from rubfric.rubber.material import PLANES
from rubfric.scene.procedure import PHASES, Procedure
from rubfric.scene.scene import Scene
from rubfric.simulation import solve

pytestmark = pytest.mark.thorough

# Columns of cells, and steps for each finest wave: where a tenth of it is touched, steps must be shorter than that.
COARSE, FINE = (1024, 32), (3072, 64)
SHARE = 0.0625


def marched(scene: Scene, start: str, steps: int, share: float = SHARE) -> float:
    """Return friction by contact, averaged over the last half of the way at full speed."""
    columns = scene.numerics.columns_max
    procedure = Procedure(
        start=start,
        columns=columns,
        start_share=0.02,
        steps_per_wavelength=steps,
        wavelengths=1,
        until_saturated=False,
    )
    march = begin(scene, procedure)
    slid = 0
    while slid < share * procedure.steps_per_period(scene.road):
        march.step()
        slid = int((march.records["phase"] == PHASES.index("slide")).sum())
    return float(march.records["friction_contact"][-(slid // 2) :].mean())


@pytest.mark.parametrize(
    ("velocity", "pressure", "start", "mesh", "plane"),
    [
        *((0.1, 0.5, "relaxed", COARSE, plane) for plane in PLANES),
        (1.0, 0.5, "relaxed", COARSE, "strain"),
        (100.0, 5.0, "steady", COARSE, "stress"),
        (1000.0, 5.0, "steady", COARSE, "strain"),
        (10.0, 0.5, "steady", FINE, "strain"),
        (100.0, 0.5, "steady", FINE, "stress"),
        (1000.0, 0.5, "steady", FINE, "strain"),
    ],
)
def test_march_in_small_strain_ends_in_steady_friction(
    velocity: float, pressure: float, start: str, mesh: tuple[int, int], plane: str
) -> None:
    columns, steps = mesh
    scene = whole_scene(velocity, pressure, plane=plane, numerics=pinned(columns, 1.3 if mesh == COARSE else 1.2))
    friction = marched(scene, start, steps)
    expected = solve(whole_scene(velocity, pressure, plane=plane)).friction.stress_power
    assert friction == pytest.approx(expected, rel=0.01)


@pytest.mark.thorough
def test_pressed_and_slid_half_a_period_friction_is_that_of_steady_sliding() -> None:
    """The slowest branch remembers a tenth of a period at this speed."""
    scene = whole_scene(10.0, 0.5, numerics=pinned(1024, 1.3))
    expected = solve(whole_scene(10.0, 0.5)).friction.stress_power
    assert marched(scene, "relaxed", COARSE[1], 0.9) == pytest.approx(expected, rel=0.01)


@pytest.mark.thorough
@pytest.mark.parametrize("velocity", [100.0, 1000.0])
def test_march_in_finite_strain_stays_at_steady_friction(velocity: float) -> None:
    """Thirty steps: as far as a contact spot is wide, several times."""
    columns, steps = 2048, 32
    scene = whole_scene(velocity, 0.5, kinematics="finite", numerics=pinned(columns, 1.3))
    expected = solve(whole_scene(velocity, 0.5, kinematics="finite"))
    friction = marched(scene, "steady", steps, 30 / (steps * finest_waves(scene.road)))
    assert friction == pytest.approx(expected.friction.stress_power, rel=0.01)
