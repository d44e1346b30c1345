"""Decks as files: which code one is for, its units, and the rubber in it."""

from __future__ import annotations

from pathlib import Path

from rubfric.decks import abaqus, ansys, lsdyna
from rubfric.decks.deck import STRESS, TIMES, UNITS, Deck
from rubfric.errors import InvalidInput
from rubfric.rubber.material import Material
from rubfric.rubber.shift import ShiftedRubber

CODES = {"abaqus": abaqus, "ansys": ansys, "lsdyna": lsdyna}


def read_deck(path: str, code: str | None = None, units: str | None = None, material: str | None = None) -> Deck:
    """Read a rubber from a deck.

    Parameters
    ----------
    path : str
    code : {"abaqus", "ansys", "lsdyna"}, optional
        Found out by default.
    units : str, optional
        Units of stress and time, ``MPa,s`` say; decks written by this program say theirs.
    material : str, optional
        Name or number of the material, where the deck has several.

    Raises
    ------
    InvalidInput
        For a deck that cannot be read, or whose units are not known.
    FileNotFoundError
        For a missing file.
    """
    if Path(path).is_dir():
        raise InvalidInput(f"{path} is a folder, but must be a deck")
    text = Path(path).read_bytes().decode("utf-8-sig", errors="replace")
    found = code or _code(path, text)
    if units is None and UNITS not in text:
        raise InvalidInput(
            f"{path} does not say its units, as decks do not: give those of stress and time with --units, MPa,s say"
        )
    stress, _, time = (units or "MPa,s").partition(",")
    if stress.strip() not in STRESS or time.strip() not in TIMES:
        raise InvalidInput(
            f"--units is {units!r}, but must be a unit of stress ({', '.join(STRESS)}), a comma, and one of time "
            f"({', '.join(TIMES)})"
        )
    return CODES[found].read(path, text, material, STRESS[stress.strip()], TIMES[time.strip()])


def _code(path: str, text: str) -> str:
    upper = text.upper()
    signs = {
        "abaqus": "*VISCOELASTIC" in upper.replace(" ", ""),
        "ansys": any(sign in upper.replace(" ", "") for sign in ("TB,PRON", "TB,PRONY")),
        "lsdyna": any(name in upper for name in ("*MAT_GENERAL_VISCOELASTIC", "*MAT_076")),
    }
    found = [name for name, there in signs.items() if there]
    if len(found) != 1:
        raise InvalidInput(
            f"{path} has no Prony series of a code that is known (*VISCOELASTIC of Abaqus, TB,PRONY of Ansys, "
            "*MAT_GENERAL_VISCOELASTIC of LS-DYNA)"
            if not found
            else f"{path} may be a deck of {' or '.join(found)}: say --code"
        )
    return found[0]


def write_deck(code: str, rubber: Material | ShiftedRubber) -> str:
    """Return a rubber as a deck, in MPa, mm and s.

    Parameters
    ----------
    code : {"abaqus", "ansys", "lsdyna"}
    rubber : Material or ShiftedRubber

    Raises
    ------
    InvalidInput
        For what the code does not hold.
    """
    return CODES[code].write(rubber)
