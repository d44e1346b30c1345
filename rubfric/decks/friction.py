"""Friction over slip speed, pressure and temperature as decks: *FRICTION of Abaqus and TB,FRIC of Ansys."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby
from typing import NamedTuple

from rubfric.decks.deck import number
from rubfric.errors import InvalidInput

# Names of Abaqus have at most so many letters, lines of comments as many here.
_LONGEST, _WIDTH = 80, 200


class FrictionPoint(NamedTuple):
    """Friction at one point.

    Attributes
    ----------
    friction : float
    speed : float
        mm/s.
    pressure : float
        MPa.
    temperature : float or None
        degC; None where friction is known at one temperature only, which is not said.
    remark : str
        Its error and how it was found.
    """

    friction: float
    speed: float
    pressure: float
    temperature: float | None
    remark: str


def write_abaqus(points: Sequence[FrictionPoint], name: str, about: Sequence[str]) -> str:
    """Return friction as a surface interaction of Abaqus.

    A data line has friction coefficient, slip rate, contact pressure, and average temperature at the contact point
    (Abaqus Keywords Guide, *FRICTION); the first variable, slip rate, goes through its values at fixed values of the
    others, in ascending order.

    Parameters
    ----------
    points : sequence of FrictionPoint
        By temperature, pressure and speed, all ascending.
    name : str
        Of the surface interaction.
    about : sequence of str
        Lines of comment.
    """
    lines = [*(f"** {line}" for line in _comments(about))]
    lines += [f"*SURFACE INTERACTION, NAME={f'friction_{name}'[:_LONGEST]}", "*FRICTION"]
    for point in points:
        at = [point.friction, point.speed, point.pressure]
        at += [] if point.temperature is None else [point.temperature]
        lines += [f"** {point.remark}", ", ".join(number(value, 6) for value in at)]
    return "\n".join(lines) + "\n"


def write_ansys(points: Sequence[FrictionPoint], material: int, about: Sequence[str]) -> str:
    """Return friction as isotropic friction of Ansys.

    TB,FRIC takes up to two field variables (Mechanical APDL Material Reference, contact friction), each ascending, the
    last one fastest: sliding velocity SLRV, and normal pressure NPRES or temperature TEMP where there are several.
    Where both of these vary, every temperature is a material of its own.

    Parameters
    ----------
    points : sequence of FrictionPoint
        By temperature, pressure and speed, all ascending.
    material : int
        Number of the contact elements' material, from 1; the first of several.
    about : sequence of str
        Lines of comment.
    """
    lines = [f"! {line}" for line in _comments(about)]
    pressures = {point.pressure for point in points}
    temperatures = {point.temperature for point in points}
    if len(pressures) == 1 or len(temperatures) == 1:
        outer = "TEMP" if len(temperatures) > 1 else "NPRES"
        return "\n".join([*lines, *_isotropic(points, material, outer)]) + "\n"
    lines.append("! Ansys has friction over two variables at most: each temperature is a material of its own")
    for place, (temperature, own) in enumerate(groupby(points, key=lambda point: point.temperature)):
        lines += [f"! material {material + place} is for {temperature:g} degC"]
        lines += _isotropic([*own], material + place, "NPRES")
    return "\n".join(lines) + "\n"


def _isotropic(points: Sequence[FrictionPoint], material: int, outer: str) -> Iterator[str]:
    yield f"TB,FRIC,{material},,,ISO"
    last = None
    for point in points:
        value = point.temperature if outer == "TEMP" else point.pressure
        if value is None:
            raise InvalidInput("friction over temperature must have a temperature at every point")
        if value != last:
            yield f"TBFIELD,{outer},{number(value, 6)}"
            last = value
        yield f"TBFIELD,SLRV,{number(point.speed, 6)}"
        yield f"TBDATA,1,{number(point.friction, 6)} ! {point.remark}"


def _comments(lines: Sequence[str]) -> Iterator[str]:
    """Yield lines in ASCII, which is all that the codes read, and not too long."""
    for line in lines:
        plain = line.encode("ascii", "backslashreplace").decode()
        yield from (plain[start : start + _WIDTH] for start in range(0, len(plain), _WIDTH))
