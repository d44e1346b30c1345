"""Abaqus: *VISCOELASTIC, TIME=PRONY with *ELASTIC or *HYPERELASTIC of neo-Hooke and Mooney-Rivlin, and *TRS."""

from __future__ import annotations

import math
from dataclasses import dataclass

from rubfric.decks.deck import UNITS, Deck, Elastic, chosen, number
from rubfric.errors import InvalidInput
from rubfric.rubber.material import Material
from rubfric.rubber.shift import Shift, ShiftedRubber

_MINOR = {"MATERIAL", "DENSITY", "ELASTIC", "HYPERELASTIC", "VISCOELASTIC", "TRS"}
# Keywords that end a material's options, since they belong to the model.
_OPTIONS = _MINOR | {
    *("EXPANSION", "CONDUCTIVITY", "SPECIFIC HEAT", "DAMPING", "HYPERFOAM", "MULLINS EFFECT", "HYSTERESIS", "PLASTIC"),
    *("VOLUMETRIC TEST DATA", "UNIAXIAL TEST DATA", "SHEAR TEST DATA", "PERMANENT SET", "DEPVAR", "USER MATERIAL"),
}


@dataclass
class _Block:
    keyword: str
    options: dict[str, str]
    rows: list[list[float]]
    line: int


def read(source: str, text: str, material: str | None, stress: float, time: float) -> Deck:
    """Read a material of an Abaqus deck.

    Parameters
    ----------
    source, text : str
        The file's name and content.
    material : str, optional
        The material's name, where the deck has several with a Prony series.
    stress, time : float
        The deck's units, MPa and s.

    Raises
    ------
    InvalidInput
        For a deck without such a material, or one that the model has not.
    """
    found = {name: blocks for name, blocks in _materials(source, text).items() if _block(blocks, "VISCOELASTIC")}
    if not found:
        raise InvalidInput(f"{source} has no material with *VISCOELASTIC")
    name = chosen(source, found, material)
    blocks = found[name]
    terms = _terms(source, blocks)
    density = _block(blocks, "DENSITY")
    notes = [f"*{each.keyword} in line {each.line} is not read" for each in blocks if each.keyword not in _MINOR]
    elastic, more = _elastic(source, blocks, stress)
    # Density in t/mm³ is stress unit times (time / mm)²; lengths are mm.
    return Deck(
        source,
        name,
        elastic,
        tuple(row[0] for row in terms),
        tuple(row[1] for row in terms),
        tuple(row[2] * time for row in terms),
        density.rows[0][0] * stress * time**2 if density and density.rows else None,
        _shift(source, blocks),
        (*notes, *more),
    )


def _materials(source: str, text: str) -> dict[str, list[_Block]]:
    """Return the blocks of each material."""
    materials: dict[str, list[_Block]] = {}
    current: list[_Block] | None = None
    block: _Block | None = None
    continued = ""
    for place, raw in enumerate(text.splitlines(), 1):
        line = raw.strip()
        if not line or line.startswith("**"):
            continue
        if continued or line.startswith("*"):
            line, continued = continued + line, ""
            if line.endswith(","):
                continued = line
                continue
            keyword, *rest = (part.strip() for part in line[1:].split(","))
            keyword = " ".join(keyword.upper().split())
            options = dict(_option(part) for part in rest if part)
            if keyword == "MATERIAL":
                current = materials.setdefault(options.get("NAME", f"material {len(materials) + 1}"), [])
            elif keyword not in _OPTIONS:
                current = None
            block = _Block(keyword, options, [], place)
            if current is not None and keyword != "MATERIAL":
                current.append(block)
        elif block is not None and current is not None and block.keyword in _MINOR:
            try:
                block.rows.append([_number(word) for word in line.rstrip(",").split(",")])
            except ValueError as error:
                raise InvalidInput(
                    f"{source} has {line[:60]!r} in line {place}, but must have numbers there"
                ) from error
    return materials


def _number(word: str) -> float:
    plain = word.strip().upper().replace("D", "E")
    return float(plain) if plain else 0.0


def _option(part: str) -> tuple[str, str]:
    key, _, value = part.partition("=")
    return " ".join(key.upper().split()), value.strip().strip('"')


def _block(blocks: list[_Block], keyword: str) -> _Block | None:
    return next((each for each in blocks if each.keyword == keyword), None)


def _terms(source: str, blocks: list[_Block]) -> list[list[float]]:
    block = _block(blocks, "VISCOELASTIC")
    assert block is not None
    kind = block.options.get("TIME", "").upper()
    if kind != "PRONY":
        said = ", ".join(f"{key}={value}" if value else key for key, value in block.options.items()) or "no option"
        raise InvalidInput(
            f"{source} has *VISCOELASTIC with {said} in line {block.line}, but only TIME=PRONY is read: let Abaqus fit "
            "its Prony series and take that, or fit moduli with rubfric rubber fit"
        )
    rows = [row + [0.0] * (3 - len(row)) for row in block.rows]
    if not rows:
        raise InvalidInput(f"{source} has no terms below *VISCOELASTIC in line {block.line}")
    if len({row[3] for row in rows if len(row) > 3}) > 1:
        raise InvalidInput(
            f"{source} has Prony terms at several temperatures below line {block.line}: keep those of one, and let "
            "*TRS shift them"
        )
    return rows


def _elastic(source: str, blocks: list[_Block], stress: float) -> tuple[Elastic | None, list[str]]:
    elastic, hyper = _block(blocks, "ELASTIC"), _block(blocks, "HYPERELASTIC")
    block = elastic or hyper
    if block is None:
        return None, []
    if not block.rows:
        raise InvalidInput(f"{source} has no numbers below *{block.keyword} in line {block.line}")
    if len(block.rows) > 1:
        raise InvalidInput(f"{source} has several lines below *{block.keyword} in line {block.line}: keep one")
    row = block.rows[0]
    long_term = "INSTANT" not in block.options.get("MODULI", "LONG TERM").upper()
    if elastic:
        kind = block.options.get("TYPE", "ISOTROPIC").upper()
        if not "ISOTROPIC".startswith(kind[:3]) or len(row) < 2:
            raise InvalidInput(f"{source} has *ELASTIC, TYPE={kind} in line {block.line}, but must be isotropic")
        return Elastic.from_young(row[0] * stress, row[1], long_term), []
    neo, mooney = "NEO HOOKE" in block.options, "MOONEY-RIVLIN" in block.options
    if not (neo or mooney):
        said = ", ".join(block.options) or "no option"
        raise InvalidInput(
            f"{source} has *HYPERELASTIC with {said} in line {block.line}, but the model has the initial moduli of NEO "
            "HOOKE and MOONEY-RIVLIN only: give one of these, or *ELASTIC"
        )
    count = 1 if neo else 2
    row = row + [0.0] * (count + 1 - len(row))
    note = ["the finite-strain law is this program's own: of *HYPERELASTIC the initial moduli are taken"]
    shear, compressibility = 2.0 * sum(row[:count]) * stress, row[count] / stress
    return Elastic(shear, 2.0 / compressibility if compressibility else math.inf, long_term), note


def _shift(source: str, blocks: list[_Block]) -> Shift | None:
    block = _block(blocks, "TRS")
    if block is None:
        return None
    kind = block.options.get("DEFINITION", "WLF").upper()
    if kind == "WLF" and block.rows and len(block.rows[0]) >= 3:
        reference, c1, c2 = block.rows[0][:3]
        return Shift("wlf", reference, c1=c1, c2=c2)
    if kind == "ARRHENIUS":
        raise InvalidInput(
            f"{source} has *TRS, DEFINITION=ARRHENIUS in line {block.line}, whose gas constant is elsewhere in the "
            "deck: give the shift by hand"
        )
    raise InvalidInput(f"{source} has *TRS, DEFINITION={kind} in line {block.line}, but only WLF is read")


def write(rubber: Material | ShiftedRubber) -> str:
    """Return a rubber as an Abaqus material, in MPa, mm and s.

    Parameters
    ----------
    rubber : Material or ShiftedRubber
        With WLF shifts as *TRS; other shifts are refused.

    Raises
    ------
    InvalidInput
        For shift factors that this deck cannot have.
    """
    material = rubber.material if isinstance(rubber, ShiftedRubber) else rubber
    kind = "LONG TERM" if material.moduli == "long_term" else "INSTANTANEOUS"
    proportional = material.bulk == "proportional"
    lines = [
        f"** {UNITS}",
        f"*MATERIAL, NAME={material.name}",
        *("*DENSITY", f"{number(material.density)},"),
        f"*ELASTIC, MODULI={kind}",
        f"{number(material.youngs_modulus)}, {number(material.poissons_ratio)}",
    ]
    if material.shear_fractions:
        lines.append("*VISCOELASTIC, TIME=PRONY")
    for share, time in zip(material.shear_fractions, material.relaxation_times, strict=True):
        lines.append(f"{number(share)}, {number(share if proportional else 0.0)}, {number(time)}")
    if isinstance(rubber, ShiftedRubber):
        shift = rubber.shift
        if shift.law != "wlf" or shift.vertical != "none":
            raise InvalidInput(
                f"shift factors of law {shift.law} with vertical {shift.vertical} cannot be written to an Abaqus deck, "
                "which has those of WLF without vertical shifts"
            )
        lines += ["*TRS, DEFINITION=WLF"]
        lines += [f"{number(shift.reference_temperature)}, {number(shift.c1 or 0.0)}, {number(shift.c2 or 0.0)}"]
    return "\n".join(lines) + "\n"
