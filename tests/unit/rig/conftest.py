"""A made-up friction with a peak, runs of the virtual rig on it, and files as loggers write them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
import pytest

from rubfric.results.friction_map import FrictionMap
from rubfric.rig.sensors import Ideal, Sensors, recorded
from rubfric.rig.settings import Settings
from rubfric.rig.sled import Sled
from rubfric.rig.virtual import Run, make

HEADINGS = ("time (s)", "normal force (N)", "traction (N)", "displacement (mm)")
FileWriter = Callable[..., str]


@pytest.fixture(scope="session")
def friction() -> FrictionMap:
    """Friction that peaks at 0.7 near 30 mm/s, and falls with pressure."""
    speeds = np.array([0.1, 1.0, 10.0, 100.0, 1000.0, 10000.0])
    pressures = np.array([0.1, 1.0, 5.0])
    bell = 0.7 * np.exp(-0.4 * (np.log10(speeds) - 1.5) ** 2)
    values = bell * np.array([[1.0], [0.9], [0.7]])
    return FrictionMap(speeds, pressures, values, 0.01 * values)


@pytest.fixture(scope="session")
def sled() -> Sled:
    return Sled(area=100.0, mass=5.0, travel=300.0, bearing_force=0.5, bearing_coefficient=0.005)


@pytest.fixture(scope="session")
def sensors() -> Sensors:
    return Sensors(sampling=500.0)


@pytest.fixture(scope="session")
def settings() -> Settings:
    return Settings(area=100.0)


@pytest.fixture(scope="session")
def steady(friction: FrictionMap, sled: Sled, sensors: Sensors) -> Ideal:
    """A run that settles at 5 mm/s, under 1 MPa."""
    weight = float(sled.resistance(friction.at(1.0), 1.0)(5.0)) / 9.80665
    return make(Run(1.0, weight, 5.0, True), friction, sled, sensors)


@pytest.fixture(scope="session")
def readings(steady: Ideal, sensors: Sensors) -> np.ndarray:
    """What the sensors record of it: s, N, N, mm; shape (4, samples)."""
    return recorded(steady, sensors, np.random.default_rng(7))


@pytest.fixture
def write_file(tmp_path: Path) -> FileWriter:
    """Return a function that writes readings as a logger may, and returns the path."""

    def write(
        readings: np.ndarray,
        headings: Sequence[str] = HEADINGS,
        separator: str = ",",
        decimal: str = ".",
        minus: str = "-",
        before: str = "",
        after: str = "",
        encoding: str = "utf-8",
        name: str = "run.csv",
    ) -> str:
        rows = (
            "\n".join(separator.join(map(repr, row)) for row in readings.T.tolist())
            .replace(".", decimal)
            .replace("-", minus)
        )
        text = f"{before}{separator.join(headings)}\n{rows}\n{after}"
        path = tmp_path / name
        path.write_bytes(text.encode(encoding))
        return str(path)

    return write
