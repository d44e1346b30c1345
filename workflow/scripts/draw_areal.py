"""Draw contact maps of an areal road, and its friction and contact over speed, from the results of its scenes."""

from itertools import product

from rubfric.figures.areal import draw
from rubfric.figures.style import save
from rubfric.results.dataset import read


def main(results: list[str], digests: list[str], outputs: list[str]) -> None:
    """Draw the figure and save it under every path of ``outputs``.

    Parameters
    ----------
    results, digests : list of str
        Paths of the results (netCDF) of one road and one temperature, and the digests that they must have.
    outputs : list of str
        Paths; their endings choose the formats.
    """
    scenes = [read(path, digest) for path, digest in zip(results, digests, strict=True)]
    by_place = {(float(one.attrs["velocity"]), float(one.attrs["pressure"])): one for one in scenes}
    speeds, loads = (sorted({place[axis] for place in by_place}) for axis in (0, 1))
    corners = product(dict.fromkeys((speeds[0], speeds[-1])), dict.fromkeys((loads[0], loads[-1])))
    curves = [[by_place[speed, load] for speed in speeds] for load in loads]
    save(draw([by_place[corner] for corner in corners], curves), *outputs)
