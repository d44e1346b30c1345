"""Add speeds to a curve of friction until it is known between them."""

from typing import Any

from rubfric.curve_simulation import added_points, sliding_of
from rubfric.results.kept import opened, place
from rubfric.results.tables import write_table


def main(
    output: str,
    scales: dict[str, str],
    whole: dict[str, dict[str, str]],
    sliding: dict[str, Any],
    accuracy: float,
    results: str,
) -> None:
    """Write friction at the added speeds.

    Parameters
    ----------
    output : str
        Path of the table (CSV).
    scales, whole : dict
        Paths of the grid's results (netCDF), and the digests that they must have; of the whole road by the name of the
        draw or window, which is empty for one road.
    sliding : dict
        Arguments of ``sliding_of``.
    accuracy : float
        Relative, of interpolation.
    results : str
        Folder of the campaign's results, where those at added speeds are kept.
    """
    with opened(place(results)) as kept:
        table = added_points(sliding_of(**sliding), scales, whole, accuracy, kept)
    write_table(table, output)
    print(f"{len(table)} speeds added")
