"""Files as loggers write them give the points of the tidy one, or are refused in one sentence."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from rubfric.errors import InvalidInput
from rubfric.rig.bearing import given_drag
from rubfric.rig.record import MEASURED, ordered
from rubfric.rig.reduction import Reduced, point_table, reduce_files, reduce_record
from rubfric.rig.settings import Settings

FileWriter = Callable[..., str]
GERMAN = ("Zeit [s]", "Normalkraft [N]", "Reibkraft [N]", "Weg [mm]")


def reduced(path: str, settings: Settings) -> Reduced:
    (found,) = reduce_files([path], settings)
    return found


def numbers(found: Reduced) -> np.ndarray:
    table = point_table([found])
    return table.select_dtypes("number").to_numpy(dtype=float)


@pytest.fixture(scope="module")
def tidy(readings: np.ndarray, settings: Settings) -> np.ndarray:
    """What the readings give without a file."""
    found = numbers(reduce_record(ordered("tidy", MEASURED, readings), settings, given_drag(settings.bearing)))
    assert len(found) == 1
    return found


def same(found: Reduced, tidy: np.ndarray, tolerance: float = 1e-9) -> None:
    np.testing.assert_allclose(numbers(found), tidy, rtol=tolerance, atol=1e-9)


@pytest.mark.parametrize(
    "how",
    [
        {},
        {"separator": ";", "decimal": ",", "headings": GERMAN},
        {"separator": "\t", "decimal": ","},
        {"separator": "\t"},
        {"separator": ";"},
        {"separator": ", "},
        {"minus": "\N{MINUS SIGN}"},
        {"separator": " ", "headings": ("Time_s", "Fn_N", "Ft_N", "x_mm")},
        {"before": "Logger 3000\nDate: 2026-11-22, 13:20\n\nRate;500\n"},
        {"before": "a,b,c,d\n"},
        {"headings": ("t", "Fn", "Ft", "x"), "before": "\n", "after": "\n\n", "units": "s,N,N,mm"},
        {"encoding": "utf-8-sig"},
        {"encoding": "utf-16"},
        {"encoding": "cp1252", "before": "Prüfstand, Straße µ\n"},
        {"headings": ("Time / s", "Normal load in N", "Traction load, N".replace(",", " /"), "Position (mm)")},
        {"after": "End of measurement\n"},
    ],
    ids=lambda how: " ".join(how) or "tidy",
)
def test_writing_does_not_matter(
    how: dict[str, str], write_file: FileWriter, readings: np.ndarray, settings: Settings, tidy: np.ndarray
) -> None:
    units = how.get("units")
    given = {name: value for name, value in how.items() if name != "units"}
    path = write_file(readings, **given)
    if units:
        text = Path(path).read_text()
        Path(path).write_text(text.replace("t,Fn,Ft,x\n", f"t,Fn,Ft,x\n{units}\n"))
    same(reduced(path, settings), tidy)


CLOCKS = {
    "time": lambda s: f"{int(s // 3600) % 24:02d}:{int(s // 60) % 60:02d}:{s % 60:012.9f}",
    "time (s)": lambda s: f"{int(s // 3600) % 24}:{int(s // 60) % 60:02d}:{s % 60:012.9f}",
    "Time (hh:mm:ss)": lambda s: (
        f"{(int(s // 3600) + 11) % 12 + 1}:{int(s // 60) % 60:02d}:{s % 60:012.9f} {'AP'[int(s // 43200) % 2]}M"
    ),
    "timestamp": lambda s: f"2026-02-{28 + int(s // 86400)}T{CLOCKS['time'](s)}".replace("02-29", "03-01"),
}


@pytest.mark.parametrize("heading", CLOCKS)
@pytest.mark.parametrize("start", [100.0, 86398.0], ids=["by day", "over midnight"])
def test_clock_times_are_seconds(
    heading: str, start: float, write_file: FileWriter, readings: np.ndarray, settings: Settings, tidy: np.ndarray
) -> None:
    lines = Path(write_file(readings, (heading, "Fn (N)", "Ft (N)", "x (mm)"))).read_text().splitlines()
    for number, line in enumerate(lines[1:], 1):
        time, _, others = line.partition(",")
        lines[number] = f"{CLOCKS[heading](start + float(time))},{others}"
    path = Path(write_file(readings))
    path.write_text("\n".join(lines))
    expected = tidy.copy()
    expected[:, :2] += start
    np.testing.assert_allclose(numbers(reduced(str(path), settings)), expected, rtol=1e-5, atol=1e-6)


def test_units_that_contradict_a_clock_and_clocks_that_are_no_time_are_refused(
    write_file: FileWriter, readings: np.ndarray, settings: Settings
) -> None:
    lines = Path(write_file(readings, ("t", "Fn (N)", "Ft (N)", "x (mm)"))).read_text().splitlines()
    stamped = [
        lines[0],
        *(f"12:00:{number / 100.0:08.5f},{line.partition(',')[2]}" for number, line in enumerate(lines[1:])),
    ]
    path = Path(write_file(readings))
    path.write_text("\n".join(stamped))
    with pytest.raises(InvalidInput, match=r"^units.time is 'ms', but .* has clock times in the column 't': leave it"):
        reduced(str(path), replace(settings, units={"time": "ms"}))
    with pytest.raises(InvalidInput, match=r"has clock times in the column 't', but it is to hold displacement"):
        reduced(str(path), replace(settings, columns={"displacement": "t", "time": "x"}, units={"time": "s"}))
    path.write_text("\n".join([lines[0], *(line.replace("12:", "", 1) for line in stamped[1:])]))
    with pytest.raises(InvalidInput, match=r"column 't', holds the time '00:00.00000', which cannot be read without"):
        reduced(str(path), settings)


def test_columns_of_words_are_passed_over(
    write_file: FileWriter, readings: np.ndarray, settings: Settings, tidy: np.ndarray
) -> None:
    lines = Path(write_file(readings)).read_text().splitlines()
    path = Path(write_file(readings))
    path.write_text("\n".join([f"Date,{lines[0]},State", *(f"2026-11-22,{line},sliding" for line in lines[1:])]))
    same(reduced(str(path), settings), tidy)


@pytest.mark.parametrize(
    ("place", "heading", "per"),
    [
        (0, "time (ms)", 1e3),
        (1, "normal force (kN)", 1e-3),
        (2, "traction (mN)", 1e3),
        (3, "displacement (m)", 1e-3),
        (3, "displacement (µm)", 1e3),
        (3, "displacement [cm]", 0.1),
    ],
)
def test_units_do_not_matter(
    place: int,
    heading: str,
    per: float,
    write_file: FileWriter,
    readings: np.ndarray,
    settings: Settings,
    tidy: np.ndarray,
) -> None:
    headings = ["time (s)", "normal force (N)", "traction (N)", "displacement (mm)"]
    headings[place] = heading
    scaled = readings.copy()
    scaled[place] *= per
    same(reduced(write_file(scaled, headings), settings), tidy, 1e-6)


def test_other_columns_are_passed_over(
    write_file: FileWriter, readings: np.ndarray, settings: Settings, tidy: np.ndarray
) -> None:
    more = np.vstack((readings[3], np.full(readings.shape[1], 20.0), readings[:3], readings[2] / readings[1]))
    headings = (
        "Position (mm)",
        "Temperature (C)",
        "Time (s)",
        "Load (N)",
        "Friction force (N)",
        "Friction coefficient",
    )
    same(reduced(write_file(more, headings), settings), tidy)


def test_order_of_rows_does_not_matter(
    write_file: FileWriter, readings: np.ndarray, settings: Settings, tidy: np.ndarray, rng: np.random.Generator
) -> None:
    found = reduced(write_file(readings[:, rng.permutation(readings.shape[1])]), settings)
    same(found, tidy)
    assert "rows put in the order of time" in found.notes


def test_late_packets_are_put_in_order(
    write_file: FileWriter, readings: np.ndarray, settings: Settings, tidy: np.ndarray
) -> None:
    order = np.arange(readings.shape[1])
    order[100:120], order[120:140] = np.arange(120, 140), np.arange(100, 120)
    same(reduced(write_file(readings[:, order]), settings), tidy)


def test_rows_that_stand_twice_count_once(
    write_file: FileWriter, readings: np.ndarray, settings: Settings, tidy: np.ndarray
) -> None:
    found = reduced(write_file(np.concatenate((readings, readings[:, 500:700]), axis=1)), settings)
    same(found, tidy)
    assert any("repeated rows" in note for note in found.notes)


def test_clock_that_begins_again_is_refused(write_file: FileWriter, readings: np.ndarray, settings: Settings) -> None:
    again = readings + np.array([[0.0], [0.1], [0.2], [0.3]])
    path = write_file(np.concatenate((readings, again), axis=1))
    with pytest.raises(InvalidInput, match=r"has a clock that begins again, at 0 s after .* keep one run in a file$"):
        reduced(path, settings)


def test_equal_time_stamps_are_averaged(write_file: FileWriter, readings: np.ndarray, settings: Settings) -> None:
    coarse = readings.copy()
    coarse[0] = np.floor(coarse[0] * 100.0) / 100.0
    found = reduced(write_file(coarse), settings)
    assert any(re.match(r"\d+ rows share \d+ time stamps: means taken", note) for note in found.notes)
    assert found.points[0].speed == pytest.approx(5.0, rel=1e-3)


def test_sign_of_the_traction_does_not_matter(
    write_file: FileWriter, readings: np.ndarray, settings: Settings, tidy: np.ndarray
) -> None:
    found = reduced(write_file(readings * np.array([[1.0], [1.0], [-1.0], [1.0]])), settings)
    same(found, tidy)
    assert any("sign of the traction turned" in note for note in found.notes)


def test_sign_of_the_load_and_way_of_the_sled_do_not_matter(
    write_file: FileWriter, readings: np.ndarray, settings: Settings, tidy: np.ndarray
) -> None:
    same(reduced(write_file(readings * np.array([[1.0], [-1.0], [1.0], [-1.0]])), settings), tidy)


def test_offsets_do_not_matter(
    write_file: FileWriter, readings: np.ndarray, settings: Settings, tidy: np.ndarray
) -> None:
    found = reduced(write_file(readings + np.array([[1000.0], [7.0], [-9.0], [250.0]])), settings)
    skip = [0, 1]  # start and end of the window
    expected = tidy.copy()
    expected[:, skip] += 1000.0
    same(found, expected, 1e-7)


@pytest.mark.parametrize("word", ["", "NaN", "--", "#N/A"])
def test_missing_values_are_left_out(
    word: str, write_file: FileWriter, readings: np.ndarray, settings: Settings, tidy: np.ndarray
) -> None:
    lines = Path(write_file(readings)).read_text().splitlines()
    for line in range(400, 700, 10):
        fields = lines[line].split(",")
        lines[line] = ",".join([*fields[:2], word, fields[3]])
    path = Path(write_file(readings))
    path.write_text("\n".join(lines))
    found = reduced(str(path), settings)
    assert "30 rows that lack a value left out" in found.notes
    np.testing.assert_allclose(numbers(found)[0, 6:11:2], tidy[0, 6:11:2], rtol=2e-3)


def test_spikes_are_left_out(
    write_file: FileWriter, readings: np.ndarray, settings: Settings, tidy: np.ndarray
) -> None:
    spiky = readings.copy()
    spiky[3, 900], spiky[2, 1000], spiky[1, 1100] = 0.0, 9999.0, -32768.0
    found = reduced(write_file(spiky), settings)
    assert "3 rows with spikes left out" in found.notes
    np.testing.assert_allclose(numbers(found)[0, 6:11:2], tidy[0, 6:11:2], rtol=1e-3)


def test_no_window_spans_a_gap(write_file: FileWriter, readings: np.ndarray, settings: Settings) -> None:
    time = readings[0]
    middle = 0.5 * (time[0] + time[-1])
    kept = np.abs(time - middle) > 0.2
    found = reduced(write_file(readings[:, kept]), settings)
    assert "1 gaps in time, which no window spans" in found.notes
    windows = [*found.points, *found.rejected]
    assert len(windows) >= 2
    assert all(window.end < middle or window.start > middle for window in windows)


@pytest.mark.parametrize("known", [False, True])
def test_clipped_forces_are_rejected_with_the_reason(
    known: bool, write_file: FileWriter, readings: np.ndarray, settings: Settings
) -> None:
    clipped = readings.copy()
    limit = float(np.percentile(clipped[2], 70.0))
    clipped[2] = np.minimum(clipped[2], limit)
    found = reduced(write_file(clipped), replace(settings, range={"traction": limit}) if known else settings)
    assert not found.points
    assert any(re.match(r"a force is clipped in \d+ of \d+ samples", window.reason) for window in found.rejected)


def test_overload_marks_are_clipped_forces(write_file: FileWriter, readings: np.ndarray, settings: Settings) -> None:
    lines = Path(write_file(readings)).read_text().splitlines()
    for line in range(1300, 1400):
        fields = lines[line].split(",")
        lines[line] = ",".join([*fields[:2], "OVL", fields[3]])
    path = Path(write_file(readings))
    path.write_text("\n".join(lines))
    found = reduced(str(path), settings)
    assert not found.points
    assert "a force is clipped in 100 of" in found.rejected[0].reason


REFUSED = [
    ({"headings": ("time", "normal", "traction", "displacement")}, r"names no unit for the column 'time': write it"),
    ({"headings": ("time (s)", "normal (N)", "traction (N)", "pressure (bar)")}, "no column that looks like displ"),
    (
        {"headings": ("time (s)", "normal (N)", "vertical load (N)", "x (mm)")},
        r"has 2 columns that may be normal, and they differ: 'normal \(N\)' \(number 2\), ",
    ),
    (
        {"headings": ("time (s)", "normal (V)", "traction (N)", "x (mm)")},
        "which holds normal, is 'V', but must be one of N, kN",
    ),
    ({"separator": ",", "decimal": ","}, "has 4 headings in line 1, but 8 fields in the rows below it, .* semicolons$"),
    ({"headings": ("1", "2", "3", "4")}, "has no line of headings right above its numbers, which begin in line 1: "),
]


@pytest.mark.parametrize(("how", "says"), REFUSED)
def test_what_would_have_to_be_guessed_is_refused(
    how: dict[str, str], says: str, write_file: FileWriter, readings: np.ndarray, settings: Settings
) -> None:
    with pytest.raises(InvalidInput, match=says) as caught:
        reduced(write_file(readings, **how), settings)
    assert "\n" not in str(caught.value)


def test_commas_that_may_part_thousands_are_refused(tmp_path: Path, settings: Settings) -> None:
    path = tmp_path / "run.csv"
    rows = "\n".join(f"{place};1,234;2,345;3,456" for place in range(100))
    path.write_text(f"t (s);Fn (N);Ft (N);x (mm)\n{rows}\n")
    with pytest.raises(InvalidInput, match="numbers such as '1,234', whose comma may separate decimals or thousands"):
        reduced(str(path), settings)


def test_binary_files_folders_and_short_files_are_refused(
    tmp_path: Path, write_file: FileWriter, readings: np.ndarray, settings: Settings
) -> None:
    (tmp_path / "run.tdms").write_bytes(b"TDSm\0\0\1\2")
    with pytest.raises(InvalidInput, match="is no text file: export the table as text"):
        reduced(str(tmp_path / "run.tdms"), settings)
    with pytest.raises(InvalidInput, match="is a folder, but must be a file"):
        reduced(str(tmp_path), settings)
    with pytest.raises(InvalidInput, match="has 20 usable rows, but must have at least 50"):
        reduced(write_file(readings[:, :20]), settings)
    with pytest.raises(FileNotFoundError):
        reduced(str(tmp_path / "absent.csv"), settings)


def test_half_of_the_rows_unreadable_is_refused(
    write_file: FileWriter, readings: np.ndarray, settings: Settings
) -> None:
    path = Path(write_file(readings))
    lines = path.read_text().splitlines()
    path.write_text("\n".join(line if place % 2 else f"{line} oops" for place, line in enumerate(lines, 1)))
    with pytest.raises(InvalidInput, match=r"has \d+ unreadable rows of \d+, the first of them line 2"):
        reduced(str(path), settings)


def test_record_that_begins_under_load_is_refused(
    write_file: FileWriter, readings: np.ndarray, settings: Settings
) -> None:
    loaded = readings[:, (readings[0] > 1.9) & (readings[0] < 3.5)]
    with pytest.raises(InvalidInput, match=r"the normal force never rises; say under tare in the YAML file"):
        reduced(write_file(loaded), settings)
    half = readings.copy()
    half[1] += 60.0
    with pytest.raises(InvalidInput, match=r"begins with a normal force of 61\.\d+ N, too much beside the 1\d\d"):
        reduced(write_file(half), settings)
