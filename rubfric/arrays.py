"""Names for the arrays in annotations; their shapes and units stand in the docstrings."""

from __future__ import annotations

from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

Real: TypeAlias = NDArray[np.floating[Any]]
Complex: TypeAlias = NDArray[np.complex128]
Whole: TypeAlias = NDArray[np.integer[Any]]
Flags: TypeAlias = NDArray[np.bool_]


def single(array: Any) -> Any:
    """Return a real or complex array in single precision."""
    return array.astype(np.complex64 if np.iscomplexobj(array) else np.float32)
