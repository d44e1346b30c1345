"""The deformed block of a scene, thinned and in whole numbers, and many of them packed into one text."""

from __future__ import annotations

import base64
import zlib
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from rubfric.errors import InvalidInput
from rubfric.figures.deformation import VARIABLES, DeformedBlock, deform, is_finite, profile, wavelength

Array = NDArray[np.float64]

# What a picture needs of a result.
NEEDED = (*VARIABLES, "surface_position", "contact_pressure")
# Numbers are stored in steps of the range that they span: a hundredth of a pixel of a picture.
STEPS = 16383
# Width of the picture in wavelengths, and the points of the contact that it keeps of each.
_WIDTH, _TOUCHING = 1.25, 190
# The whole road keeps this many times as many columns as a scale, and lines of the net to a coarsest wavelength.
WIDER, _LINES = 6, 8
# And is as wide as this share of the height at most: a window of a measured road is longer than its block is high.
_LINES_UP = 0.25
# Density is drawn on a logarithmic scale; below this share of a scene's largest there is nothing to see.
_NEGLIGIBLE = 1e-7
# Share of the nodes, in per cent, with the lowest density, which would take most of that scale.
_LOWEST = 3.0


@dataclass(frozen=True)
class Picture:
    """A picture as the page wants it.

    Attributes
    ----------
    about : dict
        ``finite``; ``rows`` and ``columns`` of nodes; ``net``, the numbers of points of its lines; ``touching``, the
        number of points of the contact; ``floor``, below which the lowest of the energies lie. ``x``, ``y`` (mm),
        ``energy`` (decimal logarithm of MPa) and ``pressure`` (MPa): lowest and highest value of each.
    values : numpy.ndarray of uint16
        Abscissae, heights and energies of the nodes, row by row; abscissae and heights of the net; abscissae and
        pressures of the contact; 0 for the lowest and ``STEPS`` for the highest.
    """

    about: dict[str, Any]
    values: NDArray[np.uint16]


@dataclass
class Store:
    """Numbers of many pictures in a row."""

    values: list[NDArray[np.uint16]] = field(default_factory=list)
    size: int = 0

    def add(self, picture: Picture) -> dict[str, Any]:
        """Keep the numbers of a picture; return what is said about it, and where they begin."""
        begin = self.size
        self.values.append(picture.values)
        self.size += picture.values.size
        return picture.about | {"begin": begin}

    def packed(self) -> str:
        """Return all numbers as text: differences, their high bytes, then their low bytes, deflated, in base 64."""
        everything = np.concatenate([np.zeros(1, np.uint16), *self.values])
        differences = np.diff(everything)  # modulo 2**16
        split = np.concatenate([differences >> 8, differences & 255]).astype(np.uint8)
        return deflated(split.tobytes())


def deflated(values: bytes) -> str:
    """Return bytes as text that the page inflates: deflated, in base 64."""
    return base64.b64encode(zlib.compress(values, 9)).decode("ascii")


def picture(result: xr.Dataset, rows: int, columns: int) -> Picture:
    """Return the picture of a scene: one and a quarter wavelengths about a crest, or one period of the whole road.

    Parameters
    ----------
    result : xarray.Dataset
        As built by ``rubfric.results.dataset.build``.
    rows, columns : int
        Most nodes over the height and along a wavelength; ``WIDER`` times as many along a period of the whole road.

    Raises
    ------
    InvalidInput
        For a result that lacks something.
    """
    lacking = [name for name in NEEDED if name not in result]
    if lacking:
        raise InvalidInput(f"the result {result.attrs.get('scene', 'without a name')} lacks {', '.join(lacking)}")
    whole = is_whole(result)
    left, right = stretch(result)
    height = float(np.ptp(result["mesh_node_y"].values))
    pitch = min(profile(result).wavelength / _LINES, _LINES_UP * height) if whole else None
    block = deform(result, left, right, pitch)
    longer = WIDER if whole else _WIDTH
    across = _evenly(block.x.shape[1], round(longer * columns))
    up = _evenly(block.x.shape[0], rows)
    x, y, density = (grid[np.ix_(up, across)] for grid in (block.x, block.y, block.density))
    energy = np.log10(np.maximum(density, max(_NEGLIGIBLE * float(density.max()), np.finfo(np.float64).tiny)))
    net = [line[:, _evenly(line.shape[1], max(rows, columns))] for line in _inside(block, left, right)]
    touching, pressure = _contact(result, left, right, round(longer * _TOUCHING))
    sheets = [np.concatenate([grid.ravel(), *(line[place] for line in net)]) for place, grid in enumerate((x, y))]
    spans = {"x": _span(np.append(sheets[0], touching)), "y": _span(sheets[1])}
    spans |= {"energy": _span(energy), "pressure": (0.0, float(pressure.max(initial=0.0)))}
    parts = [(sheets[0], "x"), (sheets[1], "y"), (energy, "energy"), (touching, "x"), (pressure, "pressure")]
    about: dict[str, Any] = {
        "finite": is_finite(result),
        "rows": up.size,
        "columns": across.size,
        "net": [line.shape[1] for line in net],
        "touching": touching.size,
        "floor": float(np.percentile(energy, _LOWEST)),
    }
    values = np.concatenate([_whole(part.ravel(), *spans[name]) for part, name in parts])
    return Picture(about | {name: list(span) for name, span in spans.items()}, values)


def is_whole(result: xr.Dataset) -> bool:
    """Return whether a scene slides over all scales at once."""
    return int(result.attrs["scale"]) == 0


def stretch(result: xr.Dataset) -> tuple[float, float]:
    """Return the ends of the picture, mm."""
    width = wavelength(result)
    if is_whole(result):
        return 0.0, width
    return (0.25 - 0.5 * _WIDTH) * width, (0.25 + 0.5 * _WIDTH) * width


def _evenly(size: int, most: int) -> NDArray[np.intp]:
    """Return at most ``most`` places out of ``size``, evenly spaced, both ends included."""
    return np.unique(np.linspace(0, size - 1, min(size, max(most, 2))).round().astype(np.intp))


def _inside(block: DeformedBlock, left: float, right: float) -> list[Array]:
    """Return the lines of the net that are seen."""
    return [line for line in block.net if line[0].max() > left and line[0].min() < right]


def _contact(result: xr.Dataset, left: float, right: float, most: int) -> tuple[Array, Array]:
    """Return where the surface touches the road, each stretch between points without pressure, and the pressure."""
    width = wavelength(result)
    order = np.argsort(result["surface_position"].values)
    place, pressure = (result[name].values[order] for name in ("surface_position", "contact_pressure"))
    copies = np.arange(np.floor((left - place[-1]) / width), np.ceil((right - place[0]) / width) + 1.0)
    x, p = (place + width * copies[:, None]).ravel(), np.tile(pressure, copies.size)
    beside = np.concatenate(([0.0], p[:-1])) + np.concatenate((p[1:], [0.0]))
    kept = np.flatnonzero((x >= left) & (x <= right) & (p + beside > 0.0))
    thinned = kept[_evenly(kept.size, most)] if kept.size else kept
    if kept.size:
        ends = kept[(p[kept] == 0.0) | (p[kept] == p[kept].max())]
        thinned = np.union1d(thinned, ends)
    return x[thinned], p[thinned]


def _span(values: Array) -> tuple[float, float]:
    return float(values.min()), float(values.max())


def _whole(values: Array, low: float, high: float) -> NDArray[np.uint16]:
    """Return values in whole steps of their range."""
    return np.rint((values - low) * (STEPS / (high - low) if high > low else 0.0)).astype(np.uint16)
