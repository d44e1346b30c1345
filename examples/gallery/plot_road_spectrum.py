"""
What a measured profile is worth
================================

*Down to which wavelength may I believe my profilometer?* The spectrum of a
self-affine road is a straight line over decades. Where it flattens towards long waves
the road rolls off; where it flattens towards short waves there is noise. Between lies
the trusted band, and the Hurst exponent belongs to it alone: 0.81 ± 0.03 here, where
0.8 was put in.
"""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import rubfric
from rubfric.profile.analysis import analyse
from rubfric.profile.cleaning import clean
from rubfric.profile.reading import read

# %%
# A synthetic road of the clone, with the dropouts, spikes, tilt and noise of an
# instrument. Cleaning counts all that it removes.

street = Path(rubfric.__file__).parents[1] / "examples" / "own_road" / "street.csv"
cleaned = clean(read(str(street)))
for what, how_much in cleaned.removed:
    print(f"{what}: {how_much}")
found = analyse(cleaned)
print(f"Hurst exponent {found.hurst.exponent:.2f} ± {found.hurst.error:.2f}")

# %%
# Heights above, the spectrum of these heights with its 95 % interval below.

fig, (profile, spectrum) = plt.subplots(
    2, 1, figsize=(6.8, 5.6), height_ratios=[1, 2], layout="constrained"
)
profile.plot(cleaned.profile.distances, cleaned.profile.heights, lw=0.6)
profile.set(
    xlabel="distance (mm)", ylabel="height (mm)", xlim=(0, cleaned.profile.length)
)

bins = found.spectrum.binned()
spectrum.loglog(
    bins.wavenumbers, bins.density, label="spectrum, with its 95 % interval"
)
spectrum.fill_between(bins.wavenumbers, *bins.interval(), alpha=0.3)
spectrum.axvspan(
    found.band.low, found.band.high, color="C2", alpha=0.15, label="trusted"
)
q = np.geomspace(found.hurst.low, found.hurst.high, 2)
line = found.hurst.level * (q / found.hurst.reference) ** (
    -1 - 2 * found.hurst.exponent
)
spectrum.loglog(q, line, "k--", label=f"self-affine, H = {found.hurst.exponent:.2f}")
spectrum.set(xlabel="wavenumber q (1/mm)", ylabel="spectral density C(q) (mm³)")
spectrum.legend()
plt.show()
