"""The paper's tables: complete, consistent and physical."""

from __future__ import annotations

import io
import re
import subprocess
import sys
from itertools import product

import numpy as np
import pandas as pd
import pytest
from project_copy import Project

from rubfric.mechanics.theory.compression import pressed

SCALES = (1, 2, 3, 4)
VELOCITIES = (0.1, 1.0, 10.0, 100.0, 500.0, 1000.0, 10000.0)
PRESSURES = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0)
ASPECTS = (0.25, 0.5, 0.75, 1.0, 1.5)
# Friction coefficients of converged meshes, to hold to 1 %, by scale, speed (mm/s), pressure (MPa)
# and aspect; plane stress.
KNOWN = {
    (1, 0.1, 5.0, 0.75): 0.002342,
    (1, 100.0, 0.5, 0.75): 0.1958,
    (1, 100.0, 5.0, 0.75): 0.2049,
    (1, 500.0, 5.0, 0.75): 0.2903,
    (1, 10000.0, 0.1, 0.75): 0.007571,
    (1, 1.0, 0.5, 0.25): 0.0477,
    (2, 500.0, 5.0, 0.75): 0.228,
    (3, 100.0, 5.0, 0.75): 0.3155,
    (4, 100.0, 5.0, 0.75): 0.2871,
    (4, 10.0, 2.0, 0.75): 0.2736,
    (4, 10000.0, 0.1, 0.75): 0.002092,
}


def read(paper: Project, name: str) -> pd.DataFrame:
    return pd.read_csv(io.StringIO(paper.tables[name]))


@pytest.fixture(scope="module")
def scales(paper: Project) -> dict[int, pd.DataFrame]:
    return {scale: read(paper, f"friction_scale_{scale}.csv") for scale in SCALES}


@pytest.fixture(scope="module")
def every_scene(scales: dict[int, pd.DataFrame]) -> pd.DataFrame:
    """All scenes of all scales, one row each."""
    return pd.concat(scales, names=["scale"]).reset_index(level="scale").reset_index(drop=True)


@pytest.fixture(scope="module")
def total(paper: Project) -> pd.DataFrame:
    return read(paper, "friction_total.csv")


def points(table: pd.DataFrame, *columns: str) -> list[tuple[float, ...]]:
    return list(table[list(columns)].itertuples(index=False, name=None))


@pytest.mark.parametrize("scale", SCALES)
def test_every_scale_has_the_whole_grid_once(scales: dict[int, pd.DataFrame], scale: int) -> None:
    table = scales[scale]
    grid = table[table["aspect"] == 0.75]
    assert points(grid, "pressure_MPa", "velocity_mm_per_s") == list(product(PRESSURES, VELOCITIES))
    assert len(grid) == 42
    assert len(table) == (98 if scale == 1 else 42)


def test_aspect_study_is_complete(scales: dict[int, pd.DataFrame]) -> None:
    study = scales[1][scales[1]["pressure_MPa"].isin((0.5, 5.0))]
    expected = list(product(ASPECTS, (0.5, 5.0), VELOCITIES))
    assert points(study, "aspect", "pressure_MPa", "velocity_mm_per_s") == expected


def test_no_number_is_missing(every_scene: pd.DataFrame, total: pd.DataFrame) -> None:
    assert len(every_scene) == 224
    assert np.isfinite(every_scene.to_numpy(dtype=float)).all()
    numbers = total.drop(columns=["friction_road_error", "way", "note"])
    direct = total["way"] == "direct"
    assert direct.sum() > 0.5 * len(total)
    assert np.isfinite(numbers[direct].to_numpy(dtype=float)).all()
    assert np.isfinite(total[["friction_total", "friction_total_error"]].to_numpy(dtype=float)).all()


def test_total_is_the_direct_one_or_the_corrected_sum_that_stands_in(total: pd.DataFrame) -> None:
    direct = total["way"] == "direct"
    assert (total["way"] == np.where(direct, "direct", "corrected")).all()
    assert (total["friction_total"] == np.where(direct, total["friction_direct"], total["friction_corrected"])).all()
    assert total["refused"].sum() <= 3
    assert (total["friction_coupling_error"][direct] == 0.0).all()
    assert (total["friction_coupling_error"][~direct] > 0.0).all()
    assert total["friction_road_error"].isna().all()
    assert (total["note"][direct] == "one road with these phases").all()


def test_bound_on_the_coupling_covers_the_direct_totals(total: pd.DataFrame) -> None:
    known = total[total["way"] == "direct"]
    for way in ("sum", "corrected", "cascade", "persson"):
        off = (known[f"friction_{way}"] - known["friction_direct"]).abs()
        assert (off <= known[f"friction_{way}_error"] + known["friction_direct_error"]).mean() >= 0.9


def test_sum_is_that_of_the_scales(total: pd.DataFrame, scales: dict[int, pd.DataFrame]) -> None:
    assert points(total, "pressure_MPa", "velocity_mm_per_s") == list(product(PRESSURES, VELOCITIES))
    parts = total[[f"friction_scale_{scale}" for scale in SCALES]]
    np.testing.assert_allclose(parts.sum(axis=1), total["friction_sum"], rtol=1e-5)
    for scale, table in scales.items():
        grid = table[table["aspect"] == 0.75]
        assert parts[f"friction_scale_{scale}"].tolist() == grid["friction_coefficient"].tolist()


def test_every_friction_has_an_error_and_errors_add_up(
    every_scene: pd.DataFrame, total: pd.DataFrame, scales: dict[int, pd.DataFrame]
) -> None:
    relative = every_scene["friction_coefficient_error"] / every_scene["friction_coefficient"]
    assert 0.0 < relative.min() <= relative.max() < 0.1
    grids = [table[table["aspect"] == 0.75]["friction_coefficient_error"].to_numpy() for table in scales.values()]
    assert (total["friction_sum_error"] > np.sum(grids, axis=0)).all()
    names = ["friction_numerical_error", "friction_coupling_error"]
    np.testing.assert_allclose(total["friction_total_error"], total[names].sum(axis=1), rtol=1e-5)


def test_energy_closes_in_every_scene(every_scene: pd.DataFrame) -> None:
    assert every_scene["energy_closure"].max() <= 0.01


def test_every_scene_needs_finite_strain(paper: Project, every_scene: pd.DataFrame) -> None:
    assert (every_scene["finite_strain"] == 1).all()
    assert every_scene["finite_strain_correction"].min() > paper.campaign.numerics.accuracy


def test_compression_is_that_of_the_load_alone(paper: Project, every_scene: pd.DataFrame, total: pd.DataFrame) -> None:
    rubber = paper.campaign.material
    for table in (every_scene, total):
        expected = [1.0 - pressed(rubber, pressure, "stress")[0] for pressure in table["pressure_MPa"]]
        np.testing.assert_allclose(table["nominal_compression"], expected, rtol=1e-5)
    assert 0.38 < every_scene["nominal_compression"].max() < 0.40


def test_friction_from_energy_is_that_from_contact(every_scene: pd.DataFrame) -> None:
    for route in ("friction_coefficient_dissipation", "friction_coefficient_contact"):
        np.testing.assert_allclose(every_scene[route], every_scene["friction_coefficient"], rtol=0.01)


def test_estimated_error_is_within_the_accuracy(paper: Project, every_scene: pd.DataFrame) -> None:
    relative = every_scene["friction_coefficient_error"] / every_scene["friction_coefficient"]
    assert relative.min() > 0.0
    assert relative.max() <= paper.campaign.numerics.accuracy
    assert every_scene["meshes"].between(2, 10).all()


def test_friction_is_positive_and_below_the_steepest_slope(paper: Project, scales: dict[int, pd.DataFrame]) -> None:
    for scale, table in scales.items():
        assert table["friction_coefficient"].min() > 0.0
        assert table["friction_coefficient"].max() < paper.campaign.road[scale - 1].steepest_slope


def test_contact_fraction_is_a_share(every_scene: pd.DataFrame) -> None:
    assert every_scene["contact_fraction"].min() > 0.0
    assert every_scene["contact_fraction"].max() == 1.0


@pytest.mark.parametrize("scale", SCALES)
def test_contact_grows_with_pressure_and_shrinks_with_speed(scales: dict[int, pd.DataFrame], scale: int) -> None:
    grid = scales[scale][scales[scale]["aspect"] == 0.75]
    fraction = grid.pivot(index="velocity_mm_per_s", columns="pressure_MPa", values="contact_fraction").to_numpy()
    node = (1.0 / grid["columns"]).max()
    assert np.diff(fraction, axis=1).min() >= -node
    assert np.diff(fraction, axis=0).max() <= node
    assert fraction[0, -1] > fraction[-1, 0] + 0.1


def test_contact_is_resolved_in_every_scene(paper: Project, every_scene: pd.DataFrame) -> None:
    numerics = paper.campaign.numerics
    assert every_scene["contact_nodes"].min() >= 0.9 * numerics.finite_contact_nodes
    assert every_scene["columns"].min() >= numerics.finite_columns_min
    assert every_scene["columns"].max() < numerics.columns_max


def test_contact_pressure_exceeds_the_nominal_one(every_scene: pd.DataFrame) -> None:
    ratio = every_scene["maximum_contact_pressure_MPa"] / every_scene["pressure_MPa"]
    assert ratio.min() > 1.0
    part = every_scene["contact_fraction"] < 1.0
    assert (ratio[part] > 1.0 / every_scene["contact_fraction"][part]).all()


@pytest.mark.parametrize("scale", SCALES)
def test_friction_peaks_between_the_slowest_and_the_fastest(scales: dict[int, pd.DataFrame], scale: int) -> None:
    table = scales[scale]
    line = table[(table["aspect"] == 0.75) & (table["pressure_MPa"] == 5.0)]["friction_coefficient"].to_numpy()
    peak = int(line.argmax())
    assert 0 < peak < len(line) - 1
    assert np.all(np.diff(line[: peak + 1]) > 0.0)
    assert np.all(np.diff(line[peak:]) < 0.0)
    assert line[peak] > 2.0 * max(line[0], line[-1])


def test_finer_scales_peak_no_later(scales: dict[int, pd.DataFrame]) -> None:
    peaks = []
    for table in scales.values():
        line = table[(table["aspect"] == 0.75) & (table["pressure_MPa"] == 5.0)]
        peaks.append(float(line["velocity_mm_per_s"].iloc[int(line["friction_coefficient"].to_numpy().argmax())]))
    assert peaks == sorted(peaks, reverse=True)
    assert peaks[-1] < peaks[0]


@pytest.mark.parametrize(("point", "friction"), KNOWN.items())
def test_friction_is_as_known(scales: dict[int, pd.DataFrame], point: tuple[float, ...], friction: float) -> None:
    scale, *rest = point
    rows = scales[int(scale)].set_index(["velocity_mm_per_s", "pressure_MPa", "aspect"])
    assert rows.loc[tuple(rest), "friction_coefficient"] == pytest.approx(friction, rel=1e-2)


def test_command_line_gives_the_number_of_the_table(paper: Project, scales: dict[int, pd.DataFrame]) -> None:
    command = [sys.executable, "-m", "rubfric.cli", "simulate", "--scale", "4", "--velocity", "100", "--pressure", "5"]
    done = subprocess.run(command, cwd=paper.root, env=paper.environment, capture_output=True, text=True, check=True)
    printed = re.search(r"^friction coefficient +(\S+) \+- \S+$", done.stdout, re.MULTILINE)
    rows = scales[4].set_index(["velocity_mm_per_s", "pressure_MPa", "aspect"])
    assert printed
    assert float(printed[1]) == pytest.approx(rows.loc[(100.0, 5.0, 0.75), "friction_coefficient"], rel=1e-4)
