"""Headlines of the tables of a campaign: largest friction, largest error, warnings, refusals, verdicts."""

from __future__ import annotations

import csv
import os
from collections.abc import Iterable

from rubfric.checksums import check_signature
from rubfric.results.comparison import headlines
from rubfric.results.limits import WHOLE
from rubfric.results.selection import RUBBER_ERROR, WARNINGS, WINDOWS

# How a total was obtained, in words.
WAYS = {
    "direct": "all scales at once",
    "sum": "sum over the scales",
    "corrected": "sum, corrected for the coupling",
    "cascade": "cascade from scale to scale",
    "persson": "Persson's theory",
}
_MOST_NAMED, _FEW = 5, 2


def findings(tables: Iterable[str | os.PathLike[str]]) -> list[str]:
    """Return sentences on the largest error of scales and of the whole road, on warnings, refusals, and who grips more.

    Parameters
    ----------
    tables : iterable of path-like
        Tables of single scales, as from ``results.tables.scale_table``, and of totals, as from
        ``results.totals.total_table``, of peaks, and rankings of ``results.comparison``; missing ones are skipped.
    """
    found = list(tables)
    totals = (line for path in found for line in _of_totals(path))
    peaks = (line for path in found for line in _of_peaks(path))
    return [*_of_scales(found), *totals, *peaks, *(line for path in found for line in _ranked(path))]


def _of_scales(tables: Iterable[str | os.PathLike[str]]) -> list[str]:
    scenes, worst, where, data = 0, -1.0, "", -1.0
    warned: list[tuple[str, dict[str, str]]] = []
    for path in tables:
        for row in _rows(path, "friction_coefficient_error", WARNINGS):
            friction, error = float(row["friction_coefficient"]), float(row["friction_coefficient_error"])
            scenes += 1
            if int(row[WARNINGS]):
                warned.append((_scale(path), row))
            if friction and error / abs(friction) > worst:
                worst, where = error / abs(friction), _place(path, row)
            if friction and row.get(RUBBER_ERROR):
                data = max(data, float(row[RUBBER_ERROR]) / abs(friction))
    if not scenes:
        return []
    carry = f"{len(warned)} of {scenes} scenes carry a warning: {_named(warned)}; the words are in the scenes' logs"
    return [
        *([f"largest estimated error of friction {_percent(worst)}, {where}"] if where else []),
        *([f"beside that at most {_percent(data)} from the data of the rubber"] if data >= 0.0 else []),
        carry if warned else f"none of {scenes} scenes carries a warning",
    ]


def _of_totals(path: str | os.PathLike[str]) -> list[str]:
    rows = _rows(path, "friction_total", "friction_total_error", "refused")
    known = [row for row in rows if float(row["friction_total"])]
    lines = []
    if known:
        worst = max(known, key=lambda row: float(row["friction_total_error"]) / abs(float(row["friction_total"])))
        share = float(worst["friction_total_error"]) / abs(float(worst["friction_total"]))
        lines.append(f"largest error of the whole road's friction {_percent(share)}, {_way(worst)}, {_point(worst)}")
    refused = [row for row in rows if int(row["refused"])]
    if refused:
        named = "; ".join(_point(row).removeprefix("at ") for row in refused[:_MOST_NAMED])
        more = f"; and {len(refused) - _MOST_NAMED} more" if len(refused) > _MOST_NAMED else ""
        lines.append(
            f"scenes of the whole road were refused at {len(refused)} of {len(rows)} points: {named}{more}; why is in "
            f"{os.fspath(path)}, column note"
        )
    warned = [("the whole road", row) for row in rows if int(row.get(WARNINGS) or 0)]
    if warned:
        lines.append(f"friction of {_named(warned)} rests on scenes that carry a warning")
    return lines


def _named(warned: Iterable[tuple[str, dict[str, str]]]) -> str:
    """Return in words where there are warnings, given each scale with a row of its table; speed by speed."""
    groups: dict[str, dict[float, None]] = {}
    for scale, row in warned:
        speed = f"{scale} at {float(row['velocity_mm_per_s']):g} mm/s{_warm(row)}"
        groups.setdefault(speed, {})[float(row["pressure_MPa"])] = None
    named = [f"{speed}, {_pressures(sorted(of))}" for speed, of in groups.items()]
    more = [f"and at {len(named) - _MOST_NAMED} more speeds"] if len(named) > _MOST_NAMED else []
    return "; ".join([*named[:_MOST_NAMED], *more])


def _pressures(pressures: list[float]) -> str:
    if len(pressures) > _FEW:
        return f"{len(pressures)} pressures from {pressures[0]:g} to {pressures[-1]:g} MPa"
    return f"{' and '.join(f'{pressure:g}' for pressure in pressures)} MPa"


def _of_peaks(path: str | os.PathLike[str]) -> list[str]:
    """Return the highest peak of the whole road's friction, from the table of peaks, where speeds were added to it."""
    rows = [row for row in _rows(path, "peak_friction", "added") if row["curve"] == WHOLE and int(row["added"])]
    if not rows:
        return []
    top = max(rows, key=lambda row: float(row["peak_friction"]))
    speed, low, high = (float(top[f"peak_speed_{name}mm_per_s"]) for name in ("", "low_", "high_"))
    friction = f"{float(top['peak_friction']):.3g} ± {float(top['peak_friction_error']):.1g}"
    where = f"at {speed:.3g} mm/s (between {low:.3g} and {high:.3g}) and {float(top['pressure_MPa']):g} MPa{_warm(top)}"
    return [f"largest friction of the whole road over all speeds {friction}, {where}"]


def _percent(share: float) -> str:
    return f"{100.0 * share:.{2 if share < 0.995 else 3}g} %"


def _way(row: dict[str, str]) -> str:
    """Return in words how a total was obtained."""
    profile = row["way"] == "direct" and WINDOWS in row.get("note", "")
    return "the measured profile itself" if profile else WAYS[row["way"]]


def _ranked(path: str | os.PathLike[str]) -> list[str]:
    """Return how often which of two rubbers, or roads, grips more; of many comparisons the first."""
    lines = headlines(_rows(path, "compared", "verdict"))
    more = len(lines) - _MOST_NAMED
    return [*lines[:_MOST_NAMED], *([f"and {more} more comparisons in {os.fspath(path)}"] if more > 0 else [])]


def told_apart(path: str | os.PathLike[str]) -> str:
    """Return the first comparison of a ranking in words, and how many more there are; empty for a missing table."""
    lines = headlines(_rows(path, "compared", "verdict"))
    return "; ".join([*lines[:1], *([f"{len(lines) - 1} more"] if len(lines) > 1 else [])])


def _point(row: dict[str, str]) -> str:
    return f"at {float(row['velocity_mm_per_s']):g} mm/s, {float(row['pressure_MPa']):g} MPa{_warm(row)}"


def _warm(row: dict[str, str]) -> str:
    """Return the temperature of a row in words; nothing where there is none."""
    return f", {float(row['temperature_degC']):g} degC" if row.get("temperature_degC") else ""


def _rows(path: str | os.PathLike[str], *columns: str) -> list[dict[str, str]]:
    """Return the rows of a table in which none of these columns is empty; none where it is damaged or lacks them."""
    try:
        check_signature(path, required=False)
        with open(path, encoding="utf-8", newline="") as stream:
            return [row for row in csv.DictReader(stream) if all(row.get(column) for column in columns)]
    except OSError:
        return []


def _place(path: str | os.PathLike[str], row: dict[str, str]) -> str:
    height = f"height/width {row['aspect']}"
    return f"on {_scale(path)} at {row['velocity_mm_per_s']} mm/s, {row['pressure_MPa']} MPa{_warm(row)}, {height}"


def _scale(path: str | os.PathLike[str]) -> str:
    """Return in words the scale of a table of one scale, given its path."""
    return f"scale {os.path.splitext(os.path.basename(path))[0].rpartition('_')[2]}"


def highest(path: str | os.PathLike[str]) -> str:
    """Return in words the largest friction in the table of totals, where and of what; empty for a missing table."""
    rows = _rows(path, "friction_total", "way")
    if not rows:
        return ""
    top = max(rows, key=lambda row: float(row["friction_total"]))
    friction, error = float(top["friction_total"]), float(top["friction_total_error"] or "nan")
    return (
        f"at most {friction:.3g} ± {error:.1g}, at {float(top['velocity_mm_per_s']):g} mm/s "
        f"and {float(top['pressure_MPa']):g} MPa{_warm(top)} ({_way(top)})"
    )


def verdicts(path: str | os.PathLike[str]) -> str:
    """Return in words how many of the paper's claims hold, from their table; empty for a missing table."""
    rows = _rows(path, "verdict")
    # The campaign itself comes first; its verdicts over all pressures are those of the claims.
    found = [row["verdict"] for row in rows if (row["reading"], row["pressure_MPa"]) == (rows[0]["reading"], "all")]
    counts = {word: found.count(word) for word in dict.fromkeys(sorted(found))}
    return "; ".join(f"{word}: {count} of {len(found)}" for word, count in counts.items())


def carrying(path: str | os.PathLike[str]) -> str:
    """Return in words which waves carry friction, from the table of a measured road; empty for a missing table."""
    if not _rows(path, "cutoff_mm"):
        return ""
    from rubfric.results.carriers import carriers  # heavy: only once there is a table
    from rubfric.results.tables import read_table

    return carriers(read_table(path, ["way", "note"]))
