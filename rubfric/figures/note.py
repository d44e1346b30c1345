"""The note below figure 4: how to read the pictures of the block."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product

from rubfric.figures.deformation import is_finite
from rubfric.figures.panels import letter
from rubfric.figures.scenes import SceneGrid
from rubfric.figures.temperature import temperature_words
from rubfric.results.selection import written


def note_below(grid: SceneGrid, whole: bool, shares: bool) -> str:
    """Return the note below the panels.

    Parameters
    ----------
    grid : SceneGrid
        What is drawn, a row of panels per pressure and a column per speed.
    whole : bool
        Whether the panels show the upper face of the block.
    shares : bool
        Whether to explain the percentages in the panels.
    """
    places = list(product(grid.pressures, grid.speeds))
    small = [number for number, place in enumerate(places) if not is_finite(grid.results[place])]
    finite = len(small) < len(places)
    note = ["The block slides to the right." if whole else "Lower part of the block, which slides to the right."]
    if finite:
        note.append("Displacements are to scale; the white lines made squares before deformation.")
    if small:
        panels = f"In small strain ({_listed(small)}) only" if finite else "Only"
        compressions = _compressions(grid)
        note.append(
            f"{panels} vertical displacements are shown, to scale, without the mean compression ({compressions})."
        )
    if shares:
        note.append("Percentages: share of the nominal area in contact.")
    warned = [number for number, place in enumerate(places) if grid.results[place].attrs.get("warnings")]
    if warned:
        which = f"Panel{'s' if len(warned) > 1 else ''} {_listed(warned)}" if len(places) > 1 else "The scene"
        note.append(f"{which} carr{'y' if len(warned) > 1 else 'ies'} a warning.")
    note += temperature_words(next(iter(grid.results.values())).attrs.get("temperature"))
    return " ".join(note)


def _compressions(grid: SceneGrid) -> str:
    """Return the mean compression that is left out of the panels in small strain, by pressure."""
    found = []
    for pressure in grid.pressures:
        results = (grid.results[pressure, speed] for speed in grid.speeds)
        strains = [float(result["nominal_compression"]) for result in results if not is_finite(result)]
        if strains:
            found.append(f"{100.0 * strains[0]:.2g} % at {written(pressure)} MPa".replace(" ", "\N{NO-BREAK SPACE}"))
    return ", ".join(found)


def _listed(numbers: Sequence[int]) -> str:
    """Return letters of panels, neighbours as a range: a, c to e."""
    runs: list[list[int]] = []
    for number in numbers:
        if runs and number == runs[-1][-1] + 1:
            runs[-1].append(number)
        else:
            runs.append([number])
    return ", ".join(_run(run) for run in runs)


def _run(run: Sequence[int]) -> str:
    first, last = (letter(number).strip("()") for number in (run[0], run[-1]))
    return first if len(run) == 1 else f"{first}, {last}" if len(run) == 2 else f"{first} to {last}"
