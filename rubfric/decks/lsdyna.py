"""LS-DYNA: *MAT_GENERAL_VISCOELASTIC (*MAT_076), with moduli G_i and rates beta_i = 1 / tau_i."""

from __future__ import annotations

from rubfric.decks.deck import UNITS, Deck, Elastic, chosen, instantaneous, number, unshifted
from rubfric.errors import InvalidInput
from rubfric.rubber.material import Material
from rubfric.rubber.shift import ShiftedRubber

_NAMES = ("*MAT_GENERAL_VISCOELASTIC", "*MAT_076")
# Terms that the card holds.
_MOST = 18
_FIELD, _LONG = 10, 20


def read(source: str, text: str, material: str | None, stress: float, time: float) -> Deck:
    """Read a material of an LS-DYNA deck.

    Parameters
    ----------
    source, text : str
        The file's name and content.
    material : str, optional
        The material's number, where the deck has several.
    stress, time : float
        The deck's units, MPa and s.

    Raises
    ------
    InvalidInput
        For a deck without such a material, or one that the model has not.
    """
    found = _cards(source, text)
    if not found:
        raise InvalidInput(f"{source} has no *MAT_GENERAL_VISCOELASTIC")
    name = chosen(source, found, material)
    cards = [card + [0.0] * (8 - len(card)) for card in found[name]]
    if len(cards) < 3:
        raise InvalidInput(f"{source} has {len(cards)} cards of material {name}, but must have two and its terms")
    _, density, bulk, _, flag, reference, *law = cards[0]
    notes = []
    if cards[1][0] or cards[1][4]:
        raise InvalidInput(
            f"{source} has material {name} as a relaxation curve (LCID), but must have terms G_i, beta_i"
        )
    if flag:
        notes.append(f"EF = {flag:g}, an elastic layer, is not read")
    if reference or any(law):
        notes.append("TREF, A and B, the shift function, are not read")
    rest_shear = rest_bulk = 0.0
    terms: list[tuple[float, float, float]] = []
    for shear, beta, relaxing, beta_bulk, *_ in cards[2:]:
        if shear and relaxing and beta != beta_bulk:
            raise InvalidInput(
                f"{source} has bulk terms at other rates than shear terms in material {name} ({beta_bulk:g} and "
                f"{beta:g}), but here the bulk modulus is constant or relaxes as the shear modulus does"
            )
        rate = beta if shear else beta_bulk
        if rate == 0.0:
            rest_shear, rest_bulk = rest_shear + shear, rest_bulk + relaxing
        elif shear or relaxing:
            terms.append((shear, relaxing, 1.0 / rate))
    if not rest_shear > 0.0:
        raise InvalidInput(
            f"{source} has no term with beta = 0 in material {name}, so that it would carry no load at rest: add its "
            "shear modulus at rest as such a term"
        )
    relaxes = any(each[1] for each in terms)
    if relaxes and not rest_bulk:
        raise InvalidInput(f"{source} has bulk terms in material {name}, but none with beta = 0: add that at rest")
    still = rest_bulk if relaxes else bulk + rest_bulk
    total, whole = rest_shear + sum(each[0] for each in terms), still + sum(each[1] for each in terms)
    if not whole > 0.0:
        raise InvalidInput(f"{source} has no bulk modulus in material {name}: give BULK")
    return Deck(
        source,
        name,
        Elastic(rest_shear * stress, still * stress, long_term=True),
        tuple(each[0] / total for each in terms),
        tuple(each[1] / whole for each in terms),
        tuple(each[2] * time for each in terms),
        density * stress * time**2 or None,
        None,
        tuple(notes),
    )


def _cards(source: str, text: str) -> dict[str, list[list[float]]]:
    """Return the cards of each material, by its number."""
    found: dict[str, list[list[float]]] = {}
    own: list[list[float]] | None = None
    width, title, everywhere = _FIELD, False, False
    for place, line in enumerate(text.splitlines(), 1):
        if line.startswith("$") or not line.strip():
            continue
        if line.startswith("*"):
            keyword = line.strip().upper()
            everywhere |= keyword.startswith("*KEYWORD") and "LONG=" in keyword
            bare = keyword.rstrip("+- ")
            own = [] if bare.removesuffix("_TITLE") in _NAMES else None
            width = _LONG if (everywhere or keyword.endswith("+")) and not keyword.endswith("-") else _FIELD
            title = bare.endswith("_TITLE")
        elif own is not None and title:
            title = False
        elif own is not None:
            words = line.split(",") if "," in line else [line[at : at + width] for at in range(0, len(line), width)]
            try:
                own.append([float(word.strip().upper().replace("D", "E") or 0.0) for word in words])
            except ValueError as error:
                shown = line.strip()[:60]
                raise InvalidInput(f"{source} has {shown!r} in line {place}, but must have numbers there") from error
            if len(own) == 1:
                found[f"{own[0][0]:.0f}"] = own
    return found


def write(rubber: Material | ShiftedRubber) -> str:
    """Return a rubber as an LS-DYNA material, in MPa, mm and s, in the long format of 20 columns a number.

    Parameters
    ----------
    rubber : Material or ShiftedRubber
        Shift factors are refused.

    Raises
    ------
    InvalidInput
        For shift factors, and for more than 18 terms.
    """
    rubber = unshifted(rubber, "LS-DYNA")
    if len(rubber.relaxation_times) + 1 > _MOST:
        raise InvalidInput(
            f"{rubber.name} has {len(rubber.relaxation_times)} branches and a static modulus, but "
            f"*MAT_GENERAL_VISCOELASTIC holds {_MOST} terms"
        )
    relaxes = rubber.bulk == "proportional"
    still = rubber.long_term_bulk_modulus
    terms = [(rubber.long_term_shear_modulus, 0.0, still if relaxes else 0.0)]
    terms += [
        (float(shear), 1.0 / time, float(bulk))
        for shear, bulk, time in zip(
            rubber.branch_shear_moduli, rubber.branch_bulk_moduli, rubber.relaxation_times, strict=True
        )
    ]
    # Where the bulk modulus relaxes, BULK serves the time step alone.
    _, bulk = instantaneous(rubber)
    lines = [
        f"$ {UNITS}",
        *("*MAT_GENERAL_VISCOELASTIC_TITLE +", rubber.name),
        _card("1", number(rubber.density, 13), number(bulk, 13)),
        _card("0", "0"),
        *(_card(*(number(each, 13) for each in (shear, beta, k, beta))) for shear, beta, k in terms),
    ]
    return "\n".join(lines) + "\n"


def _card(*words: str) -> str:
    return "".join(word.rjust(_LONG) for word in words)
