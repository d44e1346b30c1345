"""The outcome of some runs in words, for the terminal."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from rubfric.rig.record import SIMULATED
from rubfric.rig.reduction import Reduced

# Points that are printed; the table has them all.
_MOST = 40


def summary(runs: Sequence[Reduced]) -> str:
    """Return points, rejected windows by reason, and notes."""
    count, lost = (sum(len(getattr(run, name)) for run in runs) for name in ("points", "rejected"))
    simulated = any(run.source == SIMULATED for run in runs)
    lines = [f"{count} points, {lost} windows rejected{' (simulated runs)' if simulated else ''}", ""]
    if count:
        lines.append("   speed (mm/s)             pressure (MPa)           friction coefficient     run")
    rows = [_row(run.name, point) for run in runs for point in run.points]
    lines += rows[:_MOST] + ([f"... and {count - _MOST} more"] if count > _MOST else [])
    reasons = Counter(_kind(window.reason) for run in runs for window in run.rejected)
    if reasons:
        lines += ["", "Rejected:", *(f"{number:6d}  {reason}" for reason, number in reasons.most_common())]
    notes = [f"{run.name}: {note}" for run in runs for note in run.notes if run.source != SIMULATED or len(runs) == 1]
    if notes:
        lines += ["", "Notes:", *(f"  {note}" for note in notes)]
    return "\n".join(lines)


def _row(name: str, point: object) -> str:
    cells = [
        f"{getattr(point, quantity):.5g} +- {getattr(point, f'{quantity}_ci95'):.2g}"
        for quantity in ("speed", "pressure", "friction_coefficient")
    ]
    return "   " + "".join(f"{cell:<25}" for cell in cells) + name


def _kind(reason: str) -> str:
    """Return what a reason has in common with others: all but its numbers, which the table has."""
    words = reason.split()
    return " ".join("..." if _starts_numeric(word) else word for word in words)


def _starts_numeric(word: str) -> bool:
    return word[:1].isdigit() or word[:2].lstrip("-").isdigit()
