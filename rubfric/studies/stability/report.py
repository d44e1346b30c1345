"""The matrix of stability as a table and in words: the outcome of every case, and the limits of friction."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd

from rubfric.markdown import markdown_table
from rubfric.studies.stability.cases import LIMIT_SPEEDS, PANELS, Case
from rubfric.studies.stability.trial import MOST_MEMORY, MOST_SECONDS, MOST_SECONDS_MANY, OUTCOMES, Trial

# Parameter: heading.
HEADINGS = {
    "panel": "panel",
    "motion": "motion",
    "plane": "plane",
    "kinematics": "kinematics",
    "velocity": "velocity_mm_per_s",
    "pressure": "pressure_MPa",
    "aspect": "aspect",
    "waves": "waves",
    "slope": "slope",
    "wavelength": "wavelength_mm",
    "poissons_ratio": "poissons_ratio",
    "branches": "branches",
    "long_term_fraction": "relaxed_share",
    "slowest": "longest_relaxation_time_s",
    "decades": "decades",
    "moduli": "moduli",
}
# Friction follows v or 1 / v to this over three decades of speed.
_TOLERANCE = 0.05


def row(case: Case, trial: Trial) -> dict[str, Any]:
    """Return the row of the table for a case.

    Parameters
    ----------
    case : Case
    trial : Trial
        How it ended.

    Returns
    -------
    dict
        By column; speed in mm/s, pressure in MPa, lengths in mm, times in s, memory in MiB.
    """
    given = case.parameters()
    power, lost, contact = trial.friction
    return (
        {"case": case.name}
        | {heading: given[name] for name, heading in HEADINGS.items()}
        | {
            "outcome": trial.outcome,
            "bounds": {"converged": "kept", "refused": "no result", "failed": "broken"}[trial.outcome],
            "friction_coefficient": power,
            "friction_coefficient_second": lost,
            "friction_coefficient_contact": contact,
            "friction_resolution": trial.resolution,
            "energy_closure": trial.closure,
            "cpu_s": trial.seconds,
            "peak_memory_MiB": trial.memory,
            "reason": trial.reason,
        }
    )


@dataclass(frozen=True)
class Limit:
    """How friction follows the speed between two speeds three decades apart.

    Attributes
    ----------
    plane, kinematics : str
    pressure : float
        MPa.
    end : {"slow", "fast"}
        Far slower than the slowest branch, or far faster than the fastest one.
    error : float
        Ratio of the two friction coefficients over that of v or 1 / v, less one; NaN where one is missing.
    """

    plane: str
    kinematics: str
    pressure: float
    end: str
    error: float

    @property
    def kept(self) -> bool:
        """Whether friction follows v or 1 / v."""
        return bool(abs(self.error) <= _TOLERANCE)


def limits(table: pd.DataFrame) -> list[Limit]:
    """Return how friction vanishes at both ends of the speeds in the panel ``limits``.

    Dissipation is compared: a sum of terms that are never negative, good to round-off however small.
    """
    chosen = table[table["panel"] == "limits"]
    found = []
    for (plane, kinematics, pressure), part in chosen.groupby(["plane", "kinematics", "pressure_MPa"], sort=True):
        friction = part.set_index("velocity_mm_per_s")["friction_coefficient_second"].reindex(LIMIT_SPEEDS)
        for end, (first, second), power in (("slow", LIMIT_SPEEDS[:2], 1.0), ("fast", LIMIT_SPEEDS[-2:], -1.0)):
            error = friction[second] / friction[first] / (second / first) ** power - 1.0
            found.append(Limit(str(plane), str(kinematics), float(pressure), end, float(error)))
    return found


def counts(table: pd.DataFrame) -> pd.DataFrame:
    """Return the number of cases with each outcome, and the largest closure, time and memory; one row per panel."""
    rows = []
    for panel, words in PANELS.items():
        part = table[table["panel"] == panel]
        ended = part["outcome"].value_counts()
        rows.append(
            {"panel": words, "cases": len(part)}
            | {outcome: int(ended.get(outcome, 0)) for outcome in OUTCOMES}
            | {
                "closure": part.loc[part["outcome"] == "converged", "energy_closure"].max(),
                "seconds": part["cpu_s"].max(),
                "memory": part["peak_memory_MiB"].max(),
            }
        )
    return pd.DataFrame(rows)


def summary(table: pd.DataFrame) -> list[tuple[str, ...]]:
    """Return the rows of the short table, headings first: as on the page."""
    rows: list[tuple[str, ...]] = [("", "cases", *OUTCOMES, "largest closure", "slowest", "most memory")]
    found = counts(table)
    for entry in found.to_dict("records"):
        rows.append(_line(str(entry["panel"]), entry))
    total = {name: found[name].sum() for name in ("cases", *OUTCOMES)}
    total |= {name: found[name].max() for name in ("closure", "seconds", "memory")}
    return [*rows, _line("all", total)]


def _line(words: str, entry: dict[Any, Any]) -> tuple[str, ...]:
    numbers = (str(int(entry[name])) for name in ("cases", *OUTCOMES))
    closure = "-" if np.isnan(entry["closure"]) else f"{entry['closure']:.1%}"
    return (words, *numbers, closure, f"{entry['seconds']:.1f} s", f"{entry['memory']:.0f} MiB")


def page(table: pd.DataFrame) -> str:
    """Return the page on numerical stability, as Markdown."""
    failed, refused = (table[table["outcome"] == outcome] for outcome in ("failed", "refused"))
    followed = limits(table)
    wrong = [limit for limit in followed if not limit.kept]
    remarked = table[(table["outcome"] == "converged") & (table["reason"].fillna("") != "")]
    lines = [
        "# Numerical stability at the extremes",
        "",
        f"{len(table)} cases, each in its own process with at most {MOST_SECONDS} s of processor time, "
        f"{MOST_SECONDS_MANY} s on roads of many waves, and {MOST_MEMORY} MiB, floating-point errors and warnings "
        "counting as failures. A case converges and keeps every bound (friction, contact pressure, gap, energy and "
        "dissipation not negative; friction below the steepest slope; contact forces that carry the load; the three "
        "routes to friction in agreement), or it is refused with a reason, or it fails.",
        "",
        markdown_table(summary(table), numeric=True),
        "",
        f"{len(remarked)} of the converged results carry a caution, which the column `reason` of the table holds.",
        "",
        "## Failed",
        "",
        *(
            [f"- `{case}`: {reason}" for case, reason in zip(failed["case"], failed["reason"], strict=True)]
            or ["None."]
        ),
        "",
        "## Refused, and why",
        "",
        *(f"- {count} x {reason}" for reason, count in _kinds(refused["reason"]).items()),
        "",
        "## Limits",
        "",
        "One branch, slid far slower and far faster than it relaxes: friction follows v and 1/v over three decades.",
        "",
        markdown_table([("", "plane", "kinematics", "pressure", "off by"), *map(_followed, followed)], numeric=True),
        "",
        "All are kept." if not wrong else f"{len(wrong)} are not kept.",
    ]
    return "\n".join(lines) + "\n"


def _followed(limit: Limit) -> tuple[str, ...]:
    off = "no result" if np.isnan(limit.error) else f"{limit.error:+.2%}"
    return (limit.end, limit.plane, limit.kinematics, f"{limit.pressure:g} MPa", off)


def _kinds(reasons: Iterable[str]) -> dict[str, int]:
    """Count reasons by their kind: the sentence without the scene and its numbers."""
    kinds = pd.Series([_kind(reason) for reason in reasons], dtype=object).value_counts()
    return {str(kind): int(count) for kind, count in kinds.items()}


def _kind(reason: str) -> str:
    words = [word for word in reason.split() if not word.startswith("scale")]
    return " ".join("#" if word[0].isdigit() or word.strip(":,;)") in ("inf", "nan") else word for word in words)
