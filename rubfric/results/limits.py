"""How many speeds are added to a curve of friction; by itself, since what plans a run needs it and nothing heavy."""

from __future__ import annotations

MOST = 24
