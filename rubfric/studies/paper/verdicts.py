"""Which of the paper's claims hold: verdicts counted from the evidence, overall and pressure by pressure."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import pandas as pd

from rubfric.config.models import AS_CONFIGURED
from rubfric.studies.paper.claims import CLAIMS, Evidence

HOLDS, IN_PART, FAILS, UNDECIDED = "holds", "holds in part", "does not hold", "not decided"
EVERY = "all"
# The claim whose parts are ways to the same quantity.
_SAME = "C7"
# What a verdict ends with where it rests on a simulated measurement.
SIMULATED = " (simulated)"

_PLACES = {"scale": "scale", "pressure": "pressure_MPa", "velocity": "velocity_mm_per_s"}
COLUMNS = (
    *("claim", "figure", "says", "reading", "pressure_MPa", "verdict", "yes", "no", "open", "parts"),
    *("deciding_quantity", "value", "error", "limit", "where", "note"),
)


def evidence_table(evidence: Mapping[str, Sequence[Evidence]]) -> pd.DataFrame:
    """Return all evidence as a table, one row for each number.

    Parameters
    ----------
    evidence : mapping of str to sequence of Evidence
        By the name of the reading.
    """
    rows = [
        {
            "claim": one.claim,
            "part": one.part,
            "reading": reading,
            **{heading: getattr(one, name) for name, heading in _PLACES.items()},
            "quantity": CLAIMS[one.claim].parts[one.part],
            "value": one.value,
            "error": one.error,
            "sense": one.sense,
            "limit": one.limit,
            "outcome": one.outcome,
        }
        for reading, found in evidence.items()
        for one in found
    ]
    return pd.DataFrame(rows)


def claims_table(
    evidence: Mapping[str, Sequence[Evidence]], total_pressure: float, notes: Mapping[str, Mapping[str, str]]
) -> pd.DataFrame:
    """Return the verdict on each claim, in each reading, over all pressures and at each of them.

    A claim *holds* where every number that can be decided supports it, and more than half can be; it *does not hold*
    where none does, and else *holds in part*; ``not decided`` where there is no number, or none beyond its error. A
    part without any number, such as a maximum over two speeds, leaves a claim to hold in part at most; of C7 the parts
    are two ways to the same total.

    Parameters
    ----------
    evidence : mapping of str to sequence of Evidence
        By the name of the reading.
    total_pressure : float
        MPa; the pressure at which C7 is claimed, so that its verdict over all pressures is the one there.
    notes : mapping
        By reading and claim: what a reader should know of that verdict.

    Returns
    -------
    pandas.DataFrame
        Columns ``COLUMNS``. ``parts`` counts part by part; the deciding quantity is the number that is farthest on
        the wrong side of its limit, else the one that is undecided, or the one nearest to it where the claim holds.
    """
    rows = []
    for reading, found in evidence.items():
        for name in CLAIMS:
            own = [one for one in found if one.claim == name]
            note = notes.get(reading, {}).get(name, "")
            main = [one for one in own if name != "C7" or one.pressure == total_pressure]
            if own or reading == AS_CONFIGURED or note:
                rows.append(_row(name, reading, EVERY, main, note))
            pressures = sorted({one.pressure for one in own if one.pressure is not None})
            rows += [
                _row(name, reading, pressure, [one for one in own if one.pressure == pressure], "")
                for pressure in pressures
            ]
    return pd.DataFrame(rows, columns=list(COLUMNS))


def _row(name: str, reading: str, pressure: float | str, evidence: Sequence[Evidence], note: str) -> dict[str, object]:
    claim = CLAIMS[name]
    simulated = SIMULATED if any(one.simulated for one in evidence) else ""
    found = verdict([one.outcome for one in evidence])
    missing = set(claim.parts) - {one.part for one in evidence}
    if found == HOLDS and pressure == EVERY and missing and name != _SAME:
        found = IN_PART
        parts = ", ".join(part for part in claim.parts if part in missing)
        note = f"{note} Nothing that was run decides: {parts}.".strip()
    row: dict[str, object] = {
        **{"claim": name, "figure": claim.figure, "says": claim.says, "reading": reading, "pressure_MPa": pressure},
        "verdict": found + simulated,
        **{word: sum(one.outcome == word for one in evidence) for word in ("yes", "no", "open")},
        "parts": _parts(name, evidence),
        "note": note,
    }
    if evidence:
        worst = _deciding(evidence)
        row |= {
            "deciding_quantity": claim.parts[worst.part],
            "value": worst.value,
            "error": worst.error,
            "limit": f"{worst.sense} {worst.limit:g}",
            "where": place(worst),
        }
    return row


def _deciding(evidence: Sequence[Evidence]) -> Evidence:
    """Return the number that keeps a claim from holding, or comes nearest to it."""
    by_outcome = {word: [one for one in evidence if one.outcome == word] for word in ("no", "open", "yes")}
    holds = verdict([one.outcome for one in evidence]) == HOLDS
    kept = by_outcome["yes"] if holds else next(found for found in by_outcome.values() if found)
    return min(kept, key=lambda one: one.margin)


def verdict(outcomes: Sequence[str]) -> str:
    """Return the verdict on a claim from the outcomes of its evidence."""
    if not {"yes", "no"} & set(outcomes):
        return UNDECIDED
    if "yes" not in outcomes:
        return FAILS
    return HOLDS if "no" not in outcomes and 2 * outcomes.count("yes") > len(outcomes) else IN_PART


def place(evidence: Evidence) -> str:
    """Return in words where a number was found."""
    words = (
        None if evidence.scale is None else f"scale {evidence.scale}",
        None if evidence.velocity is None else f"{evidence.velocity:g} mm/s",
        None if evidence.pressure is None else f"{evidence.pressure:g} MPa",
    )
    return ", ".join(word for word in words if word)


def _parts(name: str, evidence: Sequence[Evidence]) -> str:
    counted = []
    for part in CLAIMS[name].parts:
        outcomes = [one.outcome for one in evidence if one.part == part]
        decided = len(outcomes) - outcomes.count("open")
        if outcomes:
            still = f" ({outcomes.count('open')} more undecided)" if "open" in outcomes else ""
            counted.append(f"{part}: {outcomes.count('yes')} of {decided}{still}")
    return "; ".join(counted)
