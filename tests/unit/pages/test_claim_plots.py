"""The small plots of the claims: numbers on the right side of their limit, errors around them."""

from __future__ import annotations

import math

import pandas as pd
import pytest

from rubfric.pages.claim_plots import WIDTH, percent, strip

FOUND = pd.DataFrame(
    {
        "value": [0.01, 0.2, 0.04, -math.inf],
        "error": [0.02, math.nan, math.inf, 0.1],
        "limit": 0.05,
        "sense": "below",
        "outcome": ["yes", "no", "open", "open"],
    }
)


@pytest.mark.parametrize("sense", ["below", "above"])
def test_side_that_supports_the_claim_is_that_of_the_sense(sense: str) -> None:
    plot = strip(FOUND.assign(sense=sense), 0.2)
    assert plot["limit"] == (plot["to"] if sense == "below" else plot["from"])
    yes, no, open_ = plot["marks"]
    assert yes.x < open_.x < plot["limit"] < no.x
    assert [mark.kind for mark in plot["marks"]] == ["yes", "no", "open"]
    assert 0.0 <= plot["from"] < plot["to"] <= WIDTH
    assert plot["limit_words"][1] == f"{sense} 5 %"


def test_errors_are_to_scale_and_stay_inside() -> None:
    yes, no, _ = strip(FOUND)["marks"]
    scale = (no.x - yes.x) / 0.19
    assert yes.high - yes.x == pytest.approx(0.02 * scale, abs=0.2)
    assert 0.0 < yes.low < yes.x  # cut off where the plot ends
    assert no.low == no.x == no.high


def test_deciding_number_is_marked_and_has_its_words() -> None:
    (_, anchor), mark = strip(FOUND, 0.2)["decides"]
    assert (anchor, mark.words) == ("end", "20 %")
    assert strip(FOUND)["decides"] is None
    assert strip(FOUND[-1:]) == {}


def test_one_number_on_its_limit_can_be_drawn() -> None:
    plot = strip(FOUND[:1].assign(value=0.05), 0.05)
    assert plot["marks"][0].x == plot["limit"] == WIDTH / 2.0


@pytest.mark.parametrize(
    ("value", "error", "words"),
    [
        (0.034133, 0.0110945, "3.4 ± 1.1 %"),
        (4.57555, 1.66406, "460 ± 170 %"),
        (-0.316, math.nan, "\N{MINUS SIGN}31.6 %"),
    ],
)
def test_share_has_the_digits_of_its_error(value: float, error: float, words: str) -> None:
    assert percent(value, error) == words
