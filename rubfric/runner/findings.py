"""Headlines of the tables of a campaign: largest friction, largest error, number of warnings, verdicts."""

from __future__ import annotations

import csv
import os
from collections.abc import Iterable


def findings(tables: Iterable[str | os.PathLike[str]]) -> list[str]:
    """Return a sentence on the largest error and one on warnings; none without scenes.

    Parameters
    ----------
    tables : iterable of path-like
        Tables of single scales, as from ``results.tables.scale_table``; missing ones are skipped.
    """
    scenes, warned, worst, where = 0, 0, -1.0, ""
    for path in tables:
        for row in _rows(path, "friction_coefficient_error", "warnings"):
            friction, error = float(row["friction_coefficient"]), float(row["friction_coefficient_error"])
            scenes += 1
            warned += int(row["warnings"]) > 0
            if friction and error / abs(friction) > worst:
                worst, where = error / abs(friction), _place(path, row)
    if not scenes:
        return []
    carry = f"{warned} of {scenes} scenes carry a warning: column warnings of the tables, and the scenes' logs"
    return [
        *([f"largest estimated error of friction {100.0 * worst:.2g} %, {where}"] if where else []),
        carry if warned else f"none of {scenes} scenes carries a warning",
    ]


def _rows(path: str | os.PathLike[str], *columns: str) -> list[dict[str, str]]:
    """Return the rows of a table in which none of these columns is empty; no row where it is missing or lacks them."""
    try:
        with open(path, encoding="utf-8", newline="") as stream:
            return [row for row in csv.DictReader(stream) if all(row.get(column) for column in columns)]
    except OSError:
        return []


def _place(path: str | os.PathLike[str], row: dict[str, str]) -> str:
    scale = os.path.splitext(os.path.basename(path))[0].rpartition("_")[2]
    height = f"height/width {row['aspect']}"
    return f"on scale {scale} at {row['velocity_mm_per_s']} mm/s, {row['pressure_MPa']} MPa, {height}"


def highest(path: str | os.PathLike[str]) -> str:
    """Return in words the largest friction in the table of all scales and where it is; empty for a missing table."""
    rows = _rows(path, "friction_total")
    if not rows:
        return ""
    top = max(rows, key=lambda row: float(row["friction_total"]))
    friction, error = float(top["friction_total"]), float(top["friction_total_error"] or "nan")
    return (
        f"at most {friction:.3g} ± {error:.1g}, at {float(top['velocity_mm_per_s']):g} mm/s "
        f"and {float(top['pressure_MPa']):g} MPa"
    )


def verdicts(path: str | os.PathLike[str]) -> str:
    """Return in words how many of the paper's claims hold, from their table; empty for a missing table."""
    rows = _rows(path, "verdict")
    # The campaign itself comes first; its verdicts over all pressures are those of the claims.
    found = [row["verdict"] for row in rows if (row["reading"], row["pressure_MPa"]) == (rows[0]["reading"], "all")]
    counts = {word: found.count(word) for word in dict.fromkeys(sorted(found))}
    return "; ".join(f"{word}: {count} of {len(found)}" for word, count in counts.items())
