"""Friction on a measured road itself: block by block over its windows, down to one cutoff after the other."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import product
from typing import Any

import numpy as np
import pandas as pd

from rubfric.errors import InvalidInput, NotConverged
from rubfric.profile.analysis import Analysis, analyse
from rubfric.profile.cleaning import Cleaned
from rubfric.profile.scales import sines
from rubfric.results.road_friction import Block, Outcome, means, tabulate
from rubfric.road.sine import SineScale
from rubfric.road.waves import WaveRoad
from rubfric.simulation import simulate


@dataclass(frozen=True)
class Choice:
    """How windows are cut out of a road, and how high the block on them is.

    Attributes
    ----------
    window : float
        Length, mm.
    blend : float
        Share of it that is blended.
    height : float
        Of the block, mm.
    """

    window: float
    blend: float
    height: float


def one_by_one(lengths: Sequence[float], blends: Sequence[float], heights: Sequence[float]) -> list[Choice]:
    """Return the choice of all first values, and those in which one of the three is another.

    Parameters
    ----------
    lengths : sequence of float
        Of windows, mm.
    blends : sequence of float
        Shares of a window.
    heights : sequence of float
        Of blocks, mm.
    """
    first = Choice(lengths[0], blends[0], heights[0])
    others = [
        *(replace(first, window=one) for one in lengths),
        *(replace(first, blend=one) for one in blends),
        *(replace(first, height=one) for one in heights),
    ]
    return list(dict.fromkeys([first, *others]))


def slide(
    found: Analysis,
    block: Block,
    velocities: Sequence[float],
    pressures: Sequence[float],
    cutoffs: Sequence[float],
    windows: int,
    scales: int = 0,
    progress: Callable[[str], None] = lambda line: None,
    finer: bool = True,
) -> pd.DataFrame:
    """Return friction on a road at every speed, pressure and cutoff: ``rubfric.results.road_friction.tabulate``.

    With ``scales``, rows of ``way`` sines and sum are for so many sines that are fitted to the spectrum down to the
    shortest cutoff, all at once and one by one: how far the paper's route is from the profile.

    Parameters
    ----------
    found : Analysis
    block : Block
    velocities : sequence of float
        mm/s.
    pressures : sequence of float
        Nominal, MPa.
    cutoffs : sequence of float
        Shortest wavelengths kept, mm.
    windows : int
        How many, from the first on.
    scales : int
        How many sines to compare with; 0 for none.
    progress : callable
        Is given a line for each speed, pressure and cutoff.
    finer : bool
        Whether there are rows of finer waves by Persson's theory.

    Raises
    ------
    InvalidInput
        For more windows than the profile has, or a cutoff that a window does not have.
    """
    if windows > found.windows:
        raise InvalidInput(
            f"--windows is {windows}, but the profile has {found.windows} of {found.window:g} mm: take fewer, or "
            "shorter ones with --window"
        )
    roads = {cutoff: [found.road(number + 1, cutoff) for number in range(windows)] for cutoff in cutoffs}
    few = sines(found.spectrum, scales, found.window, min(cutoffs)) if scales else None

    def solved(pressure: float, velocity: float, cutoff: float) -> list[Outcome]:
        return [_outcome(block, road, velocity, pressure) for road in roads[cutoff]]

    def fitted(pressure: float, velocity: float) -> list[dict[str, Any]]:
        return [] if few is None else _sines(block, few, velocity, pressure)

    asked = dict.fromkeys(product(pressures, velocities), tuple(cutoffs))
    return tabulate(found, block, asked, windows, solved, fitted, progress, finer)


def vary(
    cleaned: Cleaned,
    block: Block,
    velocities: Sequence[float],
    pressures: Sequence[float],
    cutoff: float,
    windows: int,
    choices: Sequence[Choice],
    progress: Callable[[str], None] = lambda line: None,
) -> pd.DataFrame:
    """Return what length of windows, blending and height of the block do to friction, over one stretch of the road.

    Each of ``choices`` slides over as many windows as make the stretch that the first has, as far as there are.

    Parameters
    ----------
    cleaned : Cleaned
        The profile.
    block : Block
        Its height is that of each choice.
    velocities : sequence of float
        mm/s.
    pressures : sequence of float
        Nominal, MPa.
    cutoff : float
        Shortest wavelength kept, mm.
    windows : int
        How many of the first choice.
    choices : sequence of Choice
    progress : callable
        Is given a line for each choice, speed and pressure.

    Returns
    -------
    pandas.DataFrame
        Direct rows as of ``slide``, with ``window_mm``, ``blend`` and ``block_height_mm`` at the end.
    """
    tables = []
    for choice in choices:
        found = analyse(cleaned, choice.window, cutoff, 1, choice.blend)
        count = min(max(1, round(windows * choices[0].window / choice.window)), found.windows)
        progress(
            f"{count} windows of {choice.window:g} mm, {choice.blend:.3g} blended, block {choice.height:g} mm high"
        )
        own = replace(block, height=choice.height)
        table = slide(found, own, velocities, pressures, [cutoff], count, progress=progress, finer=False)
        of = {"window_mm": choice.window, "blend": choice.blend, "block_height_mm": choice.height}
        tables.append(table.assign(**of))
    return pd.concat(tables, ignore_index=True)


def _outcome(block: Block, road: WaveRoad | SineScale, velocity: float, pressure: float) -> Outcome:
    """Return what sliding over a road gives, or why it was refused."""
    scene = block.scene(road, velocity, pressure)
    try:
        result = simulate(scene)
    except (InvalidInput, NotConverged) as reason:  # so light a contact, say, that others may still be solved
        return str(reason)
    friction, error, contact = (
        float(result[name]) for name in ("friction_coefficient", "friction_coefficient_error", "contact_fraction")
    )
    return friction, error, contact


def _sines(block: Block, road: WaveRoad, velocity: float, pressure: float) -> list[dict[str, Any]]:
    """Return the rows of a road of sines: all at once, and the sum over them, each under a block of the same height."""
    waves = road.waves
    single = [SineScale(float(a), float(k)) for a, k in zip(waves.amplitudes, waves.wavenumbers, strict=True)]
    parts = [_outcome(block, one, velocity, pressure) for one in single]
    refused = next((part for part in parts if isinstance(part, str)), "")
    solved = [part[:2] for part in parts if not isinstance(part, str)]
    friction, error = (math.nan, math.nan) if refused else np.sum(solved, axis=0).tolist()
    return [
        block.row_of_sines("sines", road, velocity, pressure) | means([_outcome(block, road, velocity, pressure)]),
        block.row_of_sines("sum", road, velocity, pressure)
        | {"friction_coefficient": friction, "friction_numerical_error": error, "note": refused},
    ]
