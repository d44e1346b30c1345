"""The words and numbers of the page, by the functions that make them, in the browser."""

from __future__ import annotations

from typing import Any

import pytest
from selenium.webdriver.remote.webdriver import WebDriver
from visit import open_explorer

from rubfric.figures import style
from rubfric.results.selection import written

THIN = "\u202f"


def call(browser: WebDriver, function: str, *values: Any) -> str:
    """Return what a function of the page says, with plain spaces."""
    said = browser.execute_script(f"return {function}(...arguments)", *values)
    return str(said).replace(THIN, " ")


def test_numbers_are_written_as_in_the_figures(browser: WebDriver, whole: Any) -> None:
    open_explorer(browser, whole.path)
    for value in (0.1, 0.30000000000000004, 1.0, 500.0, 9999.5, 10000.0, 1234567.25):
        assert call(browser, "plain", value) == written(value).replace("\N{NO-BREAK SPACE}", " ")
    for share in (0.0123, 0.00079, 0.01, 0.099, 0.12, 0.2512, 1.5):
        assert call(browser, "relative", 1.0, share) == style.percent(share).replace("\N{NO-BREAK SPACE}", " ")


@pytest.mark.parametrize(
    ("friction", "error", "said"),
    [
        (0.28894, 0.00226, "0.2889 ± 0.0023"),
        (0.28894, 0.0022, "0.2889 ± 0.0022"),
        (0.0023512, 0.0000178, "0.002351 ± 0.000018"),
        (0.5, 0.00996, "0.5000 ± 0.0100"),
        (1.0408, 0.1, "1.04 ± 0.10"),
        (0.25, 0.0, "0.25 ± 0"),
        (0.25, None, "0.25, error unknown"),
        (None, None, "not run"),
    ],
)
def test_friction_has_the_digits_that_its_error_leaves(
    browser: WebDriver, whole: Any, friction: float | None, error: float | None, said: str
) -> None:
    open_explorer(browser, whole.path)
    assert call(browser, "measured", friction, error) == said


@pytest.mark.parametrize(
    ("peak", "said"),
    [
        (
            {"kind": "peak", "at": 1, "between": [0, 2]},
            "the peak is 0.300 ± 0.010 at 10 mm/s, the highest of the speeds",
        ),
        (
            {"kind": "peak", "at": 1, "between": [0, 2]},
            "if the curve has a single peak, it lies between 1 and 100 mm/s.",
        ),
        ({"kind": "rising", "at": 2}, "there is no peak: friction is still rising at 100 mm/s, the fastest speed run"),
        ({"kind": "falling", "at": 0}, "there is no peak: friction is highest at 1 mm/s, the slowest speed run"),
        (
            {"kind": "level", "at": 1},
            "no peak can be named: the highest, 0.300 ± 0.010 at 10 mm/s, cannot be distinguished from",
        ),
        ({"kind": "few", "at": 1}, "there are too few speeds to name a peak; the highest is 0.300 ± 0.010 at 10 mm/s."),
        ({"kind": "none", "at": None}, "nothing was run."),
        ({"kind": "rising", "at": 2, "missing": 2}, "2 of 3 speeds were not run."),
    ],
)
def test_peaks_are_told_as_they_are(browser: WebDriver, whole: Any, peak: dict[str, Any], said: str) -> None:
    open_explorer(browser, whole.path)
    curve = {"friction": [[0.1, 0.3, 0.2]], "error": [[0.01, 0.01, 0.01]], "peaks": [{"missing": 0} | peak]}
    told = call(browser, "peakWords", curve, 0, [5], [1, 10, 100])
    assert told.startswith("At 5 MPa ")
    assert said in told
    assert (" the peak is " in told) == (peak["kind"] == "peak")


def test_share_in_words(browser: WebDriver, whole: Any) -> None:
    open_explorer(browser, whole.path)
    shares = {0.714: "71 %", 0.0314: "3.1 %", 0.00079: "0.079 %", 0.0: "0 %", 1.0: "100 %", 8.9e-7: "below 0.001 %"}
    assert {share: call(browser, "percent", share) for share in shares} == shares
