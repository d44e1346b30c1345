"""An areal scan: heights on a grid, of which a line is a profile."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rubfric.arrays import Real
from rubfric.errors import InvalidInput
from rubfric.profile.measured import Profile


@dataclass(frozen=True, eq=False)
class Scan:
    """Heights on a grid.

    Attributes
    ----------
    source : str
        Where they come from, for messages.
    spacing : tuple of float, shape (2,)
        Along x and along y, mm.
    heights : ndarray, shape (lines, points)
        mm, a row for each y; NaN where nothing was measured. A profile has one row.
    """

    source: str
    spacing: tuple[float, float]
    heights: Real

    def line(self, direction: str = "x", number: int | None = None) -> Profile:
        """Return a line as a profile, which says which one it is.

        Parameters
        ----------
        direction : {"x", "y"}
            Of the line.
        number : int, optional
            From 1; the middle one by default.

        Raises
        ------
        InvalidInput
            For a line that there is not.
        """
        lines = self.heights if direction == "x" else self.heights.T
        chosen = (len(lines) + 1) // 2 if number is None else number
        if not 1 <= chosen <= len(lines):
            raise InvalidInput(
                f"--line is {chosen}, but {self.source} has {len(lines)} lines along {direction}, numbered from 1"
            )
        spacing = self.spacing[0 if direction == "x" else 1]
        note = f"line {chosen} of {len(lines)} along {direction}, of {lines.shape[1]} points"
        notes = (note,) if self.heights.shape[0] > 1 else ()
        return Profile(self.source, 0.0, spacing, np.array(lines[chosen - 1], dtype=float), notes)
