"""However a run is written down, its points are the same: order, units, separators, signs and offsets do not matter."""

from __future__ import annotations

import tempfile
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from rubfric.rig.reduction import point_table, reduce_files
from rubfric.rig.settings import Settings

AREA = 50.0
# unit: numbers in it per s, N or mm
UNITS = {
    "time": {"s": 1.0, "ms": 1e3, "min": 1.0 / 60.0},
    "normal force": {"N": 1.0, "kN": 1e-3, "daN": 0.1},
    "traction": {"N": 1.0, "kN": 1e-3, "mN": 1e3},
    "displacement": {"mm": 1.0, "m": 1e-3, "cm": 0.1, "µm": 1e3},
}
FOUND = ("speed_mm_per_s", "pressure_MPa", "friction_coefficient", "samples")
INTERVALS = ("speed_ci95_mm_per_s", "pressure_ci95_MPa", "friction_coefficient_ci95")


@cache
def run() -> np.ndarray:
    """Rest, a load of 25 N, 4 mm/s for 2 s against 8 N, rest; with noise; s, N, N, mm; shape (4, samples)."""
    rng = np.random.default_rng(11)
    time = np.arange(900) / 200.0
    on = np.clip((time - 0.5) / 0.3, 0.0, 1.0)
    sliding = (time > 1.2) & (time < 3.2)
    place = 4.0 * np.clip(time - 1.2, 0.0, 2.0)
    noise = rng.standard_normal((3, time.size)) * np.array([[0.05], [0.05], [0.002]])
    return np.stack([time, *(np.stack([25.0 * on, 8.0 * sliding, place]) + noise)])


def points(text: str) -> np.ndarray:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "run.csv"
        path.write_text(text, encoding="utf-8")
        table = point_table(reduce_files([str(path)], Settings(area=AREA)))
    return table[[*FOUND, *INTERVALS]].to_numpy(dtype=float)


def written(values: np.ndarray, units: dict[str, str], separator: str, decimal: str) -> str:
    factors = [UNITS[name][unit] for name, unit in units.items()]
    headings = separator.join(f"{name} ({unit})" for name, unit in units.items())
    rows = (separator.join(repr(float(v)).replace(".", decimal) for v in row) for row in (values.T * factors))
    return "\n".join([headings, *rows, ""])


@cache
def tidy() -> np.ndarray:
    return points(written(run(), {name: next(iter(known)) for name, known in UNITS.items()}, ",", "."))


ways = st.fixed_dictionaries(
    {
        "units": st.fixed_dictionaries({name: st.sampled_from(sorted(known)) for name, known in UNITS.items()}),
        "mark": st.sampled_from([(",", "."), (";", "."), (";", ","), ("\t", "."), ("\t", ",")]),
        "shuffled": st.one_of(st.none(), st.integers(0, 2**32 - 1)),
        "signs": st.tuples(*[st.sampled_from([1.0, -1.0])] * 3),
        "offsets": st.tuples(st.floats(-1e3, 1e3), *[st.floats(-5.0, 5.0)] * 2, st.floats(-100.0, 100.0)),
        "twice": st.booleans(),
    }
)


def test_tidy_run_has_its_point() -> None:
    (found,) = tidy()
    np.testing.assert_allclose(found[:3], [4.0, 25.0 / AREA, 8.0 / 25.0], rtol=2e-3)


@settings(max_examples=25, deadline=None)
@given(ways)
def test_writing_does_not_matter(way: dict[str, Any]) -> None:
    values = run() * np.array([1.0, *way["signs"]])[:, None] + np.array(way["offsets"])[:, None]
    if way["twice"]:
        values = np.concatenate((values, values[:, 300:500]), axis=1)
    if way["shuffled"] is not None:
        values = values[:, np.random.default_rng(way["shuffled"]).permutation(values.shape[1])]
    units = {name: way["units"][name] for name in UNITS}  # in the order of the rows
    found = points(written(values, units, *way["mark"]))
    np.testing.assert_allclose(found, tidy(), rtol=1e-6)
