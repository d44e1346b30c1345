"""Ansys: TB,PRONY with TBDATA in pairs of share and time, elastic constants by MP, and TB,SHIFT of WLF."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from rubfric.decks.deck import UNITS, Deck, Elastic, chosen, instantaneous, number, unshifted
from rubfric.errors import InvalidInput
from rubfric.rubber.material import Material
from rubfric.rubber.shift import ShiftedRubber

# Commands that set up a session and say nothing of the rubber.
_QUIET = ("/", "!", "C***", "TBDEL", "MPDEL", "TBFIELD", "TBIN", "TBTEMP", "FINISH", "MPTEMP")
_TERMS = 2
_NOTE = "elastic constants are taken as the instantaneous ones, as Ansys takes them beside Prony terms"


@dataclass
class _Material:
    constants: dict[str, float] = field(default_factory=dict)
    tables: dict[str, dict[int, float]] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)


def read(source: str, text: str, material: str | None, stress: float, time: float) -> Deck:
    """Read a material of an Ansys deck.

    Parameters
    ----------
    source, text : str
        The file's name and content.
    material : str, optional
        The material's number, where the deck has several with a Prony series.
    stress, time : float
        The deck's units, MPa and s.

    Raises
    ------
    InvalidInput
        For a deck without such a material, or one that the model has not.
    """
    materials = _materials(source, text)
    found = {name: each for name, each in materials.items() if "PRON SHEA" in each.tables}
    if not found:
        raise InvalidInput(f"{source} has no material with TB,PRONY and shear terms")
    name = chosen(source, found, material)
    own = found[name]
    shear, bulk = _pairs(source, own.tables["PRON SHEA"]), _pairs(source, own.tables.get("PRON BULK", {}))
    times = list(dict.fromkeys([at for _, at in shear] + [at for _, at in bulk]))
    elastic = _elastic(source, own.constants, stress)
    shares, relaxing = (
        tuple(math.fsum(share for share, at in terms if at == each) for each in times) for terms in (shear, bulk)
    )
    return Deck(
        source,
        name,
        elastic,
        shares,
        relaxing,
        tuple(each * time for each in times),
        density=own.constants["DENS"] * stress * time**2 if "DENS" in own.constants else None,
        notes=(*own.notes, *([_NOTE] if elastic else [])),
    )


def _materials(source: str, text: str) -> dict[str, _Material]:
    materials: dict[str, _Material] = {}
    current: dict[int, float] | None = None
    for place, raw in enumerate(text.splitlines(), 1):
        line = raw.split("!")[0].strip()
        words = [word.strip() for word in line.split(",")]
        command = words[0].upper()
        if not line or command.startswith(_QUIET):
            continue
        if command == "TB":
            own = materials.setdefault(_word(words, 2) or "1", _Material())
            kind = _word(words, 1).upper()[:4]
            table = f"{kind} {_word(words, 5).upper()[:4]}".strip()
            current = own.tables.setdefault(table, {})
            if kind == "PRON" and _word(words, 3) not in ("", "1"):
                raise InvalidInput(
                    f"{source} has Prony terms at {words[3]} temperatures in line {place}: keep those of one"
                )
            if kind != "PRON":
                own.notes.append(f"TB,{words[1]} in line {place} is not read")
        elif command == "TBDATA" and current is not None:
            start = int(_value(source, place, _word(words, 1) or "1"))
            for step, word in enumerate(words[2:]):
                if word:
                    current[start + step] = _value(source, place, word)
        elif command == "MP":
            own = materials.setdefault(_word(words, 2) or "1", _Material())
            label = _word(words, 1).upper()
            if label in ("EX", "NUXY", "PRXY", "GXY", "DENS"):
                own.constants[label] = _value(source, place, _word(words, 3))
                if any(words[4:]):
                    own.notes.append(f"the dependence of {label} on temperature in line {place} is not read")
            else:
                own.notes.append(f"MP,{label} in line {place} is not read")
    return materials


def _word(words: list[str], place: int) -> str:
    return words[place] if place < len(words) else ""


def _value(source: str, place: int, word: str) -> float:
    try:
        return float(word.upper().replace("D", "E"))
    except ValueError as error:
        raise InvalidInput(f"{source} has {word!r} in line {place}, but must have a number there") from error


def _pairs(source: str, table: dict[int, float]) -> list[tuple[float, float]]:
    count = max(table, default=0)
    if count % _TERMS:
        raise InvalidInput(f"{source} has {count} constants of TB,PRONY, but must have pairs of share and time")
    return [(table.get(place, 0.0), table.get(place + 1, 0.0)) for place in range(1, count, _TERMS)]


def _elastic(source: str, constants: dict[str, float], stress: float) -> Elastic | None:
    poisson = constants.get("PRXY", constants.get("NUXY"))
    if "EX" in constants and poisson is not None:
        return Elastic.from_young(constants["EX"] * stress, poisson, long_term=False)
    if "EX" in constants and "GXY" in constants:
        poisson = constants["EX"] / (2.0 * constants["GXY"]) - 1.0
        return Elastic.from_young(constants["EX"] * stress, poisson, long_term=False)
    if "EX" in constants:
        raise InvalidInput(f"{source} has MP,EX without Poisson's ratio: add MP,PRXY to it")
    return None


def write(rubber: Material | ShiftedRubber) -> str:
    """Return a rubber as an Ansys material, in MPa, mm and s.

    Parameters
    ----------
    rubber : Material or ShiftedRubber
        Shift factors are refused.

    Raises
    ------
    InvalidInput
        For shift factors.
    """
    rubber = unshifted(rubber, "Ansys")
    shear, bulk = instantaneous(rubber)
    young = 9.0 * bulk * shear / (3.0 * bulk + shear)
    poisson = (3.0 * bulk - 2.0 * shear) / (2.0 * (3.0 * bulk + shear))
    lines = [f"! {UNITS}", f"! {rubber.name}; EX is the instantaneous modulus"]
    lines += [f"MP,{label},1,{number(value)}" for label, value in (("EX", young), ("PRXY", poisson))]
    lines.append(f"MP,DENS,1,{number(rubber.density)}")
    terms = list(zip(rubber.shear_fractions, rubber.relaxation_times, strict=True))
    for option in ("SHEAR", "BULK") if rubber.bulk == "proportional" else ("SHEAR",):
        lines.append(f"TB,PRONY,1,1,{len(terms)},{option}")
        for place, (share, time) in enumerate(terms):
            lines.append(f"TBDATA,{1 + _TERMS * place},{number(share)},{number(time)}")
    return "\n".join(lines) + "\n"
