"""Everything that the program admits, as strategies: numbers, rubbers, roads, scenes and configs."""

from __future__ import annotations

import copy
from pathlib import Path
from typing import Any

import yaml
from hypothesis import strategies as st

from rubfric import checks
from rubfric.road.sine import SineScale
from rubfric.rubber.material import BULK, MODULI, PLANES, Material
from rubfric.rules import LARGEST, LONGEST_WORD, SMALLEST
from rubfric.scene.numerics import Numerics
from rubfric.scene.procedure import STARTS
from rubfric.scene.scene import COLUMNS_PER_HEIGHT, KINEMATICS, Scene

Config = dict[str, Any]

ROOT = Path(__file__).resolve().parents[2]
SHIPPED: Config = yaml.safe_load((ROOT / "config" / "config.yaml").read_text(encoding="utf-8"))
MOST_BRANCHES = 40

names = st.one_of(
    st.text("ABCXYZabcxyz0189-_", min_size=1, max_size=6), st.sampled_from(["_", "-", "x" * LONGEST_WORD])
)


def magnitudes(low: float, high: float) -> st.SearchStrategy[float]:
    """Numbers from ``low`` to ``high``, evenly spread over the decades."""
    exponents = st.floats(0.0, 1.0)
    return exponents.map(lambda share: min(max(low * (high / low) ** share, low), high))


positive = st.one_of(
    magnitudes(SMALLEST, LARGEST),
    st.integers(1, 10**9),
    st.sampled_from([SMALLEST, LARGEST, 0.1 + 0.2, 1.0 / 3.0]),
)
poissons_ratios = st.one_of(
    st.floats(-0.999, 0.4999), st.sampled_from([-1.0 + 1e-11, 0.0, 0.5 - 1e-11, 0.4999]), st.just(0)
)


@st.composite
def fractions(draw: st.DrawFn, branches: int) -> list[float]:
    """Shares of branches, over many decades, that add up to less than one."""
    weights = draw(st.lists(magnitudes(1e-9, 1.0), min_size=branches, max_size=branches))
    total = draw(st.one_of(st.floats(0.01, 0.999), st.sampled_from([1e-6, 1.0 - 1e-9])))
    return [total * weight / sum(weights) for weight in weights]


@st.composite
def rubber_entries(draw: st.DrawFn, most: int = MOST_BRANCHES) -> Config:
    """Entries of ``rubbers`` in a config; what may be left out is, at times."""
    branches = draw(st.integers(0, most))
    centre = draw(st.floats(-10.0, 10.0))
    times = st.floats(centre - 10.0, centre + 10.0).map(lambda power: 10.0**power)
    entry: Config = {
        "youngs_modulus": draw(positive),
        "poissons_ratio": draw(poissons_ratios),
        "shear_fractions": draw(fractions(branches)),
        "relaxation_times": draw(st.lists(times, min_size=branches, max_size=branches)),
    }
    optional = {"moduli": st.sampled_from(MODULI), "bulk": st.sampled_from(BULK), "density": positive}
    return entry | {key: draw(values) for key, values in optional.items() if draw(st.booleans())}


def rubbers(most: int = MOST_BRANCHES) -> st.SearchStrategy[Material]:
    """Rubbers of up to so many branches."""
    return st.builds(lambda name, entry: Material(name=name, **entry), names, rubber_entries(most))


scale_entries = st.fixed_dictionaries({"amplitude": st.one_of(positive, st.just(0)), "wavenumber": positive})
roads = scale_entries.map(lambda entry: SineScale(**entry))


def grids(values: st.SearchStrategy[float], most: int = 3) -> st.SearchStrategy[list[float]]:
    """Lists of distinct numbers in any order."""
    return st.lists(values, min_size=1, max_size=most, unique_by=lambda value: checks.number("", value))


@st.composite
def scenes(draw: st.DrawFn, most_branches: int = MOST_BRANCHES) -> Scene:
    """Scenes at the limits of what is admitted, at the shipped numerics."""
    flattest = COLUMNS_PER_HEIGHT / Numerics().columns_max
    return Scene(
        scale=draw(st.integers(1, 99)),
        road=draw(roads),
        velocity=draw(positive),
        pressure=draw(positive),
        aspect=draw(magnitudes(1.01 * flattest, LARGEST)),
        material=draw(rubbers(most_branches)),
        plane=draw(st.sampled_from(PLANES)),
        kinematics=draw(st.sampled_from(KINEMATICS)),
    )


@st.composite
def configs(draw: st.DrawFn) -> Config:
    """Whole configs. The numerics are those of the shipped config."""
    catalogue = draw(st.dictionaries(names, rubber_entries(2), min_size=1, max_size=2))
    listed = st.lists(scale_entries, min_size=1, max_size=3)
    road_entries = draw(st.dictionaries(names, listed, min_size=1, max_size=2))
    road = draw(st.sampled_from(sorted(road_entries)))
    scale = st.integers(1, len(road_entries[road]))
    grid = {"velocities": draw(grids(positive)), "pressures": draw(grids(positive)), "aspect": draw(positive)}
    return copy.deepcopy(SHIPPED) | {
        "results": draw(st.sampled_from(["results", "results/mine", "/tmp/elsewhere", "a folder", "läufe/"])),
        "rubber": draw(st.sampled_from(sorted(catalogue))),
        "road": road,
        "plane": draw(st.sampled_from(PLANES)),
        "kinematics": draw(st.sampled_from(KINEMATICS)),
        "multiscale": draw(st.sampled_from(["sum", "cascade", "persson"])),  # others need a road with a period
        "multiscale_preset": draw(st.sampled_from(sorted(SHIPPED["presets"]))),
        "phases": {"draws": draw(st.integers(0, 9)), "seed": draw(st.integers(0, 2**31))},
        "grid": grid,
        "aspect_study": {
            "aspects": draw(grids(positive)),
            "scales": draw(st.lists(scale, min_size=1, unique=True)),
            "pressures": draw(grids(positive)),
        },
        "transient": {
            "scale": draw(scale),
            "velocities": draw(grids(positive)),
            "pressure": draw(positive),
            "start": draw(st.sampled_from(STARTS)),
            "columns": 8 * draw(st.integers(1, 128)),
            "steps_per_wavelength": draw(st.integers(4, 1000)),
            "wavelengths": draw(st.integers(1, 1000)),
            "saturation": draw(magnitudes(1e-6, 0.5)),
        },
        "figures": {
            "total_pressure": draw(st.sampled_from(grid["pressures"])),
            "fields": {
                "scale": draw(scale),
                "velocities": draw(st.lists(st.sampled_from(grid["velocities"]), min_size=1, unique=True)),
                "pressures": draw(st.lists(st.sampled_from(grid["pressures"]), min_size=1, unique=True)),
            },
        },
        "rubbers": catalogue,
        "roads": road_entries,
    }
