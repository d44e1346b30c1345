"""Files of moduli as laboratories write them, and those that would have to be guessed at."""

from __future__ import annotations

import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from synthetic_dma import measured, table_1

from rubfric.dma.measurements import Measurements, ordered, read
from rubfric.errors import InvalidInput

TEMPERATURES, HERTZ = np.array([-20.0, 0.0, 20.0]), np.array([0.1, 1.0, 10.0])
POINTS = measured(table_1(), TEMPERATURES, HERTZ, 0.0, np.random.default_rng(0))


def written(path: Path, headings: str, order: str, separator: str = ",", comma: bool = False, **factors: float) -> str:
    """Write the points in columns of T, f (rad/s), s, l, c (complex), t (tan delta), p (phase, deg)."""
    temperature, frequency, storage, loss = POINTS
    columns = {"T": temperature, "f": frequency, "s": storage, "l": loss, "c": np.hypot(storage, loss)}
    columns |= {"t": loss / storage, "p": np.degrees(np.arctan2(loss, storage)), "x": np.arange(9.0)}
    offset = factors.pop("offset", 0.0)
    columns["T"] = columns["T"] * factors.get("T", 1.0) + offset
    rows = zip(*(columns[name] * (factors.get(name, 1.0) if name != "T" else 1.0) for name in order), strict=True)
    text = "\n".join(separator.join(f"{value:.9g}" for value in row) for row in rows)
    path.write_bytes((headings + "\n" + (text.replace(".", ",") if comma else text) + "\n").encode("utf-8"))
    return str(path)


def same(found: Measurements, kind: str = "E") -> None:
    assert found.kind == kind
    assert found.temperatures == pytest.approx(TEMPERATURES, abs=1e-6)
    assert found.frequency == pytest.approx(POINTS[1], rel=1e-6)
    assert found.storage == pytest.approx(POINTS[2], rel=1e-6)
    assert found.loss == pytest.approx(POINTS[3], rel=1e-6)


HZ = {"f": 0.5 / np.pi}


@pytest.mark.parametrize(
    ("headings", "order", "how"),
    [
        ("f,E_stor,E_loss,T,Set\nHz, MPa, MPa, C, -", "fslTx", HZ),
        ("\ufefff (Hz);E' (Pa);E'' (Pa);T (°C)", "fslT", HZ | {"separator": ";", "comma": True, "s": 1e6, "l": 1e6}),
        ("Some laboratory\nSample 7\n\nTemp. [K]\tAngular frequency [rad/s]\tE* [GPa]\ttan delta", "Tfct", {}),
        ("Temperature (degF),Freq. / Hz,Young's storage modulus (MPa),Tan(delta)", "Tfst", HZ),
        ('T [°C],Frequency [Hz],E" [MPa],tanδ [-]', "Tflt", HZ),
        ("T_C f_Hz |E*|_psi phase_deg", "Tfcp", HZ | {"separator": " ", "c": 1.0 / 6.894757293168e-3}),
        ("Temperature,Frequency,E′,E″,tan d\n°C,Hz,dyn/cm²,dyn/cm²,", "Tfslt", HZ | {"s": 1e7, "l": 1e7}),
    ],
)
def test_files_of_laboratories(headings: str, order: str, how: dict[str, Any], tmp_path: Path) -> None:
    how = dict(how)
    if "[K]" in headings:
        how |= {"separator": "\t", "offset": 273.15, "c": 1e-3}
    if "degF" in headings:
        how |= {"T": 1.8, "offset": 32.0}
    same(read(written(tmp_path / "dma.csv", headings, order, **how)))


def test_a_file_that_says_little(tmp_path: Path) -> None:
    path = written(tmp_path / "dma.csv", "A,B,Storage Modulus,Loss Modulus", "Tfsl")
    columns, units = {"temperature": "A", "frequency": "B"}, {"temperature": "degC", "frequency": "rad/s"}
    moduli = {"storage": "MPa", "loss": "MPa"}
    for given, words in (
        ({}, "no column that may be frequency"),
        ({"columns": columns}, "do not say whether they are Young's moduli or shear moduli: say --modulus E or"),
        ({"columns": columns, "modulus": "G"}, "no unit for the column 'B'"),
        ({"columns": columns, "modulus": "G", "units": units | moduli | {"frequency": "1/s"}}, "which may be either"),
        ({"columns": columns | {"loss": "C"}, "modulus": "G"}, "no column named 'C' for loss"),
        ({"columns": columns | {"loss": "A"}, "modulus": "G"}, "one column, 'A', for temperature and another"),
    ):
        with pytest.raises(InvalidInput, match=words):
            read(path, **given)
    same(read(path, columns=columns, units=units | moduli, modulus="G"), "G")


@pytest.mark.parametrize(
    ("headings", "order", "how", "words"),
    [
        ("f (Hz),E' (MPa),E'' (MPa),T", "fslT", {}, "no unit for the column 'T'"),
        ("f (Hz),E' (MPa),G'' (MPa),T (C)", "fslT", {}, "which say both"),
        ("f (Hz),E' (MPa),E'' (MPa),G' (MPa),T (C)", "fslsT", {}, "2 columns that may be storage"),
        ("f (Hz),E' (MPa),x,T (C)", "fslT", {}, "no two columns that look like storage and loss"),
        ("f (Hz),E' (MPa),E'' (MPa),x", "fslx", {}, "say --master if it is a master curve"),
        ("f (Hz),E' (MPa),E'' (MPa),T (C)", "fslT", {"s": 1e6, "l": 1e6}, "unit is likely to be Pa"),
        ("f (Hz),E' (MPa),E'' (MPa),T (C)", "fslT", {"l": -1.0}, "9 of 9 rows with a modulus or frequency of 0 or"),
        ("1,2,3,4", "fslT", {}, "no line of headings"),
    ],
)
def test_what_would_be_guessed_is_asked_for(
    headings: str, order: str, how: dict[str, Any], words: str, tmp_path: Path
) -> None:
    with pytest.raises(InvalidInput, match=words):
        read(written(tmp_path / "dma.csv", headings, order, **how))


def test_commas_spreadsheets_and_broken_rows(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "dma.csv"
    rows = "f (Hz);E' (MPa);E'' (MPa);T (C)\n1;1,234;1,200;20\n2;1,300;1,100;20\n3;1,400;1,000;20\n"
    path.write_text(rows, encoding="utf-8")
    with pytest.raises(InvalidInput, match="whose comma may separate decimals or thousands"):
        read(str(path))
    assert read(str(path), decimal="comma").storage == pytest.approx([1.234, 1.3, 1.4])
    assert read(str(path), decimal="point").storage == pytest.approx([1234.0, 1300.0, 1400.0])
    path.write_bytes(b"\xd0\xcf\x11\xe0 and so on")
    monkeypatch.setitem(sys.modules, "xlrd", None)
    with pytest.raises(InvalidInput, match=r"an Excel file \(.xls\): install rubfric\[xls\]"):
        read(str(path))
    # Blocks with headings of their own, double and unsorted points, one row without a value and one broken.
    good = "\n".join(f"{f};{100 + f};{10 + f};20.{f % 3}" for f in range(1, 40))
    text = f"f (Hz);E' (MPa);E'' (MPa);T (C)\n{good}\n\n[step]\nf;E';E'';T\nHz;MPa;MPa;C\n"
    path.write_text(f"{text}7;105;15;40\n2;104;14;40\n2;106;16;40\n3;;10;40\n4;x;10;40;9;9\n", encoding="utf-8")
    found = read(str(path))
    assert len(found.temperatures) == 2
    assert found.frequency[-2:] == pytest.approx(2.0 * np.pi * np.array([2.0, 7.0]))
    assert found.storage[-2:] == pytest.approx([105.0, 105.0])
    said = " ".join(found.notes)
    for words in ("1 unreadable rows left out", "1 rows without a value left out", "measured before, averaged"):
        assert words in said


def test_a_ramp_is_no_isotherm() -> None:
    temperature = np.linspace(-40.0, 40.0, 200)
    one = np.ones(200)
    with pytest.raises(InvalidInput, match="run on from -40 to 40 degC without steps"):
        ordered("ramp.csv", "E", one, temperature, one, one)


def test_workbook_is_read_by_its_longest_sheet(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    rows: list[list[object]] = [
        ["Nr", "f", "T", "E'", "E''", "tan delta", "D'"],
        ["", "Hz", "°C", "MPa", "MPa", "", "1/MPa"],
    ]
    rows += [[float(n), 10.0**n, -49.9 + 0.1 * n, 100.0 + n, 1e-5 + n, 0.01, 0.1] for n in range(5)]
    sheets = [
        SimpleNamespace(nrows=len(of), row_values=of.__getitem__) for of in ([["Operator", "x"], ["Width:", 3.1]], rows)
    ]
    book = SimpleNamespace(open_workbook=lambda file_contents: SimpleNamespace(sheets=lambda: sheets))
    monkeypatch.setitem(sys.modules, "xlrd", book)
    path = tmp_path / "dma.xls"
    path.write_bytes(b"\xd0\xcf\x11\xe0 and so on")
    found = read(str(path))
    assert found.kind == "E"
    assert found.storage == pytest.approx([100.0, 101.0, 102.0, 103.0, 104.0])
    assert found.loss == pytest.approx([1e-5, 1.00001, 2.00001, 3.00001, 4.00001])
    assert found.temperatures == pytest.approx([-49.7])

    def damaged(file_contents: bytes) -> None:
        raise KeyError("Workbook")

    book.open_workbook = damaged
    with pytest.raises(InvalidInput, match="no Excel file that xlrd can read"):
        read(str(path))
