"""Times that a logger writes as a clock shows them, 12:03:04.5 or 2026-11-22T12:03:04.5, in s."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from datetime import date

import numpy as np

from rubfric.arrays import Real
from rubfric.errors import InvalidInput

_DAY = 86400.0
_CLOCK = re.compile(
    r"^(?:(?P<year>\d{4})[-/](?P<month>\d{1,2})[-/](?P<day>\d{1,2})(?:\s*T\s*|\s+))?"
    r"(?P<hours>\d{1,3}):(?P<minutes>[0-5]\d):(?P<seconds>[0-5]\d(?:[.,]\d*)?)"
    r"(?:\s*(?P<noon>[AaPp])\.?[Mm]\.?)?(?P<zone>Z|[+-]\d\d:?\d\d)?$"
)
_DATE = re.compile(r"^\d{1,2}([./-])\d{1,2}\1\d{2,4},?\s+")
_COLON = re.compile(r"\d:\d\d")


def looks_like_clock(word: str) -> bool:
    """Return whether a word holds hours or minutes with a colon, readable or not."""
    return bool(_COLON.search(word))


def clock_times(where: str, words: Sequence[str]) -> Real:
    """Return the seconds that clock times mean, from the midnight before the first one.

    Times without a date go on after midnight: where they jump by more than half a day, a day has passed.

    Parameters
    ----------
    where : str
        The file and column, for messages.
    words : sequence of str
        ``hh:mm:ss``, with a point or a comma before fractions, with AM or PM, or after a date ``yyyy-mm-dd``, or any
        date that all share; what is no such time is a missing value.

    Returns
    -------
    numpy.ndarray, shape (words,)
        s; NaN where a value is missing.

    Raises
    ------
    InvalidInput
        For times that may be read in two ways, and where only some have a date.
    """
    # A date that all times share need not be understood.
    dates = {one[0] if (one := _DATE.match(word.strip())) else "" for word in words if looks_like_clock(word)}
    words = [_DATE.sub("", word.strip()) for word in words] if len(dates) == 1 else words
    found = [_CLOCK.match(word.strip()) for word in words]
    for word, one in zip(words, found, strict=True):
        if one is None and looks_like_clock(word):
            raise InvalidInput(
                f"{where} holds the time {word.strip()[:40]!r}, which cannot be read without a guess: export times "
                "as seconds, as hh:mm:ss, or as yyyy-mm-dd hh:mm:ss"
            )
    dated = {one["year"] is not None for one in found if one}
    if len(dated) > 1:
        raise InvalidInput(f"{where} holds times with a date and times without one: export all of them in one way")
    days = [_day(where, one) if one else math.nan for one in found]
    first = next((day for day in days if not math.isnan(day)), 0.0)
    # Days are taken off first, so that a date costs no digits of the seconds.
    times = np.array(
        [_DAY * (day - first) + _second(where, one) if one else math.nan for day, one in zip(days, found, strict=True)]
    )
    known = np.isfinite(times)
    if dated == {False}:
        times[known] = np.unwrap(times[known], period=_DAY)
    return times


def _day(where: str, clock: re.Match[str]) -> float:
    if clock["year"] is None:
        return 0.0
    try:
        return float(date(int(clock["year"]), int(clock["month"]), int(clock["day"])).toordinal())
    except ValueError as error:
        raise InvalidInput(f"{where} holds {clock[0]!r}, whose date is none: {error}") from error


def _second(where: str, clock: re.Match[str]) -> float:
    """Return the second of the day, in universal time where a zone is given."""
    hours, noon = int(clock["hours"]), clock["noon"]
    if (noon and not 1 <= hours <= 12) or (clock["year"] and hours > 23):
        raise InvalidInput(f"{where} holds {clock[0]!r}, whose hour is none")
    if noon:
        hours = hours % 12 + (12 if noon in "Pp" else 0)
    zone = clock["zone"]
    ahead = 0 if zone in (None, "Z") else int(f"{zone[0]}1") * (60 * int(zone[1:3]) + int(zone[-2:]))
    return 3600.0 * hours + 60.0 * (int(clock["minutes"]) - ahead) + float(clock["seconds"].replace(",", "."))
