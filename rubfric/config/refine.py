"""What the config's ``grid.refine`` is bound by."""

from __future__ import annotations

# So many speeds are added to a curve of friction over speed at most.
MOST = 24
