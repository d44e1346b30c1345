"""Fixtures for all tests: strict floating point, a seeded generator, the paper's rubber and road."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from importlib import import_module
from typing import Any

import numpy as np
import pytest
from xdist.scheduler import LoadScopeScheduling

from rubfric.road.sine import SineScale
from rubfric.rubber.material import Material
from rubfric.scene.numerics import Numerics
from rubfric.scene.scene import Scene

# Zhou, Wang and Wei 2019, Table 1: shares of the instantaneous shear modulus, and relaxation times in s.
TABLE_1_FRACTIONS = (0.000592717, 0.002536278, 0.024459921, 0.17432432, 0.387971288, 0.408678482)
TABLE_1_TIMES = (0.01134034, 0.0002628, 1.316e-05, 1.295e-06, 7.708e-08, 4.2e-10)
# The same, section 3.2: amplitude in mm and wavenumber in 1/mm, from coarse to fine.
SCALES = ((0.015, 35.0), (0.006, 80.0), (0.003, 200.0), (0.002, 300.0))

SceneMaker = Callable[..., Scene]

# Folders whose tests share a campaign that takes long to run: one worker does all of a folder, and begins with it.
TOGETHER = ("results", "workflow", "browser", "cluster")
# Folders of which every test takes long, or needs what a plain machine has not.
THOROUGH = ("results", "browser", "cluster")


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--perturb", type=int, metavar="SEED", help="perturb what every contact solve is given by 1e-13")


def pytest_configure(config: pytest.Config) -> None:
    seed = config.getoption("--perturb")
    if seed is not None:
        perturb_contact_solves(seed)


def perturb_contact_solves(seed: int) -> None:
    """Multiply road and load of every contact solve by 1 + 1e-13 r, as if by another machine's round-off.

    In partial contact each node of the road has an r of its own; in full contact, where harmonics that the road
    lacks must stay absent, all have the same. The solvers import these functions by name: this has to come before.
    """

    def perturbed(function: Callable[..., Any], by_node: bool) -> Callable[..., Any]:
        def solve(compliance: Any, profile: np.ndarray, nominal: float, *others: Any, **named: Any) -> Any:
            noise = 1.0 + 1e-13 * np.random.default_rng([seed, len(profile)]).uniform(-1.0, 1.0, len(profile) + 1)
            return function(
                compliance, profile * (noise[1:] if by_node else noise[1]), nominal * noise[0], *others, **named
            )

        return solve

    contact = import_module("rubfric.mechanics.block.contact")
    contact.pivot = perturbed(contact.pivot, by_node=True)
    contact.full_contact = perturbed(contact.full_contact, by_node=False)


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark the folders of ``THOROUGH``; begin with what takes longest: those of ``TOGETHER``, then verification."""
    for item in items:
        if folder(item.nodeid) in THOROUGH:
            item.add_marker("thorough")
    order = {name: place for place, name in enumerate((*TOGETHER, "verification"))}
    items.sort(key=lambda item: order.get(folder(item.nodeid), len(order)))


def folder(nodeid: str) -> str:
    """Return the folder of ``tests`` that a test is in."""
    return nodeid.removeprefix("tests/").partition("/")[0]


class _ByFolder(LoadScopeScheduling):  # type: ignore[misc]
    """Gives workers a folder of ``TOGETHER`` whole, and of all others file by file."""

    def _split_scope(self, nodeid: str) -> str:
        return folder(nodeid) if folder(nodeid) in TOGETHER else nodeid.partition("::")[0]


def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> _ByFolder:
    """Return what deals out the tests where several workers run them."""
    return _ByFolder(config, log)


@pytest.fixture(autouse=True)
def strict_floating_point() -> Iterator[None]:
    """Turn overflow, invalid operations and division by zero into failures; underflow is harmless."""
    with np.errstate(all="raise", under="ignore"):
        yield


@pytest.fixture
def rng() -> np.random.Generator:
    return np.random.default_rng(20190923)


@pytest.fixture(scope="session")
def paper_rubber() -> Material:
    return Material(
        name="table1",
        youngs_modulus=4.17,
        poissons_ratio=0.49,
        shear_fractions=TABLE_1_FRACTIONS,
        relaxation_times=TABLE_1_TIMES,
        moduli="long_term",
        bulk="elastic",
    )


@pytest.fixture(scope="session")
def elastic_rubber() -> Material:
    return Material("elastic", youngs_modulus=4.17, poissons_ratio=0.49, shear_fractions=(), relaxation_times=())


@pytest.fixture(scope="session")
def paper_road() -> tuple[SineScale, ...]:
    return tuple(SineScale(amplitude, wavenumber) for amplitude, wavenumber in SCALES)


@pytest.fixture(scope="session")
def paper_scene(paper_rubber: Material, paper_road: tuple[SineScale, ...]) -> SceneMaker:
    """Return a function that builds scenes on the paper's road; anything may be overridden."""

    def build(velocity: float, pressure: float, scale: int = 1, **changes: object) -> Scene:
        given: dict[str, object] = {
            "road": paper_road[scale - 1],
            "aspect": 0.75,
            "material": paper_rubber,
            "plane": "strain",
            "kinematics": "small",
            "numerics": Numerics(),
        }
        return Scene(scale=scale, velocity=velocity, pressure=pressure, **{**given, **changes})

    return build
