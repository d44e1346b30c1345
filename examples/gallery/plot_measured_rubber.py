"""
From DMA data to a rubber
=========================

*I have moduli from the laboratory, what now?* Isotherms are shifted onto one master
curve, and a Prony series is fitted to storage and loss modulus at once, with as many
branches as the data justify. What the fit misses is noise if it scatters about zero,
as here, and something else if it has a shape.
"""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import rubfric
from rubfric.dma.fit import fit
from rubfric.dma.measurements import read
from rubfric.dma.result import Options

# %%
# Ten isotherms of ten frequencies each. They were made with 1 % of noise, so that we
# know what should come out: C1 = 6.838 and C2 = 131.6 K.

file = Path(rubfric.__file__).parents[1] / "examples" / "own_rubber" / "dma.csv"
data = read(str(file))
found = fit(data, Options(reference_temperature=20))
print(
    f"{found.law}: C1 = {found.c1:.3f}, C2 = {found.c2:.1f} K,",
    len(found.times),
    "branches",
)

# %%
# The master curve at 20 °C, and what the fit misses.

reduced = data.frequency * 10 ** found.log_shifts[data.isotherm]
frequency = np.geomspace(reduced.min(), reduced.max(), 300)
storage, loss = found.moduli_at(frequency)

fig, (above, below) = plt.subplots(
    2, 1, figsize=(6.8, 5.6), height_ratios=[3, 1], sharex=True, layout="constrained"
)
above.loglog(frequency, storage, "k", lw=1, label="Prony series")
above.loglog(frequency, loss, "k", lw=1)
style = {
    "c": data.temperatures[data.isotherm],
    "cmap": "coolwarm",
    "s": 14,
    "edgecolor": "0.3",
    "lw": 0.3,
}
colours = above.scatter(
    reduced, data.storage, marker="o", label="storage modulus", **style
)
above.scatter(reduced, data.loss, marker="^", label="loss modulus", **style)
above.set(ylabel="E', E'' (MPa)")
above.legend()
fig.colorbar(colours, ax=above, label="temperature (°C)")
for residual, marker in zip(found.residuals, "o^", strict=True):
    below.scatter(reduced, 100 * residual, marker=marker, **style)
below.axhline(0, color="k", lw=0.8)
below.set(xlabel=r"reduced frequency $a_T\omega$ (rad/s)", ylabel="missed (%)")
plt.show()
