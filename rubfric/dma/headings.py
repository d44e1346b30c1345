"""Which column holds which quantity: by the names given, or by usual names; and whether moduli are E or G."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from rubfric.arrays import Real
from rubfric.dma.units import check_unit, convert, split_heading
from rubfric.errors import InvalidInput

# quantity: kind of its unit.
QUANTITIES = {
    **{"frequency": "frequency", "temperature": "temperature"},
    **{"storage": "modulus", "loss": "modulus", "complex": "modulus", "tan_delta": "ratio", "phase": "angle"},
}
# Names as ``_plain`` writes them: small letters, primes as ', no marks of punctuation.
_USUAL = {
    "frequency": r"f|freq|frequency|frequenz|omega|ω|w|angular (frequency|freq)|ang(ular)? freq(uency)?|test frequency",
    "temperature": r"t|temp|temperature|temperatur|sample temp(erature)?|temp(erature)? sample",
    "storage": r"[eg]'|[eg] ?(stor|storage|prime|1)|([a-z']+ )?storage( modulus)?( [eg]')?|speichermodul( [eg]')?",
    "loss": r"[eg]''|[eg] ?(loss|double prime|2)|([a-z']+ )?loss( modulus)?( [eg]'')?|verlustmodul( [eg]'')?",
    "complex": r"\|?[eg]\*\|?|[eg] ?(star|complex)|([a-z']+ )?complex( modulus)?|(dynamic|abs) modulus",
    "tan_delta": r"tan ?(delta|d|δ)|tand|tandelta|loss factor|verlustfaktor|damping|loss tangent",
    "phase": r"phase( angle)?|phase shift|delta|δ|loss angle|phasenwinkel",
}
_TENSION = re.compile(r"(^|[^a-z])e('|\*| ?_?(stor|loss|complex|prime))|young|tensile|tension|elongation|flexural")
_SHEAR = re.compile(r"(^|[^a-z])g('|\*| ?_?(stor|loss|complex|prime))|shear")
# What may be measured together: the two moduli follow from any of these.
_PAIRS = (
    *(("storage", "loss"), ("storage", "tan_delta"), ("complex", "tan_delta")),
    *(("storage", "phase"), ("complex", "phase"), ("loss", "tan_delta")),
)


def recognise(
    path: str, headings: Sequence[str], named: Mapping[str, str], master: bool
) -> tuple[dict[str, int], tuple[str, str]]:
    """Return the column of each quantity, and the pair from which both moduli follow.

    Parameters
    ----------
    path : str
        The file, for messages.
    headings : sequence of str
        Of all columns.
    named : mapping
        Quantity to heading, where the user names it: with the unit or without.
    master : bool
        Whether the file is a master curve, without temperatures.

    Raises
    ------
    InvalidInput
        Where a column is missing or may be one of several.
    """
    names = [_plain(split_heading(heading)[0]) for heading in headings]
    found: dict[str, list[int]] = {}
    for quantity, usual in _USUAL.items():
        if quantity in named:
            wanted = named[quantity].strip()
            found[quantity] = [
                i
                for i, heading in enumerate(headings)
                if wanted in (heading.strip(), split_heading(heading)[0].strip())
            ]
            _check_one(path, quantity, headings, found[quantity], f"named {named[quantity]!r} for")
        else:
            taken = {heading.strip() for heading in named.values()}
            found[quantity] = [
                i for i, name in enumerate(names) if re.fullmatch(usual, name) and headings[i].strip() not in taken
            ]
    needed = ["frequency"] if master else ["frequency", "temperature"]
    pair = next((pair for pair in _PAIRS if all(found[name] for name in pair)), None)
    if pair is None:
        raise InvalidInput(
            f"{path} has no two columns that look like storage and loss modulus, one of them and tan delta, or the "
            f"complex modulus and its phase; its columns are {_listed(headings)}: name them under columns in the YAML "
            "file of --columns"
        )
    for quantity in (*needed, *pair):
        hint = ", or say --master if it is a master curve" if quantity == "temperature" and not found[quantity] else ""
        _check_one(path, quantity, headings, found[quantity], "that may be", hint)
    places = {quantity: found[quantity][0] for quantity in (*needed, *pair)}
    for quantity, place in places.items():
        if list(places.values()).count(place) > 1:
            raise InvalidInput(f"{path} has one column, {headings[place]!r}, for {quantity} and another quantity")
    return places, pair


def _check_one(
    path: str, quantity: str, headings: Sequence[str], found: Sequence[int], how: str, hint: str = ""
) -> None:
    if len(found) == 1:
        return
    many = "no column" if not found else f"{len(found)} columns"
    raise InvalidInput(
        f"{path} has {many} {how} {quantity}; its columns are {_listed(headings)}: name it under columns in the YAML "
        f"file of --columns{hint}"
    )


def _listed(headings: Sequence[str]) -> str:
    return ", ".join(repr(heading.strip()) for heading in headings)


def converted(path: str, quantity: str, heading: str, below: str, given: str | None, values: Real) -> Real:
    """Return a column in rad/s, degC, MPa, rad or as a plain ratio.

    Parameters
    ----------
    path, quantity, heading : str
    below : str
        The unit in the line below the headings, or nothing.
    given : str, optional
        The unit that the user gives.
    values : ndarray, shape (rows,)

    Raises
    ------
    InvalidInput
        For a missing or unknown unit.
    """
    kind = QUANTITIES[quantity]
    unit = given or below or split_heading(heading)[1]
    if not unit and kind != "ratio":
        example = {"frequency": "Hz", "temperature": "degC", "modulus": "MPa", "angle": "deg"}[kind]
        raise InvalidInput(
            f"{path} has no unit for the column {heading.strip()!r}: write it in the heading, as in "
            f"'{heading.strip()} ({example})', or under units in the YAML file of --columns"
        )
    if not given and kind == "ratio" and convert("ratio", unit) is None:
        unit = ""
    factor, offset = check_unit(f"the unit of {heading.strip()!r} in {path}", kind, unit)
    return values * factor + offset


def modulus_kind(path: str, headings: Sequence[str], given: str | None) -> str:
    """Return E or G: which modulus the columns hold.

    Parameters
    ----------
    path : str
    headings : sequence of str
        Of the columns of moduli.
    given : {"E", "G"}, optional
        What the user says.

    Raises
    ------
    InvalidInput
        Where the headings do not say, or say both.
    """
    if given:
        return given
    plain = [_plain(heading) for heading in headings]
    said = {"E" for name in plain if _TENSION.search(name)} | {"G" for name in plain if _SHEAR.search(name)}
    if len(said) != 1:
        which = "do not say" if not said else "say both"
        raise InvalidInput(
            f"{path} has moduli in {_listed(headings)}, which {which} whether they are Young's moduli or shear moduli: "
            "say --modulus E or --modulus G"
        )
    return said.pop()


def _plain(name: str) -> str:
    """Return a heading in small letters, its primes as apostrophes, without punctuation."""
    text = name.strip().casefold().replace("″", "''").replace('"', "''").replace("”", "''")
    text = re.sub("[′’`´]", "'", text)
    return " ".join(re.split(r"[\s_().,:-]+", text)).strip()
