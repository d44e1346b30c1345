"""Kinds of files that loggers write: each gives the point of the tidy record, or says what to do, which then helps."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
import pytest

from rubfric.errors import InvalidInput
from rubfric.results.tables import read_table, write_table
from rubfric.rig.reduction import Reduced, point_table, reduce_files
from rubfric.rig.settings import read_settings

TIDY = "time (s),normal force (N),traction (N),displacement (mm)"
JAPANESE, KOREAN = "時間(s),荷重(N),摩擦力(N),変位(mm)", "시간(s),하중(N),마찰력(N),변위(mm)"
GERMAN, RUSSIAN = (
    "Zeit (s),Normalkraft (N),Reibkraft (N),Größe (mm)",
    "Время (с),Нагрузка (Н),Сила трения (Н),Путь (мм)",
)
UNITS = "units: {time: s, normal: N, traction: N, displacement: mm}"
NUMBERED = f"columns: {{time: 1, normal: 2, traction: 3, displacement: 4}}\n{UNITS}"
LVM = (
    "LabVIEW Measurement\t\nSeparator\tTab\nDecimal_Separator\t,\nX_Columns\t{kind}\nTime\t10:37:46,5\n"
    "***End_of_Header***\t\n\t\nChannels\t3\nSamples\t{count}\nDate\t{date}\nY_Unit_Label\t{units}\nX_Dimension\t{x}\n"
    "X0\t{start}\nDelta_X\t{step}\n***End_of_Header***\nX_Value\t{names}\tComment\n"
)


def record() -> np.ndarray:
    """Rest, a load of 50 N, 20 mm/s for 1.9 s against 25 N, rest; with offsets and noise; shape (rows, 4)."""
    rng = np.random.default_rng(7)
    time = np.arange(600) / 150.0
    load = 50.0 * np.interp(time, [0.8, 1.1, 3.4, 3.6], [0.0, 1.0, 1.0, 0.0]) + 1.0
    pull = np.where((time > 1.3) & (time < 3.2), 25.0, 0.0) - 0.4
    place = 20.0 * np.clip(time - 1.3, 0.0, 1.9)
    noise = rng.standard_normal((3, time.size)) * np.array([[0.05], [0.05], [0.002]])
    return np.round(np.column_stack([time, *(np.stack([load, pull, place]) + noise)]), 6)


RUN = record()
PULL = RUN[:, [0, 2, 3]]


def rows(values: np.ndarray = RUN, separator: str = ",", end: str = "", form: str = "%.6f") -> str:
    return "\n".join(separator.join(form % value for value in row) + end for row in values) + "\n"


def grouped(mark: str, decimal: str = ".") -> str:
    """Return a table in µm and ms whose thousands are parted."""
    lines = (";".join(f"{value:_.3f}" for value in row) for row in RUN * [1e3, 1.0, 1.0, 1e3])
    table = "\n".join(lines).replace(".", decimal).replace("_", mark)
    return f"time (ms);normal force (N);traction (N);displacement (µm)\n{table}"


def lvm(kind: str, ones: Sequence[str], values: np.ndarray) -> str:
    """Return a LabVIEW file; ``ones`` holds what stands for each channel but for the numbers."""
    fields = {"count": "600", "date": "2016/08/23", "x": "Time", "start": "0,0", "step": f"{1 / 150:.9f}"}
    gap = "\t\t" if kind == "Multi" else "\t"
    said = {name: gap.join([word.replace(".", ",")] * 3) for name, word in fields.items()}
    names = "\tX_Value\t".join(ones) if kind == "Multi" else "\t".join(ones)
    head = LVM.format(kind=kind, units=gap.join(["Newtons", "N", "mm"]), names=names, **said)
    return head + rows(values, "\t").replace(".", ",")


# kind of file: text or bytes, and what the YAML file says beside the area
READ: dict[str, tuple[str | bytes, str]] = {
    "settings above headings": (
        f'"Range","5k","2k","5V"\n"Calibration",2.71,0.2983,1.0\n"Offset",0,0,0\n"Unit","N","N","mm"\n'
        f'"Time(sec)","CH1","CH2","CH3"\n{rows()}',
        "columns: {normal: CH1, traction: CH2, displacement: CH3}",
    ),
    "settings as numbers": (f"Gain,1,2,3\nLimit,10,20,30\nRate,5,5,5\nFilter,1,1,1\n{TIDY}\n{rows()}", ""),
    "title of as many words": (
        f"Rubber,Road,Rig,Name\nA (s),B (N),C (N),D (mm)\n{rows()}",
        f"{NUMBERED.splitlines()[0]}",
    ),
    "line of the headings": (f"p,q,r,s\nA,B,C,D\nu,v,w,z\n{rows()}", f"headings: 2\n{NUMBERED}"),
    "headings of numbers": (f"1,2,3,4\n{rows()}", f"headings: 1\n{NUMBERED}"),
    "no headings": (rows(), NUMBERED),
    "units below": (f"t,Fn,Ft,x\ns,N,N,mm\n{rows()}", ""),
    "short names": (f"t,n,ft,x\ns,N,N,mm\n{rows()}", ""),
    "units, then types": (f"Time,Fn,Ft,Pos\n[s],[N],[N],[mm]\nREAL,REAL,REAL,REAL\n{rows()}", ""),
    "types, then units": (f"T,Fn,Ft,Pos,RN\n,Avg,Avg,Smp,\nsec,N,N,mm,-\n{rows(end=',5')}", ""),
    "data logger": (f'"TOA5","rig","CR1","12"\n{TIDY}\n"TS","N","N","mm"\n"","Avg","Avg","Smp"\n{rows()}', UNITS),
    "lvm, one X": (lvm("One", ("Fn", "Ft", "Position"), RUN), ""),
    "lvm, an X each": (lvm("Multi", ("Fn", "Ft", "Position"), RUN[:, [0, 1, 0, 2, 0, 3]]), ""),
    "lvm, no X": (re.sub(r"\n(?=-?\d)", "\n\t", lvm("No", ("Fn", "Ft", "Position"), RUN[:, 1:])), ""),
    "separator after rows": (f"{TIDY}\n{rows(end=',')}", ""),
    "separator after headings": (f"{TIDY},,\n{rows()}", ""),
    "unfilled heading": (f"{TIDY},remark\n{rows()}", ""),
    "tab after rows": (f"{TIDY}\n{rows(end=',')}".replace(",", "\t"), ""),
    "time per channel": (f"Time (s),Fn (N),Time (s),Ft (N),x (mm)\n{rows(RUN[:, [0, 1, 0, 2, 3]])}", ""),
    "time of one channel": (
        f"Time (s),Fn (N),Time (s),Ft (N),x (mm)\n{rows(RUN[:, [0, 1, 0, 2, 3]] + [0, 0, 0.1, 0, 0])}",
        "columns: {time: 1}",
    ),
    "time in two units": (
        f"Time (s),Time (min),Fn (N),Ft (N),x (mm)\n{rows(RUN[:, [0, 0, 1, 2, 3]] / [1, 60, 1, 1, 1], form='%.9f')}",
        "",
    ),
    "blank before quote": (f"{TIDY}\n" + re.sub(r"(\S+?)(,|\n)", r'"\1"\2 ', rows()), ""),
    "decimal comma in quotes": (
        f"{TIDY}\n" + "\n".join(", ".join(f'"{v:.6f}"'.replace(".", ",") for v in row) for row in RUN),
        "",
    ),
    "stray quote": (f"{TIDY}\n{rows(np.tile(RUN, (30, 1)))}".replace("\n0", '\n"0', 1), ""),
    "quote in heading": (f'"{TIDY}\n{rows()}', ""),
    "headings over lines": ('"time\n(s)","normal force\n(N)","traction\n(N)","displacement\n(mm)"\n' + rows(), ""),
    "minus of typesetting": (f"{TIDY}\n{rows()}".replace("-", "\N{MINUS SIGN}"), ""),
    "dash": (f"{TIDY}\n{rows()}".replace("-", "\N{EN DASH}"), ""),
    "wide minus": (f"{TIDY}\n{rows()}".replace("-", "\N{FULLWIDTH HYPHEN-MINUS}"), ""),
    "no-break blanks": (f"{TIDY}\n{rows(separator=chr(0xA0) + ',' + chr(0x202F))}", ""),
    "apostrophes": (grouped("'"), ""),
    "narrow blanks": (grouped("\u202f", ","), ""),
    "points": (grouped(".", ","), ""),
    "commas": (grouped(","), ""),
    "Fortran": (f"{TIDY}\n{rows(form='%.8E').replace('E', 'D')}", ""),
    "Shift-JIS": (f"{JAPANESE}\n{rows()}".encode("cp932"), ""),
    "Japanese EUC": (f"{JAPANESE}\n{rows()}".encode("euc_jp"), ""),
    "Korean": (f"{KOREAN}\n{rows()}".encode("cp949"), ""),
    "Cyrillic": (f"{RUSSIAN}\n{rows()}".encode("cp1251"), "columns: {displacement: Путь}"),
    "Western": (f"{GERMAN}\n{rows()}".encode("cp1252"), "columns: {displacement: Größe}"),
    "Mac": (f"{GERMAN}\n{rows()}".encode("mac_roman"), "encoding: mac_roman\ncolumns: {displacement: Größe}"),
    "UTF-16": (f"{TIDY}\n{rows()}".encode("utf-16-le"), ""),
    "UTF-32": (f"{TIDY}\n{rows()}".encode("utf-32"), ""),
    "spelled out": (f"Time [secs],Normal force [Newtons],Traction [Newton],x [millimeters]\n{rows()}", ""),
    "kgf and inches": (
        f"Time (msec),Fn (kg),Ft (lbf),x (inches)\n{rows(RUN / [1e-3, 9.80665, 4.4482216152605, 25.4], form='%.9f')}",
        "",
    ),
    "gram-force": (f"T,Fz,Fx,X\nsec,g,gf,mm\n{rows(RUN / [1, 9.80665e-3, 9.80665e-3, 1])}", ""),
    "units in the fields": (
        "t,Fn,Ft,x\n" + re.sub(r"(.*),(.*),(.*),(.*)\n", r"\1 s,\2 N,\3N,\4 mm\n", rows()),
        "",
    ),
    "units in the fields, decimal commas": (
        "t;Fn;Ft;x (mm)\n"
        + re.sub(r"(.*);(.*);(.*);(.*)\n", r"\1 ms;\2 N;\3 N;\4\n", rows(RUN * [1e3, 1, 1, 1], ";")).replace(".", ","),
        "",
    ),
    "given unit": (f"T,Fz,Fx,X\n{rows(RUN / [1e-3, 1, 1, 1])}", UNITS.replace("time: s", "time: milliseconds")),
    "date and clock": (f"Time,Fn (N),Ft (N),x (mm)\n{rows(form='%09.6f')}".replace("\n0", "\n22.11.2026 13:20:0"), ""),
    "comment mark": (f"# run 5\n# {TIDY}\n{rows()}", ""),
    "fixed width": (f"{TIDY}\n{rows()}".replace(",", "   "), ""),
    "blanks in headings": (f"{TIDY}\n{rows()}".replace(",", " "), ""),
    "repeated headings": (f"{TIDY}\n{rows(RUN[:300])}{TIDY}\n{rows(RUN[300:])}", ""),
    "remarks between": (f"{TIDY}\n{rows(RUN[:300])}paused, then resumed\n{rows(RUN[300:])}", ""),
    "results above the data": (
        f"Results\nTime,Fn,Ft,x\n(s),(N),(N),(mm)\n1.5,50.1,25.2,3.9\n1.9,50.3,25.1,12.1\n\nData\n"
        f"Time,Load,Traction,Disp\n(s),(N),(N),(mm)\n{rows()}",
        "",
    ),
    "statistics below the data": (f"{TIDY}\n{rows()}\nmean,min,max,range\n1,2,3,4\n", ""),
    "one of two tables": (f"{TIDY}\n{rows()}\nTime,Fn,Ft,Z\n{rows()}", "headings: 1"),
    "power lost": (f"{TIDY}\n{rows()}" + "\0" * 512, ""),
    "zeros in a row": (f"{TIDY}\n{rows()}".replace("\n0.1", "\n\0\0\0.1", 1), ""),
    "marks of no value": (f"{TIDY}\n{rows()}".replace("7\n", "ERR\n"), "missing: ['*ERR']"),
    "marks of overload": (
        f"{TIDY}\n{rows(RUN)}4.1,***,0,38\n4.2,-9999.00,0,38\n4.3,***,0,38\n4.4,***,0,38\n",
        "overloaded: ['***', -9999]\ntare: {from: 0, to: 0.7}",
    ),
    "testing machine": (
        '"Time ","Fn ","Ft ","Disp "\n"(s)","(N)","(N)","(mm)"\n' + re.sub(r"([^,\n]+)", r'"\1"', rows()),
        "",
    ),
    "Excel's first line": (f"sep=;\n{TIDY}\n{rows()}".replace(",", ";"), ""),
    "two kinds of distance": (
        f"t (s),Distance (m),Linear Position (mm),Fn (N),Ft (N)\n{rows(RUN[:, [0, 3, 3, 1, 2]] * [1, 2e-3, 1, 1, 1])}",
        "columns: {displacement: Linear Position}",
    ),
    "no times": (f"Fn (N),Ft (N),x (mm)\n{rows(RUN[:, 1:])}", "sampling: 150"),
}
# Under a known load
DEAD: dict[str, tuple[str, str]] = {
    "pull and extension": (f"Time (s),Load (N),Extension (mm)\n{rows(PULL)}", "normal: 50"),
    "tare of traction": (f"Time (s),Pull (N),x (mm)\n{rows(PULL)}", "normal: 50\ntare: {traction: -0.4}"),
    "tare at times": (f"Time (s),Pull (N),x (mm)\n{rows(PULL)}", "normal: 50\ntare: {from: 0, to: 0.7}"),
    "added constant": (f"Time (s),Ft (N),x (mm),Fn (N)\n{rows(PULL, end=',50.0')}", ""),
    "added constant, tare": (
        f"Time (s),Ft (N),x (mm),Fn (N)\n{rows(PULL, end=',50')}",
        "tare: {normal: 0, traction: -0.4}",
    ),
    "added, of two values": (
        f"Time (s),Ft (N),x (mm),Fn (N)\n{rows(np.column_stack([PULL, 50.0 * (RUN[:, 0] > 1.0)]))}",
        "",
    ),
    "measured beside it": (f"{TIDY}\n{rows()}", "normal: 50"),
}


Reducer = Callable[..., Reduced]


@pytest.fixture
def reduce(tmp_path: Path) -> Reducer:
    """Return a function that reduces a text with what the YAML file says."""

    def reduced(text: str | bytes, said: str = "", area: float = 100.0) -> Reduced:
        path, settings = tmp_path / "run.csv", tmp_path / "rig.yaml"
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        settings.write_text(f"area: {area:f}\n{said}\n", encoding="utf-8")
        (found,) = reduce_files([str(path)], read_settings(str(settings)))
        return found

    return reduced


def one_point(found: Reduced) -> tuple[float, float, float]:
    table = point_table([found])
    assert len(table) == 1, found.rejected
    return tuple(table[["speed_mm_per_s", "pressure_MPa", "friction_coefficient"]].iloc[0])


@pytest.mark.parametrize("kind", READ)
def test_loggers_file_gives_the_point_of_the_tidy_one(kind: str, reduce: Reducer) -> None:
    assert one_point(reduce(*READ[kind])) == pytest.approx((20.0, 0.5, 0.5), rel=2e-3)


@pytest.mark.parametrize("kind", DEAD)
def test_known_load_gives_the_point(kind: str, reduce: Reducer) -> None:
    found = reduce(*DEAD[kind])
    assert one_point(found) == pytest.approx((20.0, 0.5, 0.5), rel=2e-3)
    assert not any("clipped" in note for note in found.notes)


# kind: text, what the YAML file says, what the refusal says, and what follows its advice: another text (bytes), or
# another YAML file
REFUSED: dict[str, tuple[str | bytes, str, str, str | bytes]] = {
    "no unit of time": (
        f"timestamp,Fn (N),Ft (N),x (mm)\n{rows()}",
        "",
        r"no unit for the column 'timestamp': .* 'timestamp \(s\)', or .* as in units: \{time: s\}",
        "units: {time: s}",
    ),
    "no unit of place": (
        f"time (s),Fn (N),Ft (N),x\n{rows()}",
        "",
        r"as in 'x \(mm\)'",
        f"time (s),Fn (N),Ft (N),x (mm)\n{rows()}".encode(),
    ),
    "unit of voltage": (
        f"time (s),Fn (V),Ft (N),x (mm)\n{rows()}",
        "",
        "'V', but must be one of N, kN, .*kgf, gf",
        "units: {normal: N}",
    ),
    "units of voltage below": (
        f"Time,Fn,Ft,x\ns,V,V,V\n{rows()}",
        "",
        "which holds normal, is 'V', but must be one of N, ",
        "units: {normal: N, traction: N, displacement: mm}",
    ),
    "unit of turns": (
        f"time (s),Fn (N),Ft (N),x\ns,N,N,rev\n{rows()}",
        "",
        "'rev', but must be one of mm, m, ",
        "units: {displacement: mm}",
    ),
    "two units": (
        f"time (s),Fn (kN),Ft (N),x\ns,N,N,mm\n{rows()}",
        "",
        "the units 'kN' and 'N'.* as in units: {normal: N}",
        "units: {normal: N}",
    ),
    "times that differ": (
        f"Time (s),Fn (N),Time (s),Ft (N),x (mm)\n{rows(RUN[:, [0, 1, 0, 2, 3]] + [0, 0, 0.1, 0, 0])}",
        "",
        r"2 columns that may be time, and they differ: 'Time \(s\)' \(number 1\), .* as in columns: {time: 1}",
        "columns: {time: 1}",
    ),
    "times that differ, named": (
        f"Time (s),Fn (N),Time (s),Ft (N),x (mm)\n{rows(RUN[:, [0, 1, 0, 2, 3]] + [0, 0, 0.1, 0, 0])}",
        "columns: {time: Time}",
        r"2 columns named 'Time' that may be time",
        "columns: {time: 2nd Time}",
    ),
    "two ways of distance": (
        f"Time (s),Distance (m),Stroke (mm),Fn (N),Ft (N)\n{rows(RUN[:, [0, 3, 3, 1, 2]] * [1, 2e-3, 1, 1, 1])}",
        "",
        "2 columns that may be displacement .* as in columns: {displacement: 3}",
        "columns: {displacement: 3}",
    ),
    "travel and position": (
        f"Time (s),Travel (mm),X (mm),Fn (N),Ft (N)\n{rows(RUN[:, [0, 3, 3, 1, 2]] * [1, 2, 1, 1, 1])}",
        "",
        "2 columns that may be displacement",
        "columns: {displacement: X}",
    ),
    "no load": (
        f"Time (s),Load (N),Extension (mm)\n{rows(PULL)}",
        "",
        "no column that looks like traction; .* if the normal force is a known constant load, write normal:",
        "normal: 50",
    ),
    "no normal force": (
        f"Time (s),Pull (N),x (mm)\n{rows(PULL)}",
        "",
        "no column that looks like normal; .* write normal:",
        "normal: 50",
    ),
    "normal force of nothing": (
        f"Time (s),Ft (N),x (mm),Fn (N)\n{rows(PULL, end=',0')}",
        "",
        "has no normal force in sliding",
        "normal: 50",
    ),
    "begins under load": (
        f"Time (s),Ft (N),x (mm),Fn (N)\n{rows(np.column_stack([PULL, 49.0 + np.repeat(RUN[:100, 1], 6)]))}",
        "",
        "begins with a normal force of 50 N, too much .* a known constant load is given as normal:",
        "normal: 50",
    ),
    "no times": (f"Fn (N),Ft (N),x (mm)\n{rows(RUN[:, 1:])}", "", "like time; .* write sampling:", "sampling: 150"),
    "stamps of a second": (
        "Time,Fn (N),Ft (N),x (mm)\n" + re.sub(r"(?m)^(\d)\.\d+", r"12:00:0\1", rows()),
        "",
        r"600 rows share 4 time stamps: means taken\): export times with fractions .* or write sampling:",
        "sampling: 150",
    ),
    "no headings": (rows(), "", "no line of headings right above its numbers, which begin in line 1: ", NUMBERED),
    "numbers in the headings": (
        f"t 1,Fn 2,3,x\n{rows()}",
        "",
        "write its line under headings",
        f"headings: 1\n{NUMBERED}",
    ),
    "two fields a heading": (
        f"{TIDY}\n{rows()}".replace(".", ","),
        "",
        "4 headings in line 1, but 8 fields .* export with semicolons",
        f"{TIDY}\n{rows()}".replace(",", ";").replace(".", ",").encode(),
    ),
    "more fields": (
        f"{TIDY}\n{rows(end=',1')}",
        "",
        "4 headings in line 1, but 5 fields",
        f"{TIDY},count\n{rows(end=',1')}".encode(),
    ),
    "unknown sign": (
        f"{TIDY}\n{rows()}".replace(",-", ",~"),
        "",
        r"unreadable rows of 600, the first of them line 2: '~.* could bias the rest: correct them",
        f"{TIDY}\n{rows()}".encode(),
    ),
    "unknown word": (
        f"{TIDY}\n{rows()}".replace("5\n", "ERR\n"),
        "",
        r"'\d+\.\d+ERR' in the column .* list such words .* under missing",
        "missing: ['*ERR']",
    ),
    "thousands or decimals": (
        "t (ms);Fn (mN);Ft (mN);x (µm)\n" + "\n".join(";".join(f"{v:,.0f}" for v in row) for row in RUN * 1e3),
        "",
        "whose comma may separate decimals or thousands: write decimal: comma or decimal: point",
        "decimal: point",
    ),
    "another encoding": (
        f"{JAPANESE}\n{rows()}".encode("cp932"),
        "encoding: utf-8",
        "line 1 has no meaning in it; .* under encoding",
        "encoding: cp932",
    ),
    "encoding of no sense": (
        f"{TIDY}\n{rows()}",
        "encoding: klingon",
        "'klingon', but .* such as utf-8",
        "encoding: utf-8",
    ),
    "numbers above the headings": (
        f"{rows(RUN[:300])}{TIDY}\n{rows()}",
        "",
        "has numbers above its headings, in line 301: write the line",
        "headings: 301",
    ),
    "values at other times": (
        f"{TIDY}\n" + re.sub(r"(\n.*\n.*\n.*,)[^,]*(?=\n)", r"\1", rows()),
        "",
        "lacks a value in .* most often of displacement: export all columns at the same times",
        f"{TIDY}\n{rows()}".encode(),
    ),
    "two tables": (
        f"t (s),Fn (N),Ft (N),x (mm)\n{rows()}\nTime (s),Fn (N),Ft (N),x (mm)\n{rows()}",
        "",
        "has several tables, with headings in lines 1, 603: write the line of the headings to read",
        "headings: 603",
    ),
    "two segments": (
        (one := lvm("One", ("Fn", "Ft", "Position"), RUN)) + one.split("\t\n\t\n")[1],
        "",
        "holds 2 segments .* lines 16, 625: write the line of one",
        "headings: 16",
    ),
}


@pytest.mark.parametrize("kind", REFUSED)
def test_refusal_says_what_to_do_and_that_helps(kind: str, reduce: Reducer) -> None:
    text, said, says, better = REFUSED[kind]
    with pytest.raises(InvalidInput, match=says) as caught:
        reduce(text, said)
    assert "\n" not in str(caught.value)
    followed = reduce(better) if isinstance(better, bytes) else reduce(text, better)
    assert one_point(followed) == pytest.approx((20.0, 0.5, 0.5), rel=5e-3)


def test_slip_in_the_area_is_noticed(reduce: Reducer) -> None:
    text = f"{TIDY}\n{rows()}"
    with pytest.raises(InvalidInput, match=r"^area is 0.0001 mm², .* it is probably in m², 100 mm²$"):
        reduce(text, area=1e-4)
    with pytest.raises(InvalidInput, match=r"area of 0.2 mm² make 250 MPa, .* \(0.2 m² would be 200000 mm²\)$"):
        reduce(text, area=0.2)
    for area in (1.0, 1e7):
        assert any("far from usual pressures" in note for note in reduce(text, area=area).notes)
    assert not any("far from usual" in note for note in reduce(text).notes)


def test_what_was_guessed_or_chosen_is_said(reduce: Reducer) -> None:
    for kind, says in (
        ("Shift-JIS", r"read in the encoding cp932 \(Shift-JIS\), which was guessed; encoding in the YAML"),
        ("time per channel", r"the columns number 1, 3 of time are equal: the first is taken"),
        ("kgf and inches", r"normal in kg is read as the weight of that mass, 9\.80665 N"),
        ("time of one channel", r"the times of column number 3 differ by up to 0\.1; those of number 1 are taken"),
        ("repeated headings", r"1 repeated lines of headings left out"),
    ):
        assert any(re.match(says, note) for note in reduce(*READ[kind]).notes), kind
    with pytest.raises(InvalidInput, match=r"looks like time; its columns are .* - read in the encoding cp932"):
        reduce(f"測定,{JAPANESE.split(',', 1)[1]}\n{rows()}".encode("cp932"))


def test_few_accidents_are_left_out_and_what_may_go_with_the_value_is_not(reduce: Reducer) -> None:
    garbled = f"{TIDY}\n{rows()}".replace("\n0.3", "\n0.x3", 1).replace("\n2.0", "\n2.0,,", 1)
    found = reduce(garbled)
    assert one_point(found) == pytest.approx((20.0, 0.5, 0.5), rel=2e-3)
    assert any(re.match(r"2 unreadable rows left out, the first of them line \d+: '0.x3", note) for note in found.notes)
    lines = f"{TIDY}\n{rows()}".splitlines()
    few = [line.replace(",", ",~", 1) if place in (100, 200, 300) else line for place, line in enumerate(lines)]
    with pytest.raises(InvalidInput, match="has 3 unreadable rows of 600, the first of them line 101: '~"):
        reduce("\n".join(few))


@pytest.mark.parametrize("name", ["=1+2;x.csv", "+x.csv", "-x.csv", "@x.csv"])
def test_name_of_a_run_is_no_formula(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path(name).write_text(f"{TIDY}\n{rows()}", encoding="utf-8")
    runs = reduce_files([name], read_settings(None, area=100.0))
    write_table(point_table(runs), "points.csv")
    assert Path("points.csv").read_text(encoding="utf-8").splitlines()[1].startswith(f"'{name},steady,")
    assert list(read_table("points.csv", ["run"])["run"]) == [name]
