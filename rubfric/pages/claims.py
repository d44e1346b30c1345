"""What of the paper stands, as a page to read in a minute (HTML, self-contained) and as a table for a README."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from html import escape

import pandas as pd

from rubfric.config.models import AS_CONFIGURED
from rubfric.studies.paper.verdicts import EVERY, FAILS, HOLDS, IN_PART, SIMULATED, UNDECIDED

# A mark besides the colour, for print and for eyes that tell no green from red.
_MARKS = {HOLDS: ("●", "yes"), IN_PART: ("◐", "part"), FAILS: ("○", "no"), UNDECIDED: ("–", "open")}
_STYLE = """
body { font: 16px/1.5 system-ui, sans-serif; color: #1b1f24; max-width: 70rem; margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.7rem; margin-bottom: .2rem; } h2 { font-size: 1.2rem; margin-top: 2.2rem; }
p.lead { color: #57606a; margin-top: 0; max-width: 46rem; }
div.wide { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-size: .93rem; font-variant-numeric: tabular-nums; }
th { text-align: left; font-weight: 600; border-bottom: 2px solid #1b1f24; vertical-align: bottom; }
th, td { padding: .45rem .9rem .45rem 0; } td { border-bottom: 1px solid #d0d7de; vertical-align: top; }
td small { color: #57606a; display: block; }
td.name { min-width: 15rem; } td.number { min-width: 14rem; }
.verdict { white-space: nowrap; font-weight: 600; }
.yes { color: #1a6e8e; } .part { color: #8a5a00; } .no { color: #b3261e; } .open { color: #57606a; }
"""


def claims_page(claims: pd.DataFrame, evidence: pd.DataFrame, about: Mapping[str, str]) -> str:
    """Return the page.

    Parameters
    ----------
    claims, evidence : pandas.DataFrame
        As from ``rubfric.studies.paper.verdicts``.
    about : mapping of str to str
        What was run, in words, in the order in which it is told: the campaign, then each reading by its name.
    """
    whole = claims[claims["pressure_MPa"] == EVERY]
    readings = list(dict.fromkeys(claims["reading"]))
    body = [
        "<h1>What of the paper stands</h1>",
        '<p class="lead">The claims of Zhou, Wang and Wei (2019, doi:10.1049/joe.2018.9163), judged by the numbers of '
        f"this campaign, each against its own error. {escape(about[AS_CONFIGURED])}</p>",
        _summary(whole, readings),
        f"<p>{_legend()}</p>",
        *_readings(claims, readings, about),
        "<h2>How the verdicts move with pressure</h2>",
        "<p>The paper names one of its pressures only (5 MPa). The grid here spans partial to full contact.</p>",
        _by_pressure(claims[(claims["reading"] == AS_CONFIGURED) & (claims["pressure_MPa"] != EVERY)]),
        "<h2>What each claim was judged by</h2>",
        *[_section(row, evidence) for _, row in whole[whole["reading"] == AS_CONFIGURED].iterrows()],
    ]
    return (
        '<!doctype html>\n<html lang="en"><head><meta charset="utf-8"><title>What of the paper stands</title>\n'
        f'<meta name="viewport" content="width=device-width, initial-scale=1"><style>{_STYLE}</style></head>\n<body>\n'
        + "\n".join(body)
        + "\n</body></html>\n"
    )


def claims_text(claims: pd.DataFrame) -> str:
    """Return the verdicts as a table in Markdown, one line for each claim, one column for each reading."""
    whole = claims[claims["pressure_MPa"] == EVERY]
    readings = list(dict.fromkeys(claims["reading"]))
    names = ["here" if name == AS_CONFIGURED else name.replace("_", " ") for name in readings]
    lines = [["the paper's claim", "decided by", *names], ["---"] * (2 + len(names))]
    for _, row in whole[whole["reading"] == AS_CONFIGURED].iterrows():
        verdicts = [_verdict_of(whole, row["claim"], reading) or "" for reading in readings]
        verdicts[0] = f"**{verdicts[0]}**"
        lines.append([f"{row['claim']} ({row['figure']}) {row['says']}", _number(row), *verdicts])
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def _summary(whole: pd.DataFrame, readings: list[str]) -> str:
    headings = ["claim", "verdict", "decided by", *(_words(name) for name in readings if name != AS_CONFIGURED)]
    rows = []
    for _, row in whole[whole["reading"] == AS_CONFIGURED].iterrows():
        others = [_chip(_verdict_of(whole, row["claim"], reading)) for reading in readings if reading != AS_CONFIGURED]
        rows.append(
            [
                f'<td class="name"><b>{row["claim"]}</b> {escape(row["says"])} <small>{escape(row["figure"])}</small>',
                f"<td>{_chip(row['verdict'])}",
                f'<td class="number">{escape(_number(row))}<small>{escape(_note(row))}</small>',
                *(f"<td>{other}" for other in others),
            ]
        )
    return _table(headings, rows)


def _by_pressure(claims: pd.DataFrame) -> str:
    pressures = sorted(set(claims["pressure_MPa"]))
    rows = []
    for name in dict.fromkeys(claims["claim"]):
        own = claims[claims["claim"] == name].set_index("pressure_MPa")
        cells = [_chip(own.loc[pressure, "verdict"]) if pressure in own.index else "" for pressure in pressures]
        rows.append([f"<td>{name}", *(f"<td>{cell}" for cell in cells)])
    return _table(["claim", *(f"{pressure:g} MPa" for pressure in pressures)], rows)


def _readings(claims: pd.DataFrame, readings: list[str], about: Mapping[str, str]) -> Iterable[str]:
    if len(readings) > 1:
        yield "<h2>The other readings</h2>"
        yield (
            "<p>The paper leaves open whether its modulus is of the relaxed or of the instantaneous rubber, and its "
            "text does not name the plane, only its element. The whole campaign was therefore run again:</p>"
        )
    for reading in readings:
        if reading != AS_CONFIGURED:
            whole = claims[(claims["reading"] == reading) & (claims["pressure_MPa"] == EVERY)]
            notes = " ".join(dict.fromkeys(note for note in whole["note"] if note))
            yield f"<p><b>{escape(_words(reading))}</b>: {escape(about[reading])} {escape(notes)}</p>"


def _section(row: pd.Series, evidence: pd.DataFrame) -> str:
    own = evidence[(evidence["claim"] == row["claim"]) & (evidence["reading"] == AS_CONFIGURED)]
    rows = [
        [
            f'<td class="name">{escape(part)}<small>{escape(found["quantity"].iloc[0])}</small>',
            f"<td>{escape(found['sense'].iloc[0])} {_percent(found['limit'].iloc[0])}",
            f"<td>{_span(found['value'])}",
            f"<td>{_span(found['error'])}",
            *(f"<td>{(found['outcome'] == word).sum()}" for word in ("yes", "no", "open")),
        ]
        for part, found in own.groupby("part", sort=False)
    ]
    headings = ["what has to be", "limit", "found, from to", "errors, from to", "yes", "no", "open"]
    table = _table(headings, rows) if rows else "<p>Nothing was measured or run that could decide it.</p>"
    title = f"{row['claim']}, {row['figure']}: {_chip(row['verdict'])}"
    return f"<h2>{title}</h2>\n<p>{escape(row['says'])} {escape(_note(row))}</p>\n{table}"


def _number(row: pd.Series) -> str:
    """Return the deciding number in words."""
    if not isinstance(row["where"], str):
        return "nothing yet"
    sense, limit = row["limit"].split()
    error = row["error"] if math.isfinite(row["error"]) else math.nan
    return (
        f"{row['deciding_quantity']}: {_percent(row['value'], error)} (has to be {sense} "
        f"{_percent(float(limit))}), {row['where']}"
    )


def _percent(value: float, error: float = math.nan) -> str:
    """Return a share in per cent, its error beside it where there is one."""
    spread = "" if math.isnan(error) or error == 0.0 else f" ± {100.0 * error:.2g}"
    return f"{100.0 * value:.3g}{spread} %".replace("-", "\N{MINUS SIGN}")


def _note(row: pd.Series) -> str:
    parts = f"{row['parts']}." if row["parts"] else ""
    return f"{parts} {row['note']}".strip()


def _span(values: pd.Series) -> str:
    known = values[values.abs() < math.inf].dropna()
    if known.empty:
        return "not estimated"
    low, high = float(known.min()), float(known.max())
    return _percent(low) if low == high else f"{_percent(low)} to {_percent(high)}"


def _verdict_of(whole: pd.DataFrame, claim: str, reading: str) -> str:
    found = whole.loc[(whole["claim"] == claim) & (whole["reading"] == reading), "verdict"]
    return str(found.iloc[0]) if len(found) else ""


def _chip(verdict: str) -> str:
    if not verdict:
        return '<span class="open">not run</span>'
    mark, kind = _MARKS[verdict.removesuffix(SIMULATED)]
    return f'<span class="verdict {kind}">{mark} {verdict}</span>'


def _legend() -> str:
    return (
        "A claim <i>holds</i> where every number that can be decided bears it out, and more than half can be; it "
        "<i>does not hold</i> where none does; <i>open</i> is a number that its error, or a march too short, leaves "
        "undecided. All numbers are in tables/claims.csv and tables/claims_evidence.csv."
    )


def _words(name: str) -> str:
    return name.replace("_", " ")


def _table(headings: list[str], rows: list[list[str]]) -> str:
    head = "".join(f"<th>{escape(heading)}</th>" for heading in headings)
    body = "\n".join("<tr>" + "".join(f"{cell}</td>" for cell in row) + "</tr>" for row in rows)
    return f'<div class="wide"><table><thead><tr>{head}</tr></thead>\n<tbody>\n{body}\n</tbody></table></div>'
