"""How finely a scene is solved: the accuracy asked for, the mesh on which to look for it, and their bounds."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Annotated, Any

from rubfric.rules import Choice, Integer, Number, check_fields

DILATATIONS = ("auto", "pointwise", "mean")
# Most columns that may be asked for.
MOST_COLUMNS = 2**20
# What a preset sets; the other fields of Numerics have their place under the config's key numerics.
PRESET_KEYS = ("accuracy", "contact_nodes", "finite_contact_nodes", "columns_min", "finite_columns_min", "row_growth")


def _columns(about: str) -> Integer:
    return Integer(about, 1, MOST_COLUMNS, step=8)


@dataclass(frozen=True)
class Numerics:
    """How finely a scene is solved: meaning, bounds and default of each field are written beside it.

    Raises
    ------
    InvalidInput
        For any value outside these bounds.

    Examples
    --------
    >>> import rubfric
    >>> rubfric.Numerics(accuracy=0.002).columns_max
    32768
    >>> rubfric.Numerics(accuracy=2)
    Traceback (most recent call last):
    rubfric.errors.InvalidInput: numerics.accuracy is 2, but must be at most 0.5
    """

    accuracy: Annotated[
        float,
        Number(
            "Relative accuracy of friction. It decides between small and finite strain, which Maxwell elements a scene "
            "needs, and how far its mesh is refined.",
            low=1e-6,
            high=0.5,
        ),
    ] = 0.01
    contact_nodes: Annotated[
        int,
        Integer(
            "Surface nodes inside the contact on the first mesh that may suffice, in small strain; the number of "
            "columns of cells follows from it.",
            4,
            4096,
        ),
    ] = 32
    finite_contact_nodes: Annotated[int, Integer("The same in finite strain.", 4, 4096)] = 16
    columns_min: Annotated[
        int, _columns("Fewest columns of cells along one wavelength on that mesh, in small strain.")
    ] = 128
    finite_columns_min: Annotated[int, _columns("The same in finite strain.")] = 64
    columns_max: Annotated[
        int, _columns("Most columns of cells along one wavelength; a result that needs more says so.")
    ] = 32768
    row_growth: Annotated[
        float, Number("Height of a row of cells over that of the row below it, on that mesh.", low=1.00001, high=3.0)
    ] = 1.2
    refinements: Annotated[
        int, Integer("Most finer meshes that may follow where the estimated error exceeds the accuracy.", 0, 12)
    ] = 3
    first_row: Annotated[
        float, Number("Height of the row of cells at the road over the width of a column.", low=0.01, high=100.0)
    ] = 1.0
    dilatation: Annotated[
        str,
        Choice(
            "How cells integrate dilatation, point by point or by its mean; auto takes the former in plane stress and "
            "the latter in plane strain, where the former would lock.",
            DILATATIONS,
        ),
    ] = "auto"
    folding: Annotated[
        float,
        Number(
            "Share of the accuracy that leaving out or gathering Maxwell elements may use, 0 to keep them all.",
            low=0.0,
            high=1.0,
        ),
    ] = 0.01
    tolerance: Annotated[
        float,
        Number(
            "Distance from balance and contact at which finite strain is solved, root mean square over the amplitude "
            "of the road.",
            low=1e-12,
            high=1e-2,
        ),
    ] = 1e-6
    output_columns: Annotated[
        int,
        _columns(
            "Most columns of cells that the fields in a result file keep; on a road of many waves, for every four of "
            "the finest."
        ),
    ] = 128

    def __post_init__(self) -> None:
        check_fields(self, "numerics.")
        fewest = max(self.columns_min, self.finite_columns_min)
        Integer(low=fewest).check("numerics.columns_max", self.columns_max)

    def __repr__(self) -> str:
        """Accuracy, and what is not as by default."""
        own = [(each.name, getattr(self, each.name), each.default) for each in fields(self)]
        changed = "".join(f", {name}={value!r}" for name, value, usual in own[1:] if value != usual)
        return f"Numerics(accuracy={self.accuracy!r}{changed})"


# The mesh of fineness 1: others have so many times as many nodes and columns, and rows that grow so much slower.
_NODES, _FINITE_NODES, _COLUMNS, _FINITE_COLUMNS, _GROWTH = 64, 32, 256, 128, 0.1


def fineness(value: float) -> dict[str, Any]:
    """Return what ``PRESET_KEYS`` say of the first mesh at some fineness, 0.5 being that of the preset ``standard``."""

    def columns(number: int) -> int:
        return max(8, 8 * round(number * value / 8))

    return {
        "contact_nodes": round(_NODES * value),
        "finite_contact_nodes": round(_FINITE_NODES * value),
        "columns_min": columns(_COLUMNS),
        "finite_columns_min": columns(_FINITE_COLUMNS),
        "row_growth": float(f"{1.0 + _GROWTH / value:.4g}"),
    }
