"""Profiles from files: text as people write it, ISO 25178-71, and what is refused in a sentence."""

from __future__ import annotations

import struct
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rubfric.columns.format import Format
from rubfric.errors import InvalidInput
from rubfric.profile.reading import Options, read
from rubfric.profile.sdf import read_sdf

# Real files, which may lie beside the project.
SHARED = Path(__file__).resolve().parents[4] / "shared/data"
POINTS, SPACING = 200, 0.0375
DISTANCES = SPACING * np.arange(POINTS)
HEIGHTS = np.round(0.3 * np.sin(DISTANCES) + 0.05 * np.cos(7.0 * DISTANCES), 6)
GAPS = (5, 6, 7, 120)


def rows(separator: str = ",", comma: bool = False, distance: float = 1.0, height: float = 1.0, digits: int = 6) -> str:
    """Return rows of distance and height, in other units too; gaps are empty."""
    lines = []
    for at, (x, z) in enumerate(zip(DISTANCES * distance, HEIGHTS * height, strict=True)):
        word = "" if at in GAPS else f"{z:.9g}"
        line = f"{x:.{digits}f}{separator}{word}"
        lines.append(line.replace(".", ",") if comma else line)
    return "\n".join(lines) + "\n"


def alone(heights: np.ndarray = HEIGHTS, gap: str = "") -> str:
    return "\n".join(gap if at in GAPS else f"{z:.9g}" for at, z in enumerate(heights)) + "\n"


def written(path: Path, text: str) -> str:
    path.write_text(text, encoding="utf-8")
    return str(path)


@pytest.mark.parametrize(
    ("text", "options"),
    [
        ("distance_mm,height_mm\n" + rows(digits=3), Options()),
        ("Weg;Höhe\nmm;µm\n" + rows(";", True, height=1e3), Options()),
        ("Laser 3\nroad 7\n\nx [m]\tz [um]\n" + rows("\t", distance=1e-3, height=1e3, digits=8), Options()),
        ("Lateral um,Raw Micrometer,\n" + rows(distance=1e3, height=1e3), Options()),
        ("station,elevation\n" + rows(distance=1.0 / 25.4, height=1.0 / 25.4, digits=9), Options(("in",))),
        (rows(), Options(("mm",))),
        ("t,a,b\n" + "\n".join(f"1,{line}" for line in rows().splitlines()), Options(("mm",), columns=("a", "3"))),
        ("height (um)\n" + alone(1e3 * HEIGHTS), Options(spacing=SPACING)),
        (alone(gap="NaN"), Options(("mm",), SPACING)),
        ("height (mm)\n" + alone().replace(".", ","), Options((), SPACING, form=Format(decimal="comma"))),
        # The instrument left the rows of gaps out.
        ("x (mm),z (mm)\n" + "".join(f"{one}\n" for one in rows().splitlines() if one[-1] != ","), Options()),
        # It measured from the far end.
        ("x (mm),z (mm)\n" + "\n".join(reversed(rows().splitlines())), Options()),
    ],
)
def test_files_as_people_write_them(text: str, options: Options, tmp_path: Path) -> None:
    found = read(written(tmp_path / "road.csv", text), options)
    assert found.spacing == pytest.approx(SPACING, rel=1e-4)
    assert np.flatnonzero(np.isnan(found.heights)).tolist() == list(GAPS)
    assert np.nanmax(np.abs(found.heights - HEIGHTS)) < 1e-6


def test_mostly_gaps_and_distances_that_are_uneven(tmp_path: Path) -> None:
    lines = rows().splitlines()
    few = [line if at % 7 < 3 else f"{line.split(',')[0]}," for at, line in enumerate(lines)]
    found = read(written(tmp_path / "road.csv", "distance_mm,height_mm\n" + "\n".join(few)))
    assert np.isfinite(found.heights).sum() == sum(at % 7 < 3 and at not in GAPS for at in range(POINTS))
    x = DISTANCES + 0.012 * np.sin(np.arange(POINTS)) ** 2 + 2e-4 * np.arange(POINTS) ** 1.5
    text = "\n".join(f"{a:.6f},{0.3 * a:.6f}" for a in x)
    found = read(written(tmp_path / "road.csv", f"distance_mm,height_mm\n{text}\n"))
    assert found.heights == pytest.approx(0.3 * found.distances, abs=1e-5)
    assert "distances are uneven" in found.notes[0]


HEADED = "distance_mm,height_mm\n"
LINES = rows().splitlines()


@pytest.mark.parametrize(
    ("text", "options", "words"),
    [
        ("height_mm\n" + alone(), {}, "heights alone, but not how far apart they are: say it with --spacing"),
        (HEADED + "\n".join(LINES[:50] + LINES[20:]), {}, "go back, from 1.8375 to 0.75 mm in line 52"),
        (HEADED + "\n".join(LINES[:50] + LINES[49:]), {}, "the distance 1.8375 mm twice, again in line 52"),
        (HEADED + "\n".join(f"{x}," for x in DISTANCES), {}, "no height: all of its 200 points are gaps"),
        (HEADED + "\n".join(f"{x},NaN" for x in DISTANCES), {}, "no height: all of its 200 points are gaps"),
        (
            "distance_km,height_mm\n" + rows(),
            {},
            r"a road of 7.5 km .* unit of its distances is probably a smaller one",
        ),
        ("distance_m,height_m\n" + rows(), {}, "points 37.5 mm apart"),
        ("distance_mm,height_m\n" + rows(), {}, "the unit of its heights is probably a smaller one"),
        (
            HEADED + rows().replace(",\n", ",-9999\n"),
            {},
            "has the height -9999 mm at 4 points, far from all others: if it marks heights that are missing",
        ),
        ("distance,height\n" + rows(), {}, "names no unit for the column 'height' of heights: write it in the heading"),
        ("distance (kg),height (mm)\n" + rows(), {}, "is 'kg', but must be one of mm, m,"),
        (HEADED + rows(), {"unit": ("furlong",)}, "--unit is 'furlong', but must be one of mm, m,"),
        (HEADED + "\n".join(LINES[:20]), {}, "has 17 heights along the line, but a spectrum needs at least 64"),
        (
            "d_mm,h_mm,k_mm\n" + "\n".join(f"{one}1,1" for one in LINES),
            {},
            "no column that looks like distance; its columns",
        ),
        ("x_mm,z_mm,h_mm\n" + "\n".join(f"{one}1,1" for one in LINES), {}, "2 columns that may be height, 'z_mm', 'h_"),
        (HEADED + rows(), {"columns": ("way", None)}, "--distance is 'way', but .* has no such columns"),
        ("nothing\nat all\n", {}, "has no rows of numbers"),
    ],
)
def test_what_is_refused(text: str, options: dict[str, Any], words: str, tmp_path: Path) -> None:
    with pytest.raises(InvalidInput, match=words):
        read(written(tmp_path / "road.csv", text), Options(**options))


GRID = np.round(1e3 * np.outer(1.0 + 0.1 * np.arange(70), np.sin(0.2 * np.arange(90))))


def binary(kind: int, code: str, missing: float) -> bytes:
    grid = GRID.copy()
    grid[3, 4] = missing
    head = struct.pack("<8s10s12s12sHHddddBBB", b"bISO-1.0", b"x", b"", b"", 90, 70, 2e-5, 3e-5, 1e-9, 1e-9, 0, kind, 0)
    return head + grid.astype(code).tobytes() + b"trailer"


@pytest.mark.parametrize(
    "content",
    [
        binary(5, "<i2", -32768),
        binary(6, "<i4", -(2**31)),
        binary(3, "<f4", np.nan),
        binary(7, "<f8", 1.7e308),
        (
            b"aISO-1.0\r\nNumPoints = 90\r\nNumProfiles = 70\r\nXscale = 2.0E-5\r\nYscale=3.0e-5\r\nZscale = 1.0E-9\r\n"
            b"Compression = 0\r\nDataType = 5\r\n*\r\n"
            + "\n".join(
                " ".join("BAD" if (i, j) == (3, 4) else str(int(GRID[i, j])) for j in range(90)) for i in range(70)
            ).encode()
            + b"\r\n*\r\n"
        ),
    ],
)
def test_areal_scans_of_iso_25178(content: bytes, tmp_path: Path) -> None:
    path = tmp_path / "scan.sdf"
    path.write_bytes(content)
    scan = read_sdf(str(path))
    assert scan.spacing == pytest.approx((0.02, 0.03))
    expected = 1e-6 * GRID
    expected[3, 4] = np.nan
    assert scan.heights == pytest.approx(expected, nan_ok=True)
    across = read(str(path), Options(line=5, direction="y"))
    assert across.heights == pytest.approx(expected[:, 4], nan_ok=True)
    assert across.spacing == pytest.approx(0.03)
    assert read(str(path)).notes == ("line 35 of 70 along x, of 90 points",)
    with pytest.raises(InvalidInput, match=r"--line is 71, but .* has 70 lines along x"):
        read(str(path), Options(line=71))
    path.write_bytes(content[:3000])
    with pytest.raises(InvalidInput, match="cut short"):
        read(str(path))


def test_a_guessed_encoding_is_said_without_what_other_commands_have(tmp_path: Path) -> None:
    path = tmp_path / "road.csv"
    path.write_bytes(("Distanz (mm);Höhe (mm)\n" + rows(";")).encode("cp1252"))
    assert read(str(path)).notes == ("read in the encoding cp1252 (Western European), which was guessed",)


def test_an_instruments_format_needs_the_extra(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "scan.al3d"
    path.write_bytes(b"\1\2\0\0" * 50)
    monkeypatch.setitem(sys.modules, "SurfaceTopography", None)
    with pytest.raises(InvalidInput, match=r"pip install 'rubfric\[topography\]'"):
        read(str(path))


@pytest.mark.skipif(not SHARED.exists(), reason="real files are not part of the project")
def test_real_files_are_read_as_they_are() -> None:
    for station, gaps in ((0, 248), (1, 274), (10, 252)):
        found = read(str(SHARED / f"roads/captif_aylesbury_station{station}_500-700mm.csv"))
        assert found.spacing == pytest.approx(0.0375, rel=1e-3)
        assert (len(found.heights), np.isnan(found.heights).sum()) == (5335, gaps)
    stylus = read(str(SHARED / "formats/dektak-1.csv"))
    assert stylus.spacing == pytest.approx(0.156e-3, rel=2e-3)
    assert stylus.heights[:2] == pytest.approx([-0.00933e-3, -0.0076e-3])
    scan = read_sdf(str(SHARED / "formats/sdf-1.sdf"))
    assert scan.heights.shape == (4, 7)
    assert scan.heights[0, 1] == pytest.approx(0.99874e-3)
