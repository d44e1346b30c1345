"""Evidence on the total over the scales: whether it peaks, and whether it is their sum."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest
import xarray as xr

from rubfric.studies.paper.claims import Evidence
from rubfric.studies.paper.totals import reading_note, total_evidence, total_note

SPEEDS = [1.0, 10.0, 100.0]
SUM = np.array([0.1, 0.8, 0.4])
# Numerical error of each of two scales.
SLACK = 0.001


def totals(
    direct: tuple[float, float, float] = (0.1, 0.4, 0.5), coupling: float = 0.0, refused: int = 0
) -> pd.DataFrame:
    """Return totals at 5 MPa: the direct ones where they are known, with an error of 0.002, and else the sum."""
    known = np.isfinite(direct)
    table = pd.DataFrame({"velocity_mm_per_s": SPEEDS, "pressure_MPa": 5.0, "friction_sum": SUM})
    return table.assign(
        friction_sum_error=2.0 * SLACK + coupling,
        friction_direct=direct,
        friction_direct_error=np.where(known, 0.002, np.nan),
        friction_total=np.where(known, direct, SUM),
        friction_total_error=np.where(known, 0.002, 2.0 * SLACK + coupling),
        refused=refused,
    )


@pytest.fixture
def grid() -> xr.Dataset:
    axes = {"scale": [1, 2], "velocity": SPEEDS, "pressure": [5.0]}
    return xr.Dataset({"friction_coefficient_error": (tuple(axes), np.full((2, 3, 1), SLACK))}, coords=axes)


def of(evidence: list[Evidence], part: str) -> list[Evidence]:
    return [one for one in evidence if one.part == part]


def test_sum_is_set_against_the_whole_road_point_by_point(grid: xr.Dataset) -> None:
    found = of(total_evidence(totals(), grid, 0.05), "the sum is the total")
    assert [(one.claim, one.velocity, one.pressure) for one in found] == [("C9", speed, 5.0) for speed in SPEEDS]
    assert [one.value for one in found] == pytest.approx([0.0, 1.0, 0.2])
    # The coupling is what is judged: only numerical errors count.
    assert [one.error for one in found] == pytest.approx([0.04, 0.01, 0.008])
    assert [one.outcome for one in found] == ["yes", "no", "no"]


def test_coupling_is_no_excuse_for_the_sum(grid: xr.Dataset) -> None:
    near, far = (of(total_evidence(totals(coupling=slack), grid, 0.05), "the sum is the total") for slack in (0.0, 0.9))
    assert near == far


def test_peaks_of_the_whole_road_and_of_the_sum_with_their_whole_errors(grid: xr.Dataset) -> None:
    found = total_evidence(totals(), grid, 0.05)
    (whole,), (single,) = of(found, "the whole road peaks"), of(found, "the sum peaks")
    assert (whole.outcome, single.outcome) == ("no", "yes")
    assert whole.value == pytest.approx(-0.2)
    assert single.value == pytest.approx(1.0)
    (doubtful,) = of(total_evidence(totals(coupling=0.3), grid, 0.05), "the sum peaks")
    assert doubtful.outcome == "open"
    assert doubtful.error == pytest.approx(2.0 * 0.302 / 0.4)


def test_measured_profile_is_no_evidence_on_the_sum_of_its_sines(grid: xr.Dataset) -> None:
    measured = totals().assign(way="direct", note="mean of 3 windows of the measured road")
    found = total_evidence(measured, grid, 0.05)
    assert of(found, "the sum is the total") == []
    assert of(found, "the whole road peaks")
    assert total_note(measured).startswith("Not judged: the whole road is a measured profile")


def test_what_was_refused_is_no_evidence_on_the_sum(grid: xr.Dataset) -> None:
    table = totals(direct=(0.1, np.nan, 0.5), refused=1)
    assert len(of(total_evidence(table, grid, 0.05), "the sum is the total")) == 2
    assert total_note(table).endswith("; at 3 of 3 points it was refused, in whole or in part.")


def test_note_has_the_range_and_its_places() -> None:
    assert total_note(totals()) == (
        "All scales at once have 0.50 (10 mm/s, 5 MPa) to 1.25 (100 mm/s, 5 MPa) times the friction of the sum."
    )
    assert total_note(totals(direct=(np.nan,) * 3)) == "The whole road was not simulated."


def test_reading_says_where_and_why_the_whole_road_was_not_judged() -> None:
    def whole(*friction: float) -> pd.DataFrame:
        return pd.DataFrame(
            {"friction_coefficient": friction, "note": ["" if x > 0.0 else "it is dear" for x in friction]}
        )

    ratios = (
        "C9: All scales at once have 0.50 (10 mm/s, 5 MPa) to 1.25 (100 mm/s, 5 MPa) times the friction of the sum."
    )
    assert reading_note(totals(), whole(0.1, 0.4, 0.5)) == ratios
    left = " It was judged at 2 of 3 speeds and loads: at 1 it is dear."
    assert reading_note(totals((np.nan, 0.4, 0.5)), whole(np.nan, 0.4, 0.5)) == ratios + left
    assert reading_note(totals((np.nan,) * 3), whole(np.nan, np.nan)) == "C9 was not judged, since it is dear."
    assert reading_note(totals((np.nan,) * 3), whole()) == "C9 was not judged, since the whole road was not simulated."
