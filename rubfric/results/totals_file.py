"""The table of totals of a campaign as a file, and what campaign and version made it."""

from __future__ import annotations

import hashlib
import math
import os
from pathlib import Path
from typing import NamedTuple

import pandas as pd

import rubfric
from rubfric.errors import InvalidInput
from rubfric.results.campaign import read
from rubfric.results.scales import AXES, TOTAL, WORDS
from rubfric.results.tables import read_table

_TABLE = Path("tables", "friction_total.csv")


class Source(NamedTuple):
    """A table of totals: what it holds, a name for it, in lines what made it, and what to say of the choice."""

    table: pd.DataFrame
    name: str
    about: list[str]
    note: str


def read_totals(place: str | os.PathLike[str]) -> Source:
    """Read the totals of a campaign, given its folder of results, or a table of totals.

    Parameters
    ----------
    place : path-like
        A folder such as ``results``, whose ``tables/friction_total.csv`` is read; or that table, that of a pair, or
        what ``rubfric friction --csv`` has printed.

    Raises
    ------
    InvalidInput
        For a folder without such a table, and for a table of something else.
    BrokenResult
        For a table that is damaged, or was changed.
    FileNotFoundError
        For a missing file or folder.
    """
    given = Path(place)
    if not given.exists():
        raise FileNotFoundError(f"{given} is missing: give the folder of a campaign's results, or a table of totals")
    path = given / _TABLE if given.is_dir() else given
    if not path.is_file():
        raise InvalidInput(f"{given} has no {_TABLE}: run snakemake first, or give the table of totals itself")
    table = read_table(path, WORDS, signed=given.is_dir())
    missing = [name for name in (*AXES, *TOTAL, WORDS[0]) if name not in table]
    if missing:
        raise InvalidInput(f"{path} is no table of totals: it lacks {', '.join(missing)}")
    rubber, road, about = _campaign(path)
    mark = hashlib.sha256(path.read_bytes()).hexdigest()[:16]
    made = f"made by rubfric {rubfric.__version__} from {path} (sha256 {mark}...)"
    others = sorted(given.glob("totals/*/*/friction_total.csv")) if given.is_dir() else []
    note = (
        f"of {len(others)} pairs of rubber and road this is the first of the config; give the table of another: "
        f"{given}/totals/RUBBER/ROAD/friction_total.csv"
        if others
        else ""
    )
    return Source(table, f"{rubber}_on_{road}" if rubber and road else "rubfric", [*about, made], note)


def _campaign(path: Path) -> tuple[str, str, list[str]]:
    """Return rubber, road and a line about the campaign of a table; nothing where it is not in a campaign's folder."""
    pair = path.parent.parent.parent.name == "totals"
    results = path.parents[3] if pair else path.parents[1] if path.parent.name == "tables" else None
    if results is None or not (results / "campaign.nc").is_file():
        return "", "", []
    campaign = read(results / "campaign.nc")
    rubber, road = campaign.attrs["rubber"], ""
    if pair:
        rubber, road = path.parent.parent.name, path.parent.name
    elif (scenes := results / "scenes" / rubber).is_dir():
        names = sorted(one.name for one in scenes.iterdir() if one.is_dir())
        road = names[0] if len(names) == 1 else ""
    scales = [
        f"{amplitude:g} mm at {2.0 * math.pi / wavenumber:.4g} mm"
        for amplitude, wavenumber in zip(campaign["amplitude"].values, campaign["wavenumber"].values, strict=True)
    ]
    which = f"road {road}" if road else f"a road of waves of {', '.join(scales)}"
    how = f"plane {campaign.attrs['plane']}, {campaign.attrs['kinematics']} kinematics"
    return rubber, road, [f"friction of rubber {rubber} on {which}; {how}; simulated by {campaign.attrs['source']}"]
