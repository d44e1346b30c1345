"""The table and the page of the matrix of stability say what the trials said."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import product

import pandas as pd
import pytest

from rubfric.studies.stability.cases import PANELS, Case
from rubfric.studies.stability.report import counts, limits, page, row, summary
from rubfric.studies.stability.trial import OUTCOMES, Trial

GOOD = Trial("converged", "", (0.1, 0.1, 0.101), 0.01, 1e-11, 2.0, 200.0)
REFUSED = Trial("refused", "InvalidInput: pressure of scale1_v1 is 1 MPa, but must be at least 2 MPa")
FAILED = Trial("failed", "a gap is negative", (0.1, 0.1, 0.1), 0.0, 1e-11, 3.0, 300.0)
SPEEDS = (1e-9, 1e-6, 1.0, 1e6, 1e9)


def sliding(speed: float, wrong: float) -> Trial:
    """Return a trial whose friction follows v and 1/v, but for ``wrong`` at the slowest speed."""
    friction = 2.0 * speed / (1.0 + speed * speed) * (1.0 + wrong * (speed == SPEEDS[0]))
    return replace(GOOD, friction=(friction, friction, friction))


def table(wrong: float = 0.0) -> pd.DataFrame:
    """Return a table with something of every panel, and one refusal and one failure."""
    rows = [row(Case(panel), GOOD) for panel in PANELS if panel != "limits"]
    for plane, kinematics, speed in product(("stress", "strain"), ("small", "finite"), SPEEDS):
        case = Case("limits", velocity=speed, plane=plane, kinematics=kinematics)
        rows.append(row(case, sliding(speed, wrong)))
    rows += [row(Case("corners", velocity=1.0), REFUSED), row(Case("corners", velocity=2.0), FAILED)]
    return pd.DataFrame(rows)


def test_row_holds_every_parameter_and_what_became_of_it() -> None:
    found = row(Case("corners", velocity=3.0, wavelength=2.0), GOOD)
    assert (found["velocity_mm_per_s"], found["wavelength_mm"], found["outcome"], found["bounds"]) == (
        3.0,
        2.0,
        "converged",
        "kept",
    )
    assert (found["friction_coefficient_contact"], found["cpu_s"], found["peak_memory_MiB"]) == (0.101, 2.0, 200.0)
    assert row(Case("corners"), REFUSED)["bounds"] == "no result"
    assert row(Case("corners"), FAILED)["bounds"] == "broken"


def test_counts_add_up() -> None:
    found = counts(table())
    assert found["cases"].sum() == len(table())
    assert sum(found[outcome].sum() for outcome in OUTCOMES) == len(table())
    assert found.set_index("panel").loc[PANELS["corners"], "failed"] == 1


def test_summary_ends_with_all() -> None:
    rows = summary(table())
    assert [len(line) for line in rows] == [8] * (len(PANELS) + 2)
    assert rows[-1] == ("all", str(len(table())), str(len(table()) - 2), "1", "1", "1.0%", "3.0 s", "300 MiB")


def test_limits_are_kept_where_friction_follows_the_speed() -> None:
    found = limits(table())
    assert len(found) == 8
    assert {limit.end for limit in found} == {"slow", "fast"}
    assert all(limit.kept and abs(limit.error) < 1e-4 for limit in found)


def test_limits_are_not_kept_where_it_does_not() -> None:
    found = limits(table(wrong=0.2))
    assert {limit.end for limit in found if not limit.kept} == {"slow"}
    assert all(limit.error == pytest.approx(1.0 / 1.2 - 1.0, rel=1e-3) for limit in found if not limit.kept)


def test_a_refused_end_is_not_a_kept_limit() -> None:
    given = table()
    given.loc[(given["panel"] == "limits") & (given["velocity_mm_per_s"] == 1e9), "friction_coefficient_second"] = (
        math.nan
    )
    assert not any(limit.kept for limit in limits(given) if limit.end == "fast")
    assert "no result" in page(given)


def test_page_names_failures_and_counts_refusals() -> None:
    said = page(table())
    assert f"- `{Case('corners', velocity=2.0).name}`: a gap is negative" in said
    assert "- 1 x InvalidInput: pressure of is # MPa, but must be at least # MPa" in said
    assert "All are kept." in said
    assert "4 are not kept." in page(table(wrong=0.2))
    assert "None." in page(table().query("outcome != 'failed'"))
