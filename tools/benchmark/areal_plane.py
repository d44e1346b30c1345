"""Show what the plane costs: friction on self-affine surfaces beside that of their profiles, and Persson's theory.

For three Hurst exponents a surface is slid over in three dimensions, and sixteen of its profiles as ridges in plane
strain, both in small strain, under a block of the same height. Draws docs/areal.png too: maps of contact, and friction
and contact over speed.
"""

from __future__ import annotations

import json
import os

for threads in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[threads] = "1"

import numpy as np
import tables

from rubfric.areal_plane import slide_profiles
from rubfric.areal_simulation import simulate_areal
from rubfric.config.campaign import load
from rubfric.figures import areal, style
from rubfric.markdown import markdown_table
from rubfric.results.areal_table import areal_table
from rubfric.road.self_affine import SelfAffine
from rubfric.scene.areal import ArealNumerics, ArealScene

HURST, VELOCITIES, PRESSURES = (0.5, 0.8, 1.0), (1.0, 10.0, 100.0, 1000.0, 1e4), (0.3, 1.0)
# Nodes along a side of the surface, its profiles, and its shortest wave.
SIDE, PROFILES, CUT_OFF = 512, 16, 1.0 / 32
CURVES = tuple(10.0**power for power in np.arange(-1.0, 4.01, 0.5))


def road(hurst: float) -> SelfAffine:
    """Return a surface of rms slope 0.25."""
    return SelfAffine(hurst=hurst, period=1.0, cut_off=CUT_OFF, rms_slope=0.25)


def surface(hurst: float, velocity: float, pressure: float) -> ArealScene:
    """Return a scene on a surface."""
    rubber = load(tables.DOCS.parent / "config/config.yaml").scene(1, velocity, pressure).material
    return ArealScene(road(hurst), velocity, pressure, rubber, numerics=ArealNumerics(nodes_max=SIDE))


def figure() -> None:
    """Draw docs/areal.png."""
    corners = [(velocity, pressure) for velocity in (1.0, 1000.0) for pressure in PRESSURES]
    maps = [simulate_areal(surface(0.8, *corner)) for corner in corners]
    curves = [[simulate_areal(surface(0.8, float(one), pressure)) for one in CURVES] for pressure in PRESSURES]
    every = [one for each in curves for one in each]
    beside = areal_table(
        every,
        [
            slide_profiles(ArealScene.from_parameters(json.loads(one.attrs["scene_parameters"])), PROFILES)
            for one in every
        ],
    )
    (tables.DOCS / "areal.png").write_bytes(style.png(areal.draw(maps, curves, beside), 150.0))


def main() -> None:
    """Measure, print, publish and draw."""
    tables.options(__doc__)
    rows: list[tuple[str, ...]] = [
        (
            "Hurst",
            "MPa",
            "mm/s",
            "surface",
            "profiles",
            "over surface",
            "S = 1",
            "gamma = 1/2",
            "contact",
            "profiles'",
            "theory's",
        )
    ]
    for hurst in HURST:
        for pressure in PRESSURES:
            for velocity in VELOCITIES:
                scene = surface(hurst, velocity, pressure)
                found = simulate_areal(scene)
                plane = slide_profiles(scene, PROFILES)
                frictions = plane.friction_coefficient.values
                true, mean = float(found.friction_coefficient), float(np.mean(frictions))
                scatter = float(np.std(frictions, ddof=1)) / np.sqrt(len(frictions))
                rows.append(
                    (
                        f"{hurst:g}",
                        f"{pressure:g}",
                        f"{velocity:g}",
                        f"{true:.4f} ± {float(found.friction_error):.4f}",
                        f"{mean:.4f} ± {scatter:.4f}",
                        f"{mean / true:.2f}",
                        f"{float(found.persson_friction) / true:.2f}",
                        f"{float(found.persson_friction_reduced) / true:.2f}",
                        f"{float(found.contact_fraction):.3f}",
                        f"{float(plane.contact_fraction.mean()):.3f}",
                        f"{float(found.persson_contact_fraction):.3f}",
                    )
                )
                print(" | ".join(rows[-1]), flush=True)
    text = (
        f"{markdown_table(rows, numeric=True)}\n\n"
        f"Self-affine surfaces of rms slope 0.25, period 1 mm and cut-off {1e3 * CUT_OFF:.3g} µm, the rubber of the "
        f"shipped config, block height 0.75 mm, small strain. Profiles: mean of {PROFILES} in plane strain, with its "
        f"standard error. Over surface: friction of profiles, and of Persson's theory, over that of the surface."
    )
    tables.publish("areal_plane", text, "areal_road.md")
    figure()


if __name__ == "__main__":
    main()
