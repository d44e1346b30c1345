"""Make dma.csv: moduli of the paper's rubber (Table 1) as a laboratory might have measured them, with 1 % of noise."""

from __future__ import annotations

from pathlib import Path

import numpy as np

import rubfric
from rubfric.rubber.shift import Shift, ShiftedRubber

HERE = Path(__file__).resolve().parent
# A rubber with its glass transition at -60 degC and the constants 17.44 and 51.6 K there has these at 20 degC.
SHIFT = Shift("wlf", 20.0, c1=6.838, c2=131.6)
TEMPERATURES = (-50.0, -45.0, -40.0, -35.0, -30.0, -20.0, -10.0, 0.0, 10.0, 20.0)
HERTZ = np.geomspace(0.1, 100.0, 10)


def main() -> None:
    """Write dma.csv beside this file."""
    rubber = ShiftedRubber(rubfric.load(HERE.parents[1] / "config/config.yaml").material, SHIFT)
    noise = np.random.default_rng(2019)
    lines = [
        "Synthetic: moduli of the rubber of Zhou, Wang and Wei (2019), Table 1, with 1 % of noise; not a measurement",
        "Frequency,Temperature,E',E''",
        "Hz,°C,MPa,MPa",
    ]
    for temperature in TEMPERATURES:
        material = rubber.at(temperature)
        young = 2.0 * (1.0 + material.poissons_ratio) * material.complex_shear_modulus(2.0 * np.pi * HERTZ)
        scatter = 1.0 + 0.01 * noise.standard_normal((2, len(HERTZ)))
        for row in zip(HERTZ, young.real * scatter[0], young.imag * scatter[1], strict=True):
            lines.append(f"{row[0]:.4g},{temperature:g},{row[1]:.4g},{row[2]:.4g}")
    (HERE / "dma.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
