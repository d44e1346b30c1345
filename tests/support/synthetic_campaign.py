"""Made-up campaigns whose friction is known in closed form."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product

import numpy as np
import pandas as pd
import xarray as xr

SPEEDS = (0.1, 1.0, 10.0, 100.0, 1000.0, 10000.0)
# From this speed on every scene carries a warning, mm/s.
WARNED = 10000.0


def make_campaign(
    scales: Sequence[int] = (1, 2, 3, 4),
    speeds: Sequence[float] = SPEEDS,
    pressures: Sequence[float] = (0.5, 1.0, 5.0),
    aspects: Sequence[float] = (0.25, 0.75, 1.5),
) -> xr.Dataset:
    """Return a campaign whose friction peaks at a known speed of the grid: mm/s, MPa."""
    axes = {"scale": list(scales), "velocity": list(speeds), "pressure": list(pressures), "aspect": list(aspects)}
    scale, speed, pressure, aspect = np.meshgrid(*axes.values(), indexing="ij")
    # The peak lies at 1000 mm/s at scale 1, at 100 mm/s at scale 2, and so on.
    distance = np.log10(speed) - (4.0 - scale)
    friction = 0.1 * scale * (1.0 + 0.1 * pressure) * np.exp(-0.3 * distance**2) * (1.0 + 0.01 / aspect)
    # 0.2 % at the slowest speed, and more the faster: 1.2 % at the last of six.
    error = friction * 0.002 * np.arange(1.0, len(speeds) + 1.0)[:, None, None]
    fields = {"friction_coefficient": friction, "friction_coefficient_error": error}
    fields["warnings"] = np.where(speed >= WARNED, 1.0, 0.0)
    variables: dict[str, object] = {name: (tuple(axes), field) for name, field in fields.items()}
    # Wavelengths of 0.2 mm, 0.1 mm, and so on.
    variables["wavenumber"] = ("scale", 2.0 * np.pi / 0.2 * 2.0 ** (np.array(scales) - 1.0))
    return xr.Dataset(variables, coords=axes)


def make_totals(
    campaign: xr.Dataset, refused: Sequence[tuple[float, float]] = (), drawn: bool = False, aspect: float = 0.75
) -> pd.DataFrame:
    """Return the totals of a campaign: all scales at once 0.7, cascade 0.9 and Persson 0.8 of the sum.

    Parameters
    ----------
    campaign : xarray.Dataset
    refused : sequence of tuple of float
        Pressures (MPa) and speeds (mm/s) at which the sum stands in for all scales at once.
    drawn : bool
        Whether totals are means over random phases.
    aspect : float
    """
    rows = []
    summed = campaign["friction_coefficient"].sel(aspect=aspect).sum("scale", skipna=False)
    for pressure, speed in product(campaign["pressure"].values, campaign["velocity"].values):
        total = float(summed.sel(pressure=pressure, velocity=speed))
        if np.isnan(total):
            continue
        gone = (pressure, speed) in refused
        shares = {"sum": 1.0, "direct": np.nan if gone else 0.7, "corrected": 0.75, "cascade": 0.9, "persson": 0.8}
        row = {"velocity_mm_per_s": speed, "pressure_MPa": pressure}
        row |= {f"friction_{way}": share * total for way, share in shares.items()}
        row |= {f"friction_{way}_error": 0.4 * total for way in ("sum", "corrected", "cascade", "persson")}
        row |= {"friction_direct_error": np.nan if gone else 0.01 * total}
        row |= {"friction_total": total if gone else 0.7 * total}
        row |= {"friction_total_error": (0.4 if gone else 0.01) * total}
        row |= {"friction_numerical_error": (0.01 if gone or not drawn else 0.005) * total}
        row |= {"friction_coupling_error": 0.39 * total if gone else 0.0}
        row |= {"friction_road_error": 0.005 * total if drawn and not gone else np.nan}
        row |= {"refused": int(gone), "warnings": int(speed >= WARNED) * (len(campaign["scale"]) + (not gone))}
        row |= {"way": "sum" if gone else "direct", "note": "no solution" if gone else "one road with these phases"}
        rows.append(row)
    return pd.DataFrame(rows)
