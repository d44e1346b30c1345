"""What planning a run needs to know of curves of friction, without anything heavy."""

from __future__ import annotations

# So many speeds are added to a curve at most.
MOST = 24
# How the curves of the whole road are named.
WHOLE = "whole road"
