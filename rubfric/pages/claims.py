"""Which claims of the paper are reproduced: a page to read in a minute, and a table in Markdown."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from typing import Any, NamedTuple
from urllib.parse import urlencode

import pandas as pd

from rubfric.config.models import AS_CONFIGURED
from rubfric.markdown import markdown_table
from rubfric.pages.claim_plots import HEIGHT, WIDTH, percent, strip
from rubfric.pages.render import render, sentence
from rubfric.studies.paper.verdicts import EVERY, FAILS, HOLDS, IN_PART, SIMULATED, UNDECIDED


class _Chip(NamedTuple):
    """A verdict with a mark besides its colour: for print, and for readers who cannot tell red from green."""

    words: str
    mark: str
    kind: str


# The figure of what the paper has no figure of.
_FIGURES = {"Section 2.2": "fig10"}
_MARKS = {HOLDS: ("●", "yes"), IN_PART: ("◐", "part"), FAILS: ("○", "no"), UNDECIDED: ("–", "open"), "": ("", "open")}


def claims_page(
    claims: pd.DataFrame,
    evidence: pd.DataFrame,
    about: Mapping[str, str],
    figures: Collection[str] = (),
    explorer: str = "",
    home: str = "",
) -> str:
    """Return the page as HTML.

    Parameters
    ----------
    claims, evidence : pandas.DataFrame
        As from ``claims_table`` and ``evidence_table`` of ``rubfric.studies.paper.verdicts``.
    about : mapping of str to str
        By the name of the reading: what was run, in words. The page has the readings in this order.
    figures : collection of str
        Names of the figures that are beside the page, ``figures/NAME.png``.
    explorer, home : str
        Links to the explorer and to the page of all results; none where they are empty.
    """
    whole = claims[claims["pressure_MPa"] == EVERY]
    others = [name for name in claims["reading"].unique() if name != AS_CONFIGURED]
    single = claims[(claims["reading"] == AS_CONFIGURED) & (claims["pressure_MPa"] != EVERY)]
    pressures = sorted(set(single["pressure_MPa"]))
    found = {(row["claim"], row["pressure_MPa"]): row["verdict"] for _, row in single.iterrows()}
    return render(
        "claims.html",
        title="Which claims of the paper are reproduced",
        about=about[AS_CONFIGURED],
        home=home,
        width=WIDTH,
        height=HEIGHT,
        claims=[
            _claim(row, evidence, figures, explorer)
            | {"others": [_chip(_verdict(whole, row["claim"], name)) for name in others]}
            for _, row in whole[whole["reading"] == AS_CONFIGURED].iterrows()
        ],
        others=[
            {"name": _words(name), "about": about[name], "notes": _notes(whole[whole["reading"] == name])}
            for name in others
        ],
        pressures=[f"{pressure:g} MPa" for pressure in pressures],
        by_pressure={
            name: [_chip(found[name, pressure]) if (name, pressure) in found else None for pressure in pressures]
            for name in single["claim"].unique()
        },
    )


def claims_text(claims: pd.DataFrame) -> str:
    """Return the verdicts as a table in Markdown, one line for each claim, one column for each reading."""
    whole = claims[claims["pressure_MPa"] == EVERY]
    readings = list(claims["reading"].unique())
    names = ["here" if name == AS_CONFIGURED else _words(name) for name in readings]
    rows = [["the paper's claim", "decided by", *names]]
    for _, row in whole[whole["reading"] == AS_CONFIGURED].iterrows():
        first, *others = (_verdict(whole, row["claim"], reading) for reading in readings)
        rows.append([f"{row['claim']} ({row['figure']}) {row['says']}", _number(row), f"**{first}**", *others])
    return markdown_table(rows)


def _claim(row: pd.Series, evidence: pd.DataFrame, figures: Collection[str], explorer: str) -> dict[str, Any]:
    """Return what the page shows of one claim as judged by the campaign itself."""
    own = evidence[(evidence["claim"] == row["claim"]) & (evidence["reading"] == AS_CONFIGURED)]
    decides = own[(own["value"] == row["value"]) & (own["quantity"] == row["deciding_quantity"])]
    return {
        "links": _links(row, decides, figures, explorer),
        "name": row["claim"],
        "says": row["says"],
        "figure": row["figure"],
        "verdict": _chip(row["verdict"]),
        "number": _number(row),
        "note": f"{sentence(row['parts'])} {row['note']}".strip() if row["parts"] else row["note"],
        "parts": [
            {
                "name": part,
                "quantity": found["quantity"].iloc[0],
                "plot": strip(found, row["value"] if part in set(decides["part"]) else None),
                "label": f"{part}: {_counts(found)}; {_limit(found)}, found {_span(found['value'])}",
                "cells": [
                    _limit(found),
                    _span(found["value"]),
                    _span(found["error"]),
                    *((found["outcome"] == word).sum() for word in ("yes", "no", "open")),
                ],
            }
            for part, found in own.groupby("part", sort=False)
        ],
    }


def _limit(found: pd.DataFrame) -> str:
    return f"{found['sense'].iloc[0]} {percent(found['limit'].iloc[0])}"


def _counts(found: pd.DataFrame) -> str:
    return ", ".join(f"{(found['outcome'] == word).sum()} {word}" for word in ("yes", "no", "open"))


def _links(row: pd.Series, decides: pd.DataFrame, figures: Collection[str], explorer: str) -> dict[str, str]:
    """Return links to the figure of a claim, where it was drawn, and to the deciding scene in the explorer."""
    figure = _FIGURES.get(row["figure"], row["figure"].replace("Fig. ", "fig"))
    links = {f"Fig. {figure.removeprefix('fig')}": f"figures/{figure}.png"} if figure in figures else {}
    if explorer and len(decides):
        first = decides.iloc[0]
        place = {"scale": first["scale"], "pressure": first["pressure_MPa"], "speed": first["velocity_mm_per_s"]}
        known = {"scale": "total"} | {name: f"{float(at):g}" for name, at in place.items() if pd.notna(at)}
        links["the deciding number in the explorer"] = f"{explorer}#{urlencode(known)}"
    return links


def _number(row: pd.Series) -> str:
    """Return the deciding number in words."""
    if not isinstance(row["where"], str):
        return "nothing yet"
    sense, limit = row["limit"].split()
    error = row["error"] if math.isfinite(row["error"]) else math.nan
    return (
        f"{row['deciding_quantity']}: {percent(row['value'], error)} (has to be {sense} "
        f"{percent(float(limit))}), {row['where']}"
    )


def _span(values: pd.Series) -> str:
    known = values[values.abs() < math.inf].dropna()
    if known.empty:
        return "not estimated"
    low, high = float(known.min()), float(known.max())
    return percent(low) if low == high else f"{percent(low)} to {percent(high)}"


def _verdict(whole: pd.DataFrame, claim: str, reading: str) -> str:
    """Return a verdict over all pressures; empty where the claim was not judged in that reading."""
    found = whole.loc[(whole["claim"] == claim) & (whole["reading"] == reading), "verdict"]
    return str(found.iloc[0]) if len(found) else ""


def _chip(verdict: str) -> _Chip:
    return _Chip(verdict or "not run", *_MARKS[verdict.removesuffix(SIMULATED)])


def _notes(rows: pd.DataFrame) -> str:
    return " ".join(dict.fromkeys(note for note in rows["note"] if note))


def _words(name: str) -> str:
    return name.replace("_", " ")
