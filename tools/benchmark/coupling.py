"""Calibrate what a total that leaves out the coupling of scales is worth, and put the tables into docs/multiscale.md.

Small strain: the ways from scales to the total against the direct one on the closed-form layer, over the paper's grid,
both planes, three rubbers and three roads; and the layer itself against the block on its mesh, on a sample. Finite
strain: the total of single scales against the direct scene, which ``--measure`` solves where
docs/coupling_references.csv lacks them (minutes each where contact is heavy).
"""

from __future__ import annotations

import os

for threads in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[threads] = "1"

import argparse
import time
from dataclasses import replace
from itertools import product

import numpy as np
import pandas as pd
import tables

from rubfric.arrays import Real
from rubfric.config.campaign import Campaign, load
from rubfric.errors import RubfricError
from rubfric.markdown import markdown_table
from rubfric.mechanics.theory.coupling import Coupling, estimate
from rubfric.road.sine import SineScale
from rubfric.road.waves import WaveRoad
from rubfric.rubber.material import PLANES, Material
from rubfric.scene.scene import Scene
from rubfric.simulation import simulate

REFERENCES = tables.DOCS / "coupling_references.csv"
POINT = ["case", "plane", "velocity", "pressure"]
# The models of the coupling; the corrected sum is the direct total of small strain.
WAYS = ("sum", "cascade", "persson")
# Speeds and pressures at which the other rubbers and roads are solved in finite strain.
OTHERS = ((1e4, 1.0), (1e3, 0.5), (1e3, 2.0), (100.0, 0.2), (10.0, 0.1))
Place = tuple[str, float, float]
# One point in so many of the grids goes to a mesh in small strain.
SAMPLE = 23
PERCENT = (50, 95, 100)
HEADS = ["way", *(f"error, {q} %" for q in PERCENT), "covered", "bound / error, 5 %", "50 %", "95 %"]


def main() -> None:
    """Measure what is asked for, then publish."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--measure", action="store_true", help="solve missing scenes in finite strain first")
    campaign = load(tables.DOCS.parent / "config/config.yaml")
    if parser.parse_args().measure:
        measure(campaign)
    text = "\n\n".join((curve(campaign), small(campaign), finite(campaign), f"{tables.machine()}."))
    tables.publish("coupling", text, "multiscale.md")
    print(text)


def grid(campaign: Campaign) -> list[Place]:
    """Return plane, speed and pressure of the paper's grid, the light and fast first: they take least."""
    return sorted(product(PLANES, campaign.velocities, campaign.pressures), key=lambda at: at[2] / at[1] ** 0.4)


def coupling(campaign: Campaign, case: str, at: Place, kinematics: str) -> Coupling:
    """Return the coupling of a case at a place."""
    (material, road), (plane, velocity, pressure) = cases(campaign)[case], at
    return estimate(material, road, velocity, pressure, campaign.aspect * road.wavelength, plane, kinematics)


def cases(campaign: Campaign) -> dict[str, tuple[Material, WaveRoad]]:
    """Return rubbers and roads by name, the campaign's own first."""
    return {
        f"{rubber}, {road}": (material, waves)
        for (rubber, material), (road, waves) in product(rubbers(campaign).items(), roads(campaign).items())
    }


def measure(campaign: Campaign) -> None:
    """Add to the references what the draft preset finds in finite strain: sum and direct total, or a refusal."""
    known = pd.read_csv(REFERENCES, dtype={"note": str}) if REFERENCES.exists() else pd.DataFrame(columns=POINT)
    done = set(known[POINT].itertuples(index=False, name=None))
    names = list(cases(campaign))
    wanted = [(case, *at) for case in names[1:] for at in grid(campaign) if at[1:] in OTHERS]
    for point in (*wanted, *((names[0], *at) for at in grid(campaign))):
        if point not in done:
            known = pd.concat([known, pd.DataFrame([solved(campaign, *point)])], ignore_index=True)
            known.to_csv(REFERENCES, index=False, float_format="%.5g")


def solved(campaign: Campaign, case: str, plane: str, velocity: float, pressure: float) -> dict[str, object]:
    """Return a row of the references."""
    row: dict[str, object] = dict(zip(POINT, (case, plane, velocity, pressure), strict=True)) | {"note": ""}
    material, road = cases(campaign)[case]
    base = campaign.scene("all", velocity, pressure, plane=plane, kinematics="finite", preset="draft")
    whole = replace(base, material=material, road=road)
    sines = [SineScale(a, k) for a, k in zip(road.amplitudes, road.wavenumbers, strict=True)]
    try:
        # The block of a single scale is as high in its wavelengths as that of the whole road: the paper's.
        friction = [float(simulate(one)["friction_coefficient"]) for one in (whole, *singles(whole, sines))]
        return row | {"direct": friction[0], "sum": sum(friction[1:])}
    except RubfricError as error:
        return row | {"note": str(error)}


def singles(whole: Scene, sines: list[SineScale]) -> list[Scene]:
    """Return the scenes of single scales."""
    return [replace(whole, scale=number, road=sine) for number, sine in enumerate(sines, 1)]


def curve(campaign: Campaign) -> str:
    """Return the four ways over speed at the lightest, a middle and the heaviest load."""
    rows, spent = [], time.process_time()
    for plane, pressure in product(PLANES[::-1], (0.1, 0.5, 5.0)):
        for velocity in campaign.velocities:
            found = coupling(campaign, next(iter(cases(campaign))), (plane, velocity, pressure), "small")
            totals = [f"{value:.4f}" for value in (found.direct, found.sum, found.cascade, found.persson)]
            bounds = [f"{found.direct / getattr(found, way) - 1.0:+.0%}" for way in WAYS]
            rows.append((plane, f"{pressure:g}", f"{velocity:g}", *totals, *bounds))
    spent = (time.process_time() - spent) / len(rows)
    heads = ["plane", "p (MPa)", "v (mm/s)", "direct", "sum", "cascade", "Persson"]
    table = markdown_table([[*heads, *(f"direct / {way} - 1" for way in WAYS)], *rows])
    return f"Small strain on the layer, {1000.0 * spent:.0f} ms of processor time a point:\n\n{table}"


def rubbers(campaign: Campaign) -> dict[str, Material]:
    """Return the rubbers of the calibration."""
    table = campaign.material
    soft = replace(
        table,
        name="soft",
        youngs_modulus=2.0,
        poissons_ratio=0.485,
        shear_fractions=(0.01, 0.03, 0.06, 0.15, 0.3, 0.4),
        relaxation_times=(1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6),
    )
    return {"Table 1": table, "proportional bulk": replace(table, bulk="proportional"), "soft": soft}


def roads(campaign: Campaign) -> dict[str, WaveRoad]:
    """Return the roads of the calibration."""
    table = campaign.scene("all", 1.0, 1.0).road
    assert isinstance(table, WaveRoad)
    phases = tuple(np.random.default_rng(1).uniform(0.0, 2.0 * np.pi, len(table.phases)).tolist())
    affine = (30.0, 75.0, 180.0, 435.0)
    # Self-affine of Hurst exponent 0.8: amplitudes as k^-0.8.
    amplitudes = tuple(0.015 * (k / affine[0]) ** -0.8 for k in affine)
    return {
        "Table 1": table,
        "random phases": replace(table, phases=phases),
        "self-affine": WaveRoad(amplitudes, affine, (phases[1], phases[2], phases[3], phases[0])),
    }


def judged(way: str, error: Real, bound: Real) -> list[str]:
    """Return a row of a table: quantiles of the error, the share that its bound covers, and of bound over error."""
    width = np.percentile(bound / np.maximum(error, 1e-4), (5, 50, 95))
    quantiles = (f"{q:.1%}" for q in np.percentile(error, PERCENT))
    return [way, *quantiles, f"{np.mean(error <= bound):.1%}", *(f"{value:.2g}" for value in width)]


def small(campaign: Campaign) -> str:
    """Return what the differences of the ways say of their errors in small strain, and the layer of the block."""
    found, blocks = [], []
    for material, road in cases(campaign).values():
        for plane, velocity, pressure in grid(campaign):
            height = campaign.aspect * road.wavelength
            here = estimate(material, road, velocity, pressure, height, plane, "small")
            found.append(here)
            if len(found) % SAMPLE == 0:
                base = campaign.scene("all", velocity, pressure, plane=plane, kinematics="small", preset="draft")
                scene = replace(base, material=material, road=road)
                try:
                    blocks.append((float(simulate(scene)["friction_coefficient"]), here.direct))
                except RubfricError:
                    continue
    rows = []
    for way in WAYS:
        value = np.array([getattr(one, way) for one in found])
        error = np.abs(np.array([one.direct for one in found]) / value - 1.0)
        others = [np.abs(value - np.array([getattr(one, other) for one in found])) for other in WAYS if other != way]
        rows.append(judged(way, error, 1.5 * sum(others) / value))
    block, layer = np.array(blocks).T
    off = np.abs(layer / block - 1.0)
    return (
        f"{len(found)} points in small strain: errors of the ways against direct, and 1.5 times the sum of the way's "
        f"distances from the two others as a bound:\n\n{markdown_table([HEADS, *rows])}\n\n"
        f"The layer against the block on its mesh (draft, direct, {len(off)} points): friction differs by "
        f"{np.median(off):.2%} at the median, {np.percentile(off, 95):.2%} at 95 %, at most {off.max():.2%}."
    )


def finite(campaign: Campaign) -> str:
    """Return how the coupling of small strain carries over to finite strain."""
    known = pd.read_csv(REFERENCES, dtype={"note": str})
    found = known.dropna(subset=["sum", "direct"]).sort_values(POINT)
    truth, single = found["direct"].to_numpy(), found["sum"].to_numpy()
    points = list(found[POINT].itertuples(index=False, name=None))
    here = [coupling(campaign, case, tuple(at), "finite") for case, *at in points]
    paper = next(iter(cases(campaign)))
    own = found["case"].to_numpy() == paper
    missing = known[known["direct"].isna()]["case"] == paper
    parts = []
    for label, chosen, lost in (
        ("the paper's rubber and road", own, missing.sum()),
        ("other rubbers and roads", ~own, (~missing).sum()),
    ):
        rows = []
        for way, name in (*zip(WAYS, WAYS, strict=True), ("corrected", "sum, corrected")):
            total = np.array([one.total(way, value) for one, value in zip(here, single, strict=True)])
            error, bound = np.abs(truth / total - 1.0), np.array([one.error(way) for one in here])
            rows.append(judged(name, error[chosen], bound[chosen]))
        parts.append(
            f"Finite strain, {label}, {chosen.sum()} points ({lost} more have no reference):\n\n"
            f"{markdown_table([HEADS, *rows])}"
        )
    table = []
    for (_, plane, velocity, pressure), one, whole, at, shown in zip(points, single, truth, here, own, strict=True):
        if shown:
            ratios = f"{whole / one:.3f}", f"{at.direct / at.sum:.3f}", f"{at.error('sum'):.0%}"
            table.append((plane, f"{velocity:g}", f"{pressure:g}", f"{one:.4f}", f"{whole:.4f}", *ratios))
    titles = ["plane", "v (mm/s)", "p (MPa)", "sum", "direct", "direct / sum", "the same in small strain", "bound"]
    return "\n\n".join((*parts, markdown_table([titles, *table])))


if __name__ == "__main__":
    main()
