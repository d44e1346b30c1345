"""Tables of a campaign: one row per scene, in order, units in the headings."""

from __future__ import annotations

import subprocess
from itertools import product
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import xarray as xr

from rubfric.checksums import remove_signature
from rubfric.errors import BrokenResult
from rubfric.results.scalars import SCALARS
from rubfric.results.tables import read_table, scale_table, write_table

SCALES, VELOCITIES, PRESSURES, ASPECTS = (1, 2), (0.1, 100.0, 10000.0), (0.5, 5.0), (0.5, 0.75)


def mu(scale: int, velocity: float, pressure: float, aspect: float) -> float:
    """Return a friction coefficient that tells its scene."""
    return 0.1 * scale + 1e-5 * velocity + 0.01 * pressure + aspect


@pytest.fixture
def campaign() -> xr.Dataset:
    """Return every scene at aspect 0.75, and at aspect 0.5 scale 1 at 5 MPa only."""
    axes = {"scale": SCALES, "velocity": VELOCITIES, "pressure": PRESSURES, "aspect": ASPECTS}
    shape = tuple(len(axis) for axis in axes.values())
    friction = np.array([mu(*point) for point in product(*axes.values())]).reshape(shape)
    friction[:, :, 0, 0] = np.nan
    friction[1, :, :, 0] = np.nan
    scalars = {name: (tuple(axes), np.where(np.isnan(friction), np.nan, 3.0)) for name in (*SCALARS, "warnings")}
    scalars["friction_coefficient"] = (tuple(axes), friction)
    scalars["friction_coefficient_error"] = (tuple(axes), 0.01 * friction)
    return xr.Dataset(scalars, coords={name: list(axis) for name, axis in axes.items()})


def test_headings_name_units_where_there_are_any(campaign: xr.Dataset) -> None:
    assert list(scale_table(campaign, 1).columns) == [
        "velocity_mm_per_s",
        "pressure_MPa",
        "aspect",
        "friction_coefficient",
        "friction_coefficient_error",
        "friction_coefficient_dissipation",
        "friction_coefficient_contact",
        "energy_closure",
        "contact_fraction",
        "maximum_contact_pressure_MPa",
        "maximum_local_contact_pressure_MPa",
        "nominal_compression",
        "finite_strain",
        "finite_strain_correction",
        "effective_poissons_ratio",
        "shear_wave_speed_ratio",
        "meshes",
        "columns",
        "rows",
        "contact_nodes",
        "warnings",
    ]


def test_scale_table_holds_every_scene_that_was_run(campaign: xr.Dataset) -> None:
    table = scale_table(campaign, 1)
    points = [(v, 5.0, 0.5) for v in VELOCITIES] + [(v, p, 0.75) for p in PRESSURES for v in VELOCITIES]
    assert list(table[["velocity_mm_per_s", "pressure_MPa", "aspect"]].itertuples(index=False, name=None)) == points
    assert table["friction_coefficient"].tolist() == [mu(1, *point) for point in points]
    assert len(scale_table(campaign, 2)) == 6


def test_counts_are_whole_numbers(campaign: xr.Dataset) -> None:
    table = scale_table(campaign, 1)
    for name in ("meshes", "columns", "rows", "contact_nodes", "warnings"):
        assert table[name].tolist() == [3] * 9
        assert table[name].dtype.kind == "i"


def test_tables_carry_the_errors(campaign: xr.Dataset) -> None:
    for scale in SCALES:
        table = scale_table(campaign, scale)
        np.testing.assert_allclose(table["friction_coefficient_error"], 0.01 * table["friction_coefficient"])


def test_campaign_of_an_earlier_version_is_refused(campaign: xr.Dataset) -> None:
    older = campaign.drop_vars("friction_coefficient_error")
    complaint = r"^the campaign lacks friction_coefficient_error: gather the results of its scenes again$"
    with pytest.raises(BrokenResult, match=complaint):
        scale_table(older, 1)


def test_table_reads_back_with_six_digits(campaign: xr.Dataset, tmp_path: Path) -> None:
    table = scale_table(campaign, 1)
    target = tmp_path / "tables" / "one.csv"
    write_table(table, target)
    pd.testing.assert_frame_equal(pd.read_csv(target), table, rtol=1e-5, check_dtype=False)
    assert target.read_text().splitlines()[1].startswith("0.1,5,0.5,0.650001,0.00650001,3,")
    assert sorted(path.name for path in target.parent.iterdir()) == [".one.csv.sha256", "one.csv"]
    assert subprocess.run(["sha256sum", "-c", ".one.csv.sha256"], cwd=target.parent, check=False).returncode == 0


def test_table_that_was_changed_is_refused(campaign: xr.Dataset, tmp_path: Path) -> None:
    one, other = tmp_path / "one.csv", tmp_path / "other.csv"
    for scale, path in ((1, one), (2, other)):
        write_table(scale_table(campaign, scale), path)
        read_table(path, [])
    other.replace(one)
    with pytest.raises(BrokenResult, match=r"one\.csv cannot be read: its content does not match its checksum: "):
        read_table(one, [], signed=False)
    remove_signature(one)
    remove_signature(one)
    assert len(read_table(one, [], signed=False)) > 1
    with pytest.raises(BrokenResult, match=r"one\.csv cannot be read: it has no checksum, .*; delete"):
        read_table(one, [])


def test_interrupted_write_keeps_the_older_table(
    campaign: xr.Dataset, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def stop(_: pd.DataFrame, path: Path, **__: object) -> None:
        path.write_text("velocity_mm_per_s,pre")
        raise OSError("no space left on device")

    target = tmp_path / "one.csv"
    target.write_text("older")
    monkeypatch.setattr(pd.DataFrame, "to_csv", stop)
    with pytest.raises(OSError, match="no space left"):
        write_table(scale_table(campaign, 1), target)
    assert [path.name for path in tmp_path.iterdir()] == ["one.csv"]
    assert target.read_text() == "older"


def test_words_and_gaps_of_a_table_are_read_as_they_are_written(tmp_path: Path) -> None:
    source = tmp_path / "ladder.csv"
    source.write_text('rung,error,covered,note\n0.10,0.5,True,\nnone,nan,False,"slow, but right"\n')
    table = read_table(source, ["rung", "note", "absent"], signed=False)
    assert table["rung"].tolist() == ["0.10", "none"]
    assert table["error"].tolist()[0] == 0.5
    assert np.isnan(table["error"].tolist()[1])
    assert table["covered"].dtype == bool
    assert table["note"].tolist()[1] == "slow, but right"


@pytest.mark.parametrize("content", [None, b"", b"a,b\n1,2,3\n4\n5,6,7,8\n", b"\xff\xfe\x00"])
def test_unreadable_table_is_named(tmp_path: Path, content: bytes | None) -> None:
    source = tmp_path / "broken.csv"
    if content is not None:
        source.write_bytes(content)
    says = (
        r"broken\.csv is missing: run again"
        if content is None
        else r"is no readable table: (?!.*delete it)"  # it may be the user's only copy
    )
    with pytest.raises(BrokenResult, match=says):
        read_table(source, [], signed=False)


def test_text_is_no_formula(tmp_path: Path) -> None:
    texts = ["=1+2;x.csv", "+a", "-b", "@c", "＝1", "-1.5", "+2e-3", "run", "'quoted", "1=2", ""]
    table = pd.DataFrame({"run": texts, "number": -1.0, "mixed": [*texts[:-1], -3.5]})
    write_table(table, tmp_path / "points.csv")
    lines = (tmp_path / "points.csv").read_text().splitlines()[1:]
    assert not [cell for line in lines for cell in line.split(",") if cell[:1] in set("=+-@") and not is_number(cell)]
    assert lines[0] == "'=1+2;x.csv,-1,'=1+2;x.csv"
    read = read_table(tmp_path / "points.csv", ["run"])
    assert read["run"].fillna("").tolist() == texts
    assert read["number"].tolist() == [-1.0] * len(texts)


def is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return True
