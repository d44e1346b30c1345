"""Make street.csv: a self-affine profile as a laser profilometer might have measured it."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from rubfric.profile.virtual import as_measured, self_affine

SEED, POINTS, SPACING = 16, 10_000, 0.05
# H, C at 1/mm (mm³), and the wavelength beyond which the spectrum is flat, mm.
HURST, LEVEL, ROLL_OFF = 0.8, 0.02, 20.0
# mm, mm of height per mm.
NOISE, TILT = 0.003, 0.004


def main() -> None:
    """Write street.csv beside this file."""
    rng = np.random.default_rng(SEED)
    place = SPACING * np.arange(POINTS)
    road = self_affine(rng, POINTS, SPACING, HURST, LEVEL, longest=ROLL_OFF)
    heights = road + TILT * place + 12.0 + NOISE * rng.standard_normal(POINTS)
    measured, _ = as_measured(rng, heights, dropouts=60, longest=15, spikes=25, spike=1.5)
    lines = ["Synthetic: a self-affine profile with dropouts, spikes, tilt and noise; not a measurement"]
    lines += ["distance (mm),height (mm)"]
    lines += [f"{x:.2f},{'' if np.isnan(z) else f'{z:.4f}'}" for x, z in zip(place, measured, strict=True)]
    (Path(__file__).resolve().parent / "street.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
