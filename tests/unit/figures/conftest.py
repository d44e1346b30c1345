"""Small made-up campaigns and results, and what figures are asked about."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import asdict
from itertools import combinations, product

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.text import Text
from synthetic_campaign import make_campaign, make_totals

from rubfric.figures import style
from rubfric.road.waves import WaveRoad

CampaignMaker = Callable[..., xr.Dataset]
ResultMaker = Callable[..., xr.Dataset]
TableMaker = Callable[..., pd.DataFrame]


@pytest.fixture(scope="session", name="make_campaign")
def campaign_maker() -> CampaignMaker:
    """Return a function that builds campaigns whose friction peaks at a known speed of the grid."""
    return make_campaign


@pytest.fixture(scope="session")
def make_result() -> ResultMaker:
    """Return a function that builds the result of a scene on a mesh of 16 by 5 cells, everywhere on the road.

    In finite strain the block leans: its upper face stays, and its lower face lags by the shear times the height.
    """

    def build(
        pressure: float = 1.0,
        speed: float = 10.0,
        scale: int = 1,
        aspect: float = 0.75,
        kinematics: str = "small",
        shear: float = 0.5,
    ) -> xr.Dataset:
        finite = kinematics == "finite"
        width, amplitude, columns, rows = 0.2, 0.015, 16, 6
        x, depth = np.linspace(0.0, width, columns + 1), aspect * width * np.linspace(0.0, 1.0, rows) ** 2
        wavenumber = 2.0 * np.pi / width
        decay = np.exp(-wavenumber * depth)[:, None]
        compression = 0.18 * pressure / (1.0 + 0.18 * pressure if finite else 1.0)
        lag = (shear if finite else 0.0) * (depth - depth[-1])[:, None] * np.ones_like(x)
        lift = amplitude * np.sin(wavenumber * (x + lag)) * decay - compression * depth[:, None]
        steady = 0.5 * pressure * compression
        density = steady * (1.0 + (0.5 + 0.4 * np.sin(wavenumber * x)) * decay)
        surface = np.linspace(0.0, width, 32, endpoint=False)
        return xr.Dataset(
            {
                "mesh_node_x": ("node", np.tile(x, rows)),
                "mesh_node_y": ("node", np.repeat(depth, columns + 1)),
                "displacement_x": ("node", lag.ravel()),
                "displacement_y": ("node", lift.ravel()),
                "strain_energy_density": ("node", density.ravel()),
                "strain_energy_density_profile": ("depth", density[:, :-1].mean(axis=1)),
                "road_height": ("surface_x", amplitude * np.sin(wavenumber * surface)),
                "contact_fraction": 0.275,
                "nominal_compression": compression,
                "pressed_energy_density": steady,
                "friction_coefficient": 0.3 - 0.1 * abs(np.log10(speed / 10.0)),
                "finite_strain": int(finite),
            },
            coords={"depth": depth, "surface_x": surface},
            attrs={
                "scene": "made up",
                "pressure": pressure,
                "velocity": speed,
                "scale": scale,
                "aspect": aspect,
                "kinematics_used": kinematics,
            },
        )

    return build


@pytest.fixture(scope="session")
def make_whole() -> ResultMaker:
    """Return a function that builds the result of a scene on a road of two waves, in contact on its three crests."""

    def build(pressure: float = 1.0, speed: float = 10.0, kinematics: str = "finite", refusal: str = "") -> xr.Dataset:
        road = WaveRoad(amplitudes=(0.015, 0.003), wavenumbers=(30.0, 140.0), phases=(0.0, 0.5))
        attributes = {"scene": "made up", "pressure": pressure, "velocity": speed, "scale": 0, "aspect": 0.75}
        attributes["scene_parameters"] = json.dumps({"road": asdict(road)})
        if refusal:
            return xr.Dataset(attrs=attributes | {"refusal": refusal})
        columns, rows = 112, 6
        x, depth = np.linspace(0.0, road.period, columns + 1), 0.15 * np.linspace(0.0, 1.0, rows) ** 2
        decay = np.exp(-30.0 * depth)[:, None]
        lift = np.maximum(road.height(x), 0.012) * decay - 0.05 * depth[:, None]
        density = 0.01 + 0.1 * pressure * (road.height(x) > 0.012) * decay
        surface = np.arange(224) * (road.period / 224)
        return xr.Dataset(
            {
                "mesh_node_x": ("node", np.tile(x, rows)),
                "mesh_node_y": ("node", np.repeat(depth, columns + 1)),
                "displacement_x": ("node", np.zeros(x.size * rows)),
                "displacement_y": ("node", lift.ravel()),
                "strain_energy_density": ("node", density.ravel()),
                "surface_position": ("surface_x", surface),
                "contact_pressure": ("surface_x", np.where(road.height(surface) > 0.012, 3.0 * pressure, 0.0)),
                "contact_fraction": 0.275,
                "friction_coefficient": 0.4321,
                "friction_coefficient_error": 0.0123,
                "finite_strain": int(kinematics == "finite"),
            },
            attrs=attributes,
        )

    return build


@pytest.fixture(scope="session")
def words() -> Callable[[Figure], list[str]]:
    """Return a function that lists all that is written in a figure, titles and legends included."""

    def read(figure: Figure) -> list[str]:
        return [text.get_text() for text in figure.findobj(Text)]

    return read


@pytest.fixture(scope="session")
def series() -> Callable[[Axes], list[tuple[list[float], list[float]]]]:
    """Return a function that lists the data of a panel's lines, marks left out."""

    def read(panel: Axes) -> list[tuple[list[float], list[float]]]:
        lines = (line for line in panel.get_lines() if line.get_gid() is None)
        return [(list(map(float, line.get_xdata())), list(map(float, line.get_ydata()))) for line in lines]

    return read


@pytest.fixture(scope="session", name="make_totals")
def totals_maker() -> TableMaker:
    """Return a function that builds tables of totals whose ways are known shares of the campaign's sum."""
    return make_totals


@pytest.fixture(scope="session")
def make_ladder() -> TableMaker:
    """Return a function that builds ladders of knobs: each rung divides the error by 4 and doubles the cost.

    The presets begin four times as coarse as ``standard``; scenes differ by known factors around 1.
    """

    def build(knobs: Sequence[str] = ("preset", "mesh", "surface", "kinematics"), scenes: int = 3) -> pd.DataFrame:
        named = {"preset": ("draft", "standard", "reference"), "kinematics": ("small", "finite", "auto")}
        rows = []
        for scene, knob in product(range(scenes), knobs):
            factor = 1.5 ** (scene - (scenes - 1) / 2)
            for place, rung in enumerate(named.get(knob, ("8", "16", "32", "64"))):
                row = {"scene": f"scene {scene}", "knob": knob, "rung": rung}
                row |= {"error": 0.04 * 4.0**-place * factor, "cost": 0.5 * 2.0**place, "note": ""}
                row |= {"reference": 0.1 * (scene + 1), "reference_error": 2e-4 * 0.1 * (scene + 1)}
                rows.append(row)
        return pd.DataFrame(rows)

    return build


@pytest.fixture(scope="session")
def make_calibration() -> TableMaker:
    """Return a function that builds runs whose estimates are 0.5, 2, 4 and 8 times their true errors, in each set."""

    def build(sets: Sequence[str] = ("outside", "ladder", "inside"), kinematics: str = "finite") -> pd.DataFrame:
        rows = []
        for name, place in product(sets, range(4)):
            error, ratio = 0.001 * 2.0**place, (0.5, 2.0, 4.0, 8.0)[place]
            row = {"scene": f"scene {place}", "set": name, "kinematics": kinematics if place else "small"}
            row |= {"error": error, "estimate": ratio * error, "ratio": ratio, "covered": ratio >= 1.0}
            rows.append(row | {"reference": 0.2, "reference_error": 0.2 * 0.0002})
        return pd.DataFrame(rows)

    return build


@pytest.fixture(scope="session")
def overlaps() -> Callable[[Figure], list[tuple[str, str]]]:
    """Return a function that lists the pairs of words of a figure, as it is saved, that cover each other.

    Words that leave the figure are paired with "the edge".
    """

    def find(figure: Figure) -> list[tuple[str, str]]:
        with style.applied():
            figure.draw_without_rendering()
            edge = figure.bbox.padded(0.5)
            boxes = [(text.get_text(), text.get_window_extent()) for text in _written(figure)]
        pairs = [(one, other) for (one, a), (other, b) in combinations(boxes, 2) if a.padded(-0.5).overlaps(b)]
        return pairs + [(one, "the edge") for one, a in boxes if not (edge.contains(*a.min) and edge.contains(*a.max))]

    return find


def _written(figure: Figure) -> list[Text]:
    """Return the words that are seen: no tick labels beyond the limits of an axis."""
    hidden = set()
    for axis in (axis for panel in figure.findobj(Axes) for axis in (panel.xaxis, panel.yaxis)):
        low, high = sorted(axis.get_view_interval())
        for ticks in (axis.get_major_ticks(), axis.get_minor_ticks()):
            for tick in ticks:
                seen = low * (1 - 1e-9) <= tick.get_loc() <= high * (1 + 1e-9)
                hidden |= {id(tick.label2)} | (set() if seen and tick.label1.get_visible() else {id(tick.label1)})
    texts = [text for text in figure.findobj(Text) if text.get_text().strip() and text.get_visible()]
    return [text for text in texts if id(text) not in hidden]
