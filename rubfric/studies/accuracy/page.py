"""The page on accuracy against cost, in words and tables: Markdown, all of it from what was measured."""

from __future__ import annotations

import pandas as pd

from rubfric.markdown import markdown_table
from rubfric.studies.accuracy.calibration import COVERAGE, EXCESS, coverage_table
from rubfric.studies.accuracy.presets import knob_table, start_table
from rubfric.studies.accuracy.ways import DIRECT, KNOB

# Entry of a table without a number.
_NOTHING = "-"
# Knob: what it is, and what its rungs mean.
_KNOBS = {
    "mesh": "The whole mesh at once: nodes in contact, columns and rows, by its fineness (1: 64 nodes in contact in "
    "small strain, 32 in finite strain, rows that grow by 10 %).",
    "surface": "Columns and nodes in contact alone, by the same fineness; the rows stay.",
    "rows": "Growth of the rows away from the road alone.",
    "first_row": "Height of the row at the road, over the width of a column.",
    "element": "In plane strain, dilatation point by point or by its mean over each cell (the default).",
    "kinematics": "Small strain, finite strain, or what the program chooses at an accuracy of 1 %.",
    "folding": "Share of the accuracy that leaving out Prony branches may use; 0 keeps all of them.",
    "tolerance": "Distance from balance at which Newton's method stops, in finite strain.",
    "steps": "Marched in time from steady sliding: steps per wavelength, on a mesh of fineness 0.5.",
    "wavelengths": "Pressed and slid in time, 32 steps per wavelength: wavelengths slid.",
    KNOB: "The whole road at an accuracy of 1 %: the way from its scales to the total, against the converged friction "
    "of all waves at once, in small strain and, where it is light and fast, in finite strain. Costs are over that of "
    "the direct way.",
}
_PLACE = {"velocity": "v (mm/s)", "pressure": "p (MPa)"}
# One rung down from the mesh of fineness 1 (the first rung of each pair): what the knob changes there.
_TURNS = {
    "surface": ("0.5", "half the columns"),
    "rows": ("1.2", "rows that grow twice as fast"),
    "first_row": ("2", "first row twice as high"),
    "kinematics": ("small", "small strain"),
    "folding": ("1", "folding up to the accuracy"),
    "tolerance": ("0.001", "tolerance 0.001"),
}
_REGIMES = {
    "slow (up to 1 mm/s)": "velocity <= 1",
    "near the peak (10 to 1000 mm/s)": "velocity > 1 and velocity < 10000",
    "fast (10^4 mm/s)": "velocity >= 10000",
    "light (up to 0.5 MPa)": "pressure <= 0.5",
    "heavy (5 MPa)": "pressure >= 5",
    "plane stress": "plane == 'stress'",
    "plane strain": "plane == 'strain'",
}


def accuracy_page(ladder: pd.DataFrame, calibration: pd.DataFrame, presets: dict[str, float]) -> str:
    """Return the page.

    Parameters
    ----------
    ladder : pandas.DataFrame
        Of all scenes, as from ``rubfric.studies.accuracy.ladder.measure_ladder``.
    calibration : pandas.DataFrame
        As from ``rubfric.studies.accuracy.calibration``.
    presets : dict of str to float
        Their accuracies, by name.
    """
    knobs = knob_table(ladder)
    singles = ladder[ladder["knob"] != KNOB]
    reference = (singles["reference_error"] / singles["reference"].abs()).groupby(singles["scene"]).first()
    parts = [
        "# Accuracy against cost",
        f"{singles['scene'].nunique()} scenes of the paper's rubber and road (every scale, slow to fast, 0.1 to 5 MPa, "
        "both planes, flat and tall blocks), each on a ladder of every knob, one knob at a time. An error is the "
        "distance from the scene's converged friction in finite strain: three meshes, each 1.4 times finer than the "
        f"one before, and their extrapolation, whose own error is bounded by {_percent(reference.max())} "
        f"(median {_percent(reference.median())}). Costs are ratios of wall time to the preset `standard`, measured "
        "on the same scene in the same process.",
        "## Presets",
        preset_text(singles, presets),
        "Each begins with the first mesh that is the cheapest for its accuracy and keeps it on every scene (the finest "
        "of those that cost the same within 15 %), and refines it where the estimated error says so:",
        _markdown(_formatted(start_table(ladder))),
        "## Can the estimated errors be trusted?",
        calibration_text(calibration),
        "## What dominates where",
        "How much friction changes (median, and largest) when one knob is turned down from the mesh of fineness 1:",
        _markdown(dominance(ladder)),
        *_dominance_words(ladder),
        "## What each knob buys",
    ]
    for knob, words in _KNOBS.items():
        rungs = knobs[knobs["knob"] == knob]
        if len(rungs):
            parts += [f"### `{knob}`", f"{words} {_bought(rungs)}", _markdown(_formatted(rungs.drop(columns="knob")))]
    if (ladder["knob"] == KNOB).any():
        parts += ["How far each way is from all waves at once, scene by scene:", _markdown(ways_table(ladder))]
    return "\n\n".join(parts) + "\n"


def preset_text(ladder: pd.DataFrame, presets: dict[str, float]) -> str:
    """Return the table of presets as Markdown: accuracy asked for, typical and worst error, and cost.

    Parameters
    ----------
    ladder, presets
        As for ``accuracy_page``.
    """
    knobs = knob_table(ladder).query("knob == 'preset'").set_index("rung")
    count = ladder["scene"].nunique()
    table = pd.DataFrame(
        {
            "preset": f"`{name}`",
            "accuracy asked for": _percent(accuracy),
            "typical error": _percent(knobs.loc[name, "typical_error"]),
            "worst error": _percent(knobs.loc[name, "worst_error"]),
            "estimated, typically": _percent(knobs.loc[name, "typical_estimate"]),
            "cost of a scene": f"{knobs.loc[name, 'cost']:.2g}",
            f"{count} scenes": f"{knobs.loc[name, 'seconds']:.1f} s",
            "memory": f"{knobs.loc[name, 'memory_MB']:.0f} MB",
        }
        for name, accuracy in presets.items()
    )
    return _markdown(table)


def calibration_text(calibration: pd.DataFrame) -> str:
    """Return the table of how often, and how tightly, the estimates cover the true errors."""
    found = coverage_table(calibration)
    total = found.iloc[-1]
    table = pd.DataFrame(
        {
            "set": found["set"],
            "results": found["scenes"],
            "refused": found["refused"],
            "true error within the estimate": (100.0 * found["coverage"]).map("{:.1f} %".format),
            "estimate over true error, median": found["ratio"].map("{:.1f}".format),
        }
    )
    word = "The target is met" if total["holds"] else "The target is not met"
    return (
        f"{_markdown(table)}\n\n{word}: at least {100.0 * COVERAGE:g} % of the true errors within the estimate, and "
        f"the estimate at most {EXCESS:g} times the true error at the median."
    )


def dominance(ladder: pd.DataFrame) -> pd.DataFrame:
    """Return how much turning down each knob changes friction, median and largest, regime by regime."""
    changes = _changes(ladder)
    rows = []
    for regime, query in _REGIMES.items():
        part = changes.query(query)
        row = {"regime": regime}
        for knob, (_, words) in _TURNS.items():
            found = part.loc[part["knob"] == knob, "change"]
            row[words] = f"{_percent(found.median())} ({_percent(found.max())})" if len(found) else _NOTHING
        rows.append(row)
    return pd.DataFrame(rows)


def ways_table(ladder: pd.DataFrame) -> pd.DataFrame:
    """Return the error and, in brackets, the cost of every way to the total, a row for each scene of the whole road."""
    rows = []
    for _, part in ladder[ladder["knob"] == KNOB].groupby("scene", sort=False):
        at = part.set_index("rung")
        row = {
            "strain": at.loc[DIRECT, "kinematics"],
            "plane": at["plane"].iloc[0],
            **{words: f"{at[name].iloc[0]:g}" for name, words in _PLACE.items()},
            "all at once, seconds": _seconds(at.loc[DIRECT, "seconds"]),
        }
        rows.append(row | {way: f"{_percent(one['error'])} ({_seconds(one['cost'])})" for way, one in at.iterrows()})
    return pd.DataFrame(rows)


def _changes(ladder: pd.DataFrame) -> pd.DataFrame:
    base = ladder.query("knob == 'mesh' and rung == '1'").set_index("scene")["friction_coefficient"]
    parts = [ladder[(ladder["knob"] == knob) & (ladder["rung"] == rung)] for knob, (rung, _) in _TURNS.items()]
    turned = pd.concat(parts).dropna(subset=["friction_coefficient"])
    before = turned["scene"].map(base)
    return turned.assign(change=(turned["friction_coefficient"] - before).abs() / turned["reference"].abs())


def _dominance_words(ladder: pd.DataFrame) -> list[str]:
    """Return one sentence per regime: the two knobs that matter most there."""
    changes = _changes(ladder)
    sentences = []
    for regime, query in _REGIMES.items():
        medians = changes.query(query).groupby("knob")["change"].median().sort_values(ascending=False)
        if len(medians) > 1:
            (first, most), (second, next_most) = list(medians.items())[:2]
            sentences.append(
                f"- {regime[0].upper()}{regime[1:]}: `{first}` ({_percent(most)}), then `{second}` "
                f"({_percent(next_most)})."
            )
    return ["\n".join(sentences)]


def _bought(rungs: pd.DataFrame) -> str:
    """Return in one sentence what the knob's last rung buys over its first, of those that any scene was solved on."""
    solved = rungs[rungs["scenes"] > 0]
    if not len(solved):
        return "No scene could be solved."
    first, last = solved.iloc[0], solved.iloc[-1]
    return (
        f"From {first['rung']} to {last['rung']} the typical error goes from {_percent(first['typical_error'])} to "
        f"{_percent(last['typical_error'])} and the worst from {_percent(first['worst_error'])} to "
        f"{_percent(last['worst_error'])}, at {last['cost'] / first['cost']:.2g} times the cost."
    )


def _formatted(table: pd.DataFrame) -> pd.DataFrame:
    """Return a table with its numbers rounded for reading."""
    shown = table.copy()
    for name in ("typical_error", "worst_error", "typical_estimate", "accuracy"):
        if name in shown:
            shown[name] = shown[name].map(_percent)
    for name, form in (("cost", "{:.2g}"), ("seconds", "{:.1f}"), ("memory_MB", "{:.0f}"), ("fineness", "{:g}")):
        if name in shown:
            shown[name] = [_NOTHING if pd.isna(value) else form.format(value) for value in shown[name]]
    if "chosen" in shown:
        shown["chosen"] = shown["chosen"].map({True: "yes", False: ""})
    return shown.rename(columns=lambda name: str(name).replace("_MB", ", MB").replace("_", " "))


def _seconds(value: float) -> str:
    return _NOTHING if pd.isna(value) else f"{value:.2g}"


def _percent(share: float) -> str:
    return _NOTHING if pd.isna(share) else f"{100.0 * share:.2g} %"


def _markdown(table: pd.DataFrame) -> str:
    return markdown_table([list(table.columns), *table.itertuples(index=False)], numeric=True)
