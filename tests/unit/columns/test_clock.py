"""Clock times: what they mean in seconds, and which ones may mean two things."""

from __future__ import annotations

import numpy as np
import pytest

from rubfric.columns.clock import clock_times, looks_like_clock
from rubfric.errors import InvalidInput

READ = [
    (["12:03:04", "12:03:04.250", "12:03:04,5"], [43384.0, 43384.25, 43384.5]),
    (["9:00:00", "", "--", "9:00:01"], [32400.0, np.nan, np.nan, 32401.0]),
    (["23:59:59.5", "0:00:00", "00:00:00.5"], [86399.5, 86400.0, 86400.5]),
    (["23:59:59", "0:00:01", "23:59:58", "0:00:02"], [86399.0, 86401.0, 86398.0, 86402.0]),
    (["11:59:59 AM", "12:00:00 PM", "1:00:00 pm"], [43199.0, 43200.0, 46800.0]),
    (["12:00:00 a.m.", "12:00:01 AM"], [0.0, 1.0]),
    (["25:00:00", "25:00:01"], [90000.0, 90001.0]),
    (["2026-11-22T12:03:04.5Z", "2026-11-23 00:00:00Z"], [43384.5, 86400.0]),
    (["2026/12/31 23:59:59", "2027/1/1 0:00:00"], [86399.0, 86400.0]),
    (["22.11.2026 13:20:01", "22.11.2026 13:20:02.5"], [48001.0, 48002.5]),
    (["11/10/26, 1:20:01 PM", "11/10/26, 1:20:02 PM"], [48001.0, 48002.0]),
    (["2026-10-25T02:59:59+02:00", "2026-10-25T02:00:00+0100"], [3599.0, 3600.0]),
]


@pytest.mark.parametrize(("words", "seconds"), READ, ids=lambda one: str(one[0]))
def test_clock_times_in_seconds(words: list[str], seconds: list[float]) -> None:
    np.testing.assert_allclose(clock_times("run.csv", words), seconds, rtol=0.0, atol=1e-9)


def test_dates_cost_no_digits() -> None:
    times = clock_times("run.csv", ["2026-11-22T12:03:04.000001", "2026-11-22T12:03:04.000003"])
    assert times[1] - times[0] == pytest.approx(2e-6, rel=1e-4)


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["12:03"], "run.csv holds the time '12:03', which cannot be read without a guess: export times as seconds"),
        (["03:04.5"], "'03:04.5', which cannot be read"),
        (["12:03:04:123"], "'12:03:04:123', which cannot be read"),
        (["22.11.2026 23:59:59", "23.11.2026 00:00:01"], "'22.11.2026 23:59:59', which cannot be read"),
        (["11/22/2026 1:20:01 PM", "11/23/2026 1:20:01 PM"], "which cannot be read"),
        (["12:61:04"], "'12:61:04', which cannot be read"),
        (["13:00:00 PM"], "'13:00:00 PM', whose hour is none"),
        (["2026-11-22 24:00:01"], "whose hour is none"),
        (["2026-02-30 12:00:00"], "'2026-02-30 12:00:00', whose date is none: day is out of range for month"),
        (["12:00:00", "2026-11-22 12:00:01"], "times with a date and times without one"),
    ],
)
def test_what_would_have_to_be_guessed_is_refused(words: list[str], says: str) -> None:
    with pytest.raises(InvalidInput) as caught:
        clock_times("run.csv", words)
    assert says in str(caught.value)
    assert "\n" not in str(caught.value)


def test_words_without_a_clock_are_none() -> None:
    assert not any(map(looks_like_clock, ["2026-11-22", "OK", "a:b", "1.5", ""]))
