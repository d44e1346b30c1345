"""The YAML file on the rig: read whole, or refused in one sentence."""

from __future__ import annotations

from pathlib import Path

import pytest

from rubfric.errors import InvalidInput
from rubfric.rig.settings import Bearing, Settings, Tare, Windows, read_settings

# A list of ten lists of ten lists of ..., in some 200 bytes
_NAMES = zip("abc", "bcd", strict=True)
BOMB = "&a [1,1,1,1,1,1,1,1,1,1]" + "".join(f", &{to} [{','.join([f'*{of}'] * 10)}]" for of, to in _NAMES)
GOOD = """
columns: {time: Zeit, normal: Fz, traction: Fx, displacement: Weg}
units: {normal: kN}
area: 100
traction: rope
sled_mass: 5
tare: {from: 0, to: 1.5}
bearing: {file: pull.csv, coefficient: 0.004}
range: {normal: 500}
calibration: {normal: 0.005, traction: 0, displacement: 0.001}
windows: {least_travel: 2, least_samples: 40}
decimal: comma
separator: semicolon
"""


def test_nothing_is_needed() -> None:
    assert read_settings(None) == Settings()


def test_file_is_read_whole(tmp_path: Path) -> None:
    path = tmp_path / "rig.yaml"
    path.write_text(GOOD)
    found = read_settings(str(path))
    assert found.columns["displacement"] == "Weg"
    assert found.tare == Tare("times", 0.0, 1.5)
    assert found.bearing == Bearing(coefficient=0.004, file=str(tmp_path / "pull.csv"))
    assert found.windows == Windows(least_travel=2.0, least_samples=40)
    assert found.calibration == {"normal": 0.005, "traction": 0.0, "displacement": 0.001}
    assert (found.area, found.traction, found.sled_mass, found.form.decimal) == (100.0, "rope", 5.0, "comma")


def test_options_lie_above_the_file(tmp_path: Path) -> None:
    path = tmp_path / "rig.yaml"
    path.write_text(GOOD)
    found = read_settings(str(path), area=50.0, traction=None)
    assert (found.area, found.traction) == (50.0, "rope")


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("areas: 1", r"has the unknown key 'areas'; allowed are .* \(did you mean area\?\)"),
        ("area: 0", "area is 0 mm², but must be greater than 0"),
        ("area: 1e2", r"area is the text '1e2', but must be a number \(YAML reads it as text; write 1.0e\+2\)"),
        ("traction: wheel", "traction is 'wheel', but must be one of rubber, rope"),
        ("traction: rope", r"traction is rope, so sled_mass must be given \(kg\)"),
        ("tare: sometimes", "tare is 'sometimes', but must be one of auto, none"),
        ("tare: {from: 2, to: 1}", "tare.to is 1 s, but must be later than tare.from, 2 s"),
        ("tare: {from: 2}", r"tare is {'from': 2}, but must hold from and to \(s\), or normal and traction \(N\)"),
        ("bearing: {force: 1, file: a.csv}", "bearing has both a force and a file"),
        ("bearing: {force: -1}", "bearing.force is -1, but must be at least 0"),
        ("bearing: {file: $NOWHERE/a.csv}", "bearing.file is .*, but the environment variable NOWHERE is not set"),
        ("columns: {load: Fz}", "columns has the unknown key 'load'; allowed are time, normal, "),
        ("columns: {normal: 0}", "columns.normal is 0, but must be the heading of a column, or its number from 1 on"),
        ("units: {normal: V}", "units.normal is 'V', but must be one of N, kN"),
        ("windows: {least_samples: 5}", "windows.least_samples is 5, but must be a whole number of at least 20"),
        ("windows: {drift: 2}", "windows.drift is 2, but must lie between 0 and 1, both excluded"),
        ("calibration: {normal: 5}", "calibration.normal is 5, but must be at most 1"),
        ("range: {displacement: 5}", "range has the unknown key 'displacement'; allowed are normal, traction"),
        ("normal: 50 N", "normal is the text '50 N', but must be a number"),
        ("normal: 50\ncolumns: {normal: Fz}", "normal is given, and columns.normal names a column"),
        ("sampling: 50\ncolumns: {time: 1}", "sampling is given, and columns.time names a column"),
        (
            "tare: {traction: 1}",
            r"tare holds traction alone, but must hold normal \(N\) too",
        ),
        ("headings: 0", "headings is 0, but must be a whole number of at least 1"),
        ("encoding: klingon", "encoding is 'klingon', but must be the name of an encoding, such as utf-8"),
        ("encoding: [base64]", "but must be the name of an encoding"),
        ("missing: {a: 1}", "missing is {'a': 1}, but must be a list of words"),
        *(
            (f"{key}: [{BOMB}]", rf"^{key} (is|has) .{{1,90}}, but must|^columns is")
            for key in ("area", "columns", "missing", "encoding")
        ),
        ("area: " + "[" * 1200 + "]" * 1200, "is not valid YAML: lists or mappings are nested too deeply"),
        ("- 1", r"is \[1\], but must hold the keys columns, units, area"),
        ("a: [", "is not valid YAML: "),
    ],
)
def test_what_is_wrong_gives_one_sentence(text: str, says: str, tmp_path: Path) -> None:
    path = tmp_path / "rig.yaml"
    path.write_text(text)
    with pytest.raises(InvalidInput, match=says) as caught:
        read_settings(str(path))
    assert "\n" not in str(caught.value)
