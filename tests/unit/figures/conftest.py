"""Small made-up campaigns and results, and what figures are asked about."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
import pytest
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.text import Text

CampaignMaker = Callable[..., xr.Dataset]
ResultMaker = Callable[..., xr.Dataset]

SPEEDS = (0.1, 1.0, 10.0, 100.0, 1000.0, 10000.0)


@pytest.fixture(scope="session")
def make_campaign() -> CampaignMaker:
    """Return a function that builds campaigns whose friction peaks at a known speed of the grid."""

    def build(
        scales: Sequence[int] = (1, 2, 3, 4),
        speeds: Sequence[float] = SPEEDS,
        pressures: Sequence[float] = (0.5, 1.0, 5.0),
        aspects: Sequence[float] = (0.25, 0.75, 1.5),
    ) -> xr.Dataset:
        axes = {"scale": list(scales), "velocity": list(speeds), "pressure": list(pressures), "aspect": list(aspects)}
        scale, speed, pressure, aspect = np.meshgrid(*axes.values(), indexing="ij")
        # The peak lies at 1000 mm/s at scale 1, at 100 mm/s at scale 2, and so on.
        distance = np.log10(speed) - (4.0 - scale)
        friction = 0.1 * scale * (1.0 + 0.1 * pressure) * np.exp(-0.3 * distance**2) * (1.0 + 0.01 / aspect)
        # 0.2 % at the slowest speed, and more the faster: 1.2 % at the last of six.
        error = friction * 0.002 * np.arange(1.0, len(speeds) + 1.0)[:, None, None]
        fields = {"friction_coefficient": friction, "friction_coefficient_error": error}
        return xr.Dataset({name: (tuple(axes), field) for name, field in fields.items()}, coords=axes)

    return build


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
