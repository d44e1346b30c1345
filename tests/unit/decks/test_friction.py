"""Friction as decks, read back by the rules of the codes' manuals."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise, product

import pytest

from rubfric.decks.friction import FrictionPoint, write_abaqus, write_ansys

SPEEDS, PRESSURES = (0.1, 100.0, 10000.0), (0.2, 1.0)


def made(*temperatures: float | None) -> list[FrictionPoint]:
    return [
        FrictionPoint((10 + place) / 100, speed, pressure, warm, f"+- {0.001 * place:g}, direct")
        for place, (warm, pressure, speed) in enumerate(product(temperatures, PRESSURES, SPEEDS))
    ]


def ansys_tables(text: str) -> dict[int, dict[tuple[tuple[str, float], ...], float]]:
    """Return friction by material and fields, as Ansys understands commands: a field holds until it is given again."""
    tables: dict[int, dict[tuple[tuple[str, float], ...], float]] = {}
    fields: dict[str, float] = {}
    for line in text.splitlines():
        command, *words = line.split("!")[0].strip().split(",")
        if command == "TB":
            assert (words[0], words[4]) == ("FRIC", "ISO")
            fields, own = {}, tables.setdefault(int(words[1]), {})
        elif command == "TBFIELD":
            fields[words[0]] = float(words[1])
        elif command == "TBDATA":
            assert words[0] == "1"
            own[tuple(fields.items())] = float(words[1])
        else:
            assert not command, line
    return tables


@pytest.mark.parametrize("temperatures", [(None,), (20.0, 60.0)])
def test_abaqus_has_each_point_on_a_line_with_the_first_variable_fastest(
    temperatures: tuple[float | None, ...],
) -> None:
    points = made(*temperatures)
    text = write_abaqus(points, "soft_on_street", ["made in Köln"])
    lines = [line for line in text.splitlines() if not line.startswith("**")]
    assert lines[:2] == ["*SURFACE INTERACTION, NAME=friction_soft_on_street", "*FRICTION"]
    rows = [tuple(float(word) for word in line.split(",")) for line in lines[2:]]
    assert rows == [tuple(value for value in point[:4] if value is not None) for point in points]
    variables = [row[:0:-1] for row in rows]  # temperature, pressure, slip rate
    assert all(before < after for before, after in pairwise(variables))
    assert text.isascii()
    assert "** +- 0.005, direct" in text
    assert all(len(line) <= 256 for line in text.splitlines())


@pytest.mark.parametrize(
    ("temperatures", "fields", "materials"),
    [((None,), ["NPRES", "SLRV"], [4]), ((20.0, 60.0), ["NPRES", "SLRV"], [4, 5])],
)
def test_ansys_has_two_fields_at_most(
    temperatures: tuple[float | None, ...], fields: list[str], materials: list[int]
) -> None:
    points = made(*temperatures)
    tables = ansys_tables(write_ansys(points, 4, ["made by hand"]))
    assert list(tables) == materials
    for warm, table in zip(temperatures, tables.values(), strict=True):
        own = {(point.pressure, point.speed): point.friction for point in points if point.temperature == warm}
        found: Mapping[tuple[float, ...], float] = {
            tuple(value for _, value in at): friction for at, friction in table.items()
        }
        assert all([name for name, _ in at] == fields for at in table)
        assert found == pytest.approx(own)
        assert list(found) == sorted(found)


def test_ansys_takes_temperature_where_pressure_is_one() -> None:
    points = [point for point in made(20.0, 60.0) if point.pressure == 0.2]
    (table,) = ansys_tables(write_ansys(points, 1, [])).values()
    assert [dict(at) for at in table] == [{"TEMP": point.temperature, "SLRV": point.speed} for point in points]
