"""Small made-up campaigns and results for the page."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import asdict

import numpy as np
import pytest
import xarray as xr

from rubfric.road.waves import WaveRoad

CampaignMaker = Callable[..., xr.Dataset]
ResultMaker = Callable[..., xr.Dataset]

NUMBERS = (
    *("friction_coefficient_dissipation", "friction_coefficient_contact", "energy_closure", "contact_fraction"),
    *("maximum_contact_pressure", "maximum_local_contact_pressure", "nominal_compression", "finite_strain"),
    *("columns", "rows"),
)


@pytest.fixture(scope="session")
def make_campaign() -> CampaignMaker:
    """Return a function that builds campaigns whose friction peaks at 10 mm/s, with an error of 1 %."""

    def build(
        scales: Sequence[int] = (1, 2),
        speeds: Sequence[float] = (1.0, 10.0, 100.0),
        pressures: Sequence[float] = (0.5, 5.0),
        aspects: Sequence[float] = (0.5, 0.75),
    ) -> xr.Dataset:
        axes = {"scale": list(scales), "velocity": list(speeds), "pressure": list(pressures), "aspect": list(aspects)}
        scale, speed, pressure, aspect = np.meshgrid(*axes.values(), indexing="ij")
        friction = 0.1 * scale * aspect * (1.0 + 0.1 * pressure) * np.exp(-((np.log10(speed) - 1.0) ** 2))
        fields = {"friction_coefficient": friction, "friction_coefficient_error": 0.01 * friction}
        fields |= {name: np.full(friction.shape, 0.5 + place) for place, name in enumerate(NUMBERS)}
        road = {
            "amplitude": ("scale", [0.01 / one for one in scales]),
            "wavenumber": ("scale", [35.0 * n for n in scales]),
        }
        about = {
            "rubber": "made up",
            "plane": "stress",
            "kinematics": "auto",
            "numerics": json.dumps({"accuracy": 0.01}),
        }
        return xr.Dataset({name: (tuple(axes), field) for name, field in fields.items()} | road, axes, about)

    return build


@pytest.fixture(scope="session")
def make_result() -> ResultMaker:
    """Return a function that builds the result of a scene on a mesh of 32 by 9 cells, on the crest of the road."""

    def build(
        scale: int = 1, speed: float = 10.0, pressure: float = 0.5, finite: bool = True, touching: float = 0.3
    ) -> xr.Dataset:
        width, amplitude = 2.0 * np.pi / 35.0 / scale, 0.01 / scale
        x, depth = np.linspace(0.0, width, 33), 0.75 * width * np.linspace(0.0, 1.0, 10) ** 2
        wave = amplitude * np.sin(2.0 * np.pi * x / width)
        decay = np.exp(-depth / width)[:, None]
        lag = 0.3 * (depth - depth[-1])[:, None] * np.ones_like(x) * finite
        surface = np.linspace(0.0, width, 64, endpoint=False)
        distance = np.abs(surface - 0.25 * width) / width
        load = np.sqrt(np.maximum(0.0, 1.0 - (2.0 * distance / touching) ** 2)) * 3.0 * pressure
        density = pressure * (0.01 + decay * (1.1 + np.sin(2.0 * np.pi * x / width)))
        return xr.Dataset(
            {
                "mesh_node_x": ("node", np.tile(x, 10)),
                "mesh_node_y": ("node", np.repeat(depth, 33)),
                "displacement_x": ("node", lag.ravel()),
                "displacement_y": ("node", (wave * decay).ravel()),
                "strain_energy_density": ("node", density.ravel()),
                "surface_position": ("surface_x", surface),
                "contact_pressure": ("surface_x", load),
                "finite_strain": int(finite),
            },
            attrs={
                **{"scene": "made up", "scale": scale, "velocity": speed, "pressure": pressure, "aspect": 0.75},
                **{"kinematics_reason": "it was asked for", "warnings": "Beware.\nOf two things."},
            },
        )

    return build


@pytest.fixture(scope="session")
def make_whole_result() -> ResultMaker:
    """Return a function that builds the result of a scene on a road of two waves, in contact on its crests."""

    def build(speed: float = 10.0, pressure: float = 0.5, finite: bool = True) -> xr.Dataset:
        road = WaveRoad(amplitudes=(0.01, 0.003), wavenumbers=(35.0, 87.5), phases=(0.0, 0.4))
        x, depth = np.linspace(0.0, road.period, 81), 0.13 * np.linspace(0.0, 1.0, 10) ** 2
        decay = np.exp(-20.0 * depth)[:, None]
        surface = np.arange(160) * (road.period / 160)
        load = 3.0 * pressure * (road.height(surface) > 0.008)
        return xr.Dataset(
            {
                "mesh_node_x": ("node", np.tile(x, 10)),
                "mesh_node_y": ("node", np.repeat(depth, 81)),
                "displacement_x": ("node", np.zeros(x.size * 10)),
                "displacement_y": ("node", (np.maximum(road.height(x), 0.008) * decay).ravel()),
                "strain_energy_density": ("node", (0.01 + decay * (1.1 + np.sin(35.0 * x))).ravel()),
                "surface_position": ("surface_x", surface),
                "contact_pressure": ("surface_x", load),
                "finite_strain": int(finite),
            },
            attrs={
                **{"scene": "made up", "scale": 0, "velocity": speed, "pressure": pressure, "aspect": 0.75},
                **{"kinematics_reason": "it was asked for", "warnings": "Beware.\nOf two things."},
                "scene_parameters": json.dumps({"road": asdict(road)}),
            },
        )

    return build
