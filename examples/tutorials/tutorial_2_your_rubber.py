"""
2. Your rubber
==============

You have storage and loss moduli from a laboratory (DMA), at some frequencies and
temperatures. This tutorial goes from that file to friction at the temperature you
care about, and to the part of the error that comes from the data.
"""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import rubfric
from rubfric.dma.fit import fit
from rubfric.dma.measurements import read
from rubfric.dma.result import Options

# %%
# Read the file
# -------------
#
# A table with frequency, temperature and two of storage modulus, loss modulus,
# complex modulus, tan δ and phase; units are read from the headings. What a file
# leaves open is asked for by name, never guessed. The one used here is synthetic,
# made from known constants with 1 % of noise, so that you can see what a fit
# recovers. Put the path of yours.

file = Path(rubfric.__file__).parents[1] / "examples" / "own_rubber" / "dma.csv"
data = read(str(file))
print(f"{len(data.storage)} points of {data.kind}, isotherms at {data.temperatures} °C")
for note in data.notes:
    print(f"note: {note}")

# %%
# Can the isotherms be shifted onto one another?
# ----------------------------------------------
#
# Look at this before any fit. In a plot of the loss factor over the modulus (van Gurp
# and Palmen) no frequency occurs: isotherms of a thermorheologically simple rubber
# fall on one curve. Where one leaves it, a filler network or a crystallising phase is
# at work, and no shift factor can mend that.

modulus, loss_factor = np.hypot(data.storage, data.loss), data.loss / data.storage
fig, ax = plt.subplots(figsize=(6.4, 4), layout="constrained")
colours = ax.scatter(
    modulus,
    loss_factor,
    c=data.temperatures[data.isotherm],
    cmap="coolwarm",
    s=16,
    ec="0.3",
    lw=0.3,
)
fig.colorbar(colours, ax=ax, label="temperature (°C)")
ax.set(
    xscale="log", xlabel="complex modulus |E*| (MPa)", ylabel="loss factor tan δ (-)"
)
plt.show()

# %%
# The fit
# -------
#
# Shift factors, relaxation times and moduli are fitted together, with as many
# branches as the Bayesian information criterion justifies. Three numbers tell whether
# to believe it: the residuals should be of the size of the noise; the law should have
# been recognised, not replaced by free shifts; and the warnings should be empty.

found = fit(data, Options(reference_temperature=20))
storage, loss = found.rms
print(f"{found.law}: C1 = {found.c1:.2f}, C2 = {found.c2:.1f} K (true: 6.84, 131.6 K)")
print(f"{len(found.times)} branches, {found.static:.2f} MPa at rest")
print(
    f"residuals: {storage:.1%} of the storage modulus, {loss:.1%} of the loss modulus"
)
slowest, fastest = found.window
print(f"measured: {slowest:.2g} to {fastest:.2g} rad/s at {found.reference:g} °C")
print(f"warnings: {', '.join(found.warnings) or 'none'}")

# %%
# The rubber in a campaign
# ------------------------
#
# In a config the file takes the place of the Prony series. ``uncertainty`` asks for
# so many bootstrap fits, which carry the scatter of the data into friction. Moduli in
# tension do not show the bulk modulus: by default Poisson's ratio is 0.49 and
# constant; ``bulk_modulus: 2000`` makes the other choice, and changes friction by
# some per cent.

rubber = {"measurements": str(file), "reference_temperature": 20, "uncertainty": 20}
campaign = rubfric.load(
    {"rubber": "mine", "rubbers": {"mine": rubber}, "kinematics": "small"}
)
velocities, temperatures = np.geomspace(0.1, 1e4, 11), [-10, 20, 60]


def slide(velocity, temperature):
    """Return friction on scale 1, its numerical error and that of the rubber's data."""
    result = rubfric.simulate(
        campaign.scene(1, velocity, 0.5, temperature=temperature, preset="draft")
    )
    names = (
        "friction_coefficient",
        "friction_coefficient_error",
        "friction_coefficient_rubber_error",
    )
    return [float(result[name]) for name in names]


friction = {at: np.array([slide(v, at) for v in velocities]).T for at in temperatures}

# %%
# The result
# ----------
#
# The bands add both errors. That of the data is small here, since the noise is; with
# 5 % of scatter it is what decides. Of friction that comes from frequencies beyond
# those measured *all* counts as uncertain, and from 1 % on the result carries a
# warning: measure colder or faster then.

fig, ax = plt.subplots(figsize=(6.8, 4.2), layout="constrained")
for at, colour in zip(temperatures, plt.cm.plasma([0, 0.45, 0.8]), strict=True):
    value, numerical, of_data = friction[at]
    ax.semilogx(velocities, value, color=colour, label=f"{at} °C")
    ax.fill_between(
        velocities,
        value - numerical - of_data,
        value + numerical + of_data,
        color=colour,
        alpha=0.3,
        lw=0,
    )
    parts = f"± {numerical[4]:.4f} (numerical) ± {of_data[4]:.4f} (data)"
    print(f"{at:3d} °C, 10 mm/s: {value[4]:.4f} {parts}")
ax.set(xlabel="sliding speed (mm/s)", ylabel="friction coefficient (-)", ylim=0)
ax.legend()
plt.show()

# %%
# What no error covers: a sample that is not the tread, strains of the test that are
# not those of the road (Payne effect: moduli are taken as linear), and heating by
# friction itself.
#
# From the shell
# --------------
#
# .. code-block:: sh
#
#    rubfric rubber fit dma.csv --name tread        # a config, and a page on the fit
#    snakemake -j2 --configfile rubber_tread.yaml   # the campaign
#    rubfric rubber read tread.inp --units MPa,s    # or from a deck of a FE code
#
# :doc:`/rubber` has every option, and how well fits were recovered in 200 random
# rubbers.
