"""Peaks are named only where the points show one."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from rubfric.results.selection import find_peak

NAN = float("nan")


@pytest.mark.parametrize(
    ("friction", "error", "kind", "at", "between"),
    [
        ([0.1, 0.3, 0.2], 0.01, "peak", 1, (0, 2)),
        ([0.1, 0.2, 0.3, 0.2, 0.1], 0.01, "peak", 2, (1, 3)),
        # Two points that cannot be told apart widen the stretch in which the peak lies.
        ([0.1, 0.295, 0.3, 0.2, 0.1], 0.01, "peak", 2, (0, 3)),
        ([0.1, 0.27, 0.3, 0.2, 0.1], 0.01, "peak", 2, (1, 3)),
        ([0.1, 0.2, 0.3], 0.01, "rising", 2, None),
        ([0.1, 0.295, 0.3], 0.01, "rising", 2, None),
        ([0.3, 0.2, 0.1], 0.01, "falling", 0, None),
        # The last point may be as high as the highest.
        ([0.1, 0.3, 0.29], 0.01, "level", 1, None),
        ([0.3, 0.29, 0.3], 0.0, "level", 0, None),
        ([0.2, 0.2, 0.2], 0.0, "level", 0, None),
        ([0.0, 0.0, 0.0], 0.0, "level", 0, None),
        ([0.1, 0.2], 0.01, "few", 1, None),
        ([0.2], 0.01, "few", 0, None),
        ([NAN, NAN], 0.01, "none", None, None),
        # Gaps are passed over, and widen the stretch.
        ([0.1, NAN, 0.3, NAN, 0.1], 0.01, "peak", 2, (0, 4)),
        ([NAN, 0.1, 0.3, 0.2, NAN], 0.01, "peak", 2, (1, 3)),
        ([NAN, 0.3, 0.2, 0.1], 0.01, "falling", 1, None),
        ([0.1, NAN, 0.3], 0.01, "few", 2, None),
    ],
)
def test_peak_is_what_points_and_errors_allow(
    friction: list[float], error: float, kind: str, at: int | None, between: tuple[int, int] | None
) -> None:
    found = find_peak(np.array(friction), np.full(len(friction), error))
    assert (found.kind, found.at, found.between) == (kind, at, between)
    assert found.missing == int(np.isnan(friction).sum())


def test_unknown_error_counts_as_none() -> None:
    assert find_peak(np.array([0.1, 0.3, 0.29]), np.full(3, NAN)).kind == "peak"


def test_larger_errors_never_narrow_the_stretch(rng: np.random.Generator) -> None:
    for _ in range(200):
        friction = rng.random(8)
        stretches = [find_peak(friction, np.full(8, error)).between for error in (0.0, 0.01, 0.03, 0.1)]
        assert stretches[0] is None or stretches[0][1] - stretches[0][0] == 2
        for narrow, wide in pairwise(stretches):
            assert narrow is not None or wide is None
            if narrow and wide:
                assert wide[0] <= narrow[0] < narrow[1] <= wide[1]
