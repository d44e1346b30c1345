"""Figure 5: friction of blocks pressed and slid, step by step, until it saturates."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter, MaxNLocator
from numpy.typing import NDArray

from rubfric.errors import InvalidInput
from rubfric.figures import panels, style
from rubfric.figures.scaling import plain, scale_friction, tick_decades
from rubfric.figures.scenes import check_results
from rubfric.results.selection import described, written

Array = NDArray[np.float64]

_VARIABLES = (
    *("slid", "phase", "friction_contact", "mean_friction"),
    *("steady_friction_coefficient", "saturated", "memory_wavelengths"),
)
_BLOCK = ("scale", "pressure", "aspect")
_ATTRIBUTES = ("velocity", *_BLOCK, "kinematics_used", "wavelength_mm", "steps_per_wavelength")
# The phase in which the block begins to move; those before press it.
_START = 2
# Wavelengths at which panel (b) begins, before the first mean.
_FIRST = 0.5
# Markers are no nearer to each other than this share of the panel's width.
_APART = 0.035
# Lines of fast blocks oscillate more and lie below those of slow ones.
_STEPS: dict[str, Any] = {"linewidth": 0.7, "zorder": 2.0}
_MEAN: dict[str, Any] = {"linestyle": "none", "markersize": 3.4, "zorder": 3.0}
_STEADY: dict[str, Any] = {"linestyle": (0, (6, 3)), "linewidth": 0.6}
# Characters on a line of the note, which ends before the legend.
_LINE = 135
# In inches: the height of the panels with their labels, of a line of the legend, and of a line of the note.
_HEIGHT, _LEGEND_LINE, _NOTE_LINE = 2.8, 0.14, 0.1


@dataclass(frozen=True)
class _Slide:
    """One block from its first movement on.

    Attributes
    ----------
    speed : float
        mm/s.
    steps, slid, friction : ndarray, each of shape (steps,)
        Number of each step, wavelengths slid and friction coefficient at its end.
    mean_steps, mean_slid, means : ndarray, each of shape (wavelengths,)
        The middle of each whole wavelength at full speed, in steps and in wavelengths, and mean friction there.
    steady : float
        Friction coefficient by the steady solver.
    saturated : bool
    memory : float
        Memory of the slowest branch in wavelengths.
    """

    speed: float
    steps: Array
    slid: Array
    friction: Array
    mean_steps: Array
    mean_slid: Array
    means: Array
    steady: float
    saturated: bool
    memory: float


@style.applied()
def draw(results: Sequence[xr.Dataset]) -> Figure:
    """Draw the friction coefficient against steps of time, and its means against wavelengths slid, a colour per speed.

    Parameters
    ----------
    results : sequence of xarray.Dataset
        Marches of one scale, pressure and height-to-width ratio, at one speed each, in any order. Over ``step``:
        ``slid`` (mm), ``phase`` and ``friction_contact``; over ``wavelength``: ``mean_friction``; and the scalars
        ``steady_friction_coefficient``, ``saturated`` and ``memory_wavelengths``.

    Returns
    -------
    matplotlib.figure.Figure
        Steps and wavelengths count from where the block begins to move. Friction at every step is in panel (a) alone.
        Dashes show the steady solver's value. Markers show means over a wavelength, all in panel (b) but those too near
        to another one, and the last in panel (a); a ring around the last one marks a saturated mean, about which
        friction may still oscillate. The legend and the note name those that have not saturated.

    Raises
    ------
    InvalidInput
        For no results, one that lacks something or never slides, two of one speed, or different blocks.
    """
    _check(results)
    ordered = sorted(results, key=lambda result: float(result.attrs["velocity"]))
    slides = [_slide(result) for result in ordered]
    looks = style.lines(len(slides))
    handles, note = _handles(slides, looks), textwrap.wrap(_note(ordered, slides), _LINE)
    lines = sum(1 + str(handle.get_label()).count("\n") for handle in handles)
    height = max(_HEIGHT, _LEGEND_LINE * (lines + 2)) + _NOTE_LINE * len(note)
    figure = Figure(figsize=(style.DOUBLE_COLUMN, height), layout="constrained")
    by_step, by_distance = axes = list(figure.subplots(1, 2))
    _scale(by_step, by_distance, slides)
    for slide, look in zip(slides[::-1], looks[::-1], strict=True):
        _draw_steps(by_step, slide, look)
        for panel in axes:
            panel.axhline(slide.steady, color=look["color"], zorder=2.5, gid="steady", **_STEADY)
        _draw_means(by_step, slide.mean_steps[-1:], slide, look)
        _draw_means(by_distance, slide.mean_slid, slide, look)
    panels.entitle(axes, ["Step by step", "Means over a wavelength"])
    by_step.set(xlabel="Time steps since the block began to move", ylabel="Friction coefficient")
    by_distance.set(xlabel="Distance slid (wavelengths)", ylabel="Mean friction coefficient")
    panels.legend_beside(figure, handles, "Sliding speed\n(mm/s)")
    panels.write_note(figure, note)
    return figure


def _check(results: Sequence[xr.Dataset]) -> None:
    check_results("march", results, _ATTRIBUTES, _VARIABLES, _BLOCK)
    speeds = set()
    for result in results:
        speed = float(result.attrs["velocity"])
        if speed in speeds:
            raise InvalidInput(f"there are two marches at {described(velocity=speed)}, but one line shows only one")
        if not (result["phase"].values >= _START).any():
            raise InvalidInput(f"the march at {described(velocity=speed)} has no step in which the block slides")
        speeds.add(speed)


def _slide(result: xr.Dataset) -> _Slide:
    moving = result["phase"].values >= _START
    slid = result["slid"].values[moving] / float(result.attrs["wavelength_mm"])
    steps = np.arange(1.0, slid.size + 1.0)
    means = result["mean_friction"].values
    # Full speed begins after the last step of the start.
    begin = int((result["phase"].values == _START).sum())
    middles: Array = np.arange(0.5, means.size)
    return _Slide(
        speed=float(result.attrs["velocity"]),
        steps=steps,
        slid=slid,
        friction=result["friction_contact"].values[moving],
        mean_steps=begin + middles * int(result.attrs["steps_per_wavelength"]),
        mean_slid=middles + (float(slid[begin - 1]) if begin else 0.0),
        means=means,
        steady=float(result["steady_friction_coefficient"]),
        saturated=bool(result["saturated"]),
        memory=float(result["memory_wavelengths"]),
    )


def _scale(by_step: Axes, by_distance: Axes, slides: Sequence[_Slide]) -> None:
    most = max(float(slide.steps[-1]) for slide in slides)
    by_step.set_xlim(0.0, 1.03 * most)
    by_step.xaxis.set_major_locator(MaxNLocator(5, steps=[1, 2, 5, 10], integer=True))
    by_step.xaxis.set_major_formatter(FuncFormatter(lambda value, _: plain(value)))
    furthest = max(1.0, *(float(slide.slid[-1]) for slide in slides))
    by_distance.set_xscale("log")
    by_distance.set_xlim(_FIRST, 1.15 * furthest)
    tick_decades(by_distance.xaxis, _FIRST, furthest)
    steps, means = (
        np.concatenate([np.array([slide.steady, *getattr(slide, name)]) for slide in slides])
        for name in ("friction", "means")
    )
    scale_friction(by_step, steps)
    scale_friction(by_distance, means)
    for panel in (by_step, by_distance):
        if panel.get_ylim()[0] < 0.0:
            panel.axhline(0.0, color="0.6", linewidth=0.5, zorder=0.5, gid="zero")


def _draw_steps(panel: Axes, slide: _Slide, look: dict[str, Any]) -> None:
    panel.plot(slide.steps, slide.friction, color=look["color"], label=plain(slide.speed), **_STEPS)


def _draw_means(panel: Axes, places: Array, slide: _Slide, look: dict[str, Any]) -> None:
    """Draw the last of the means at as many places, without what would lie on another marker, and the ring."""
    if places.size == 0:
        return
    means = slide.means[-places.size :]
    marker = look | _MEAN | {"markevery": _apart(panel, places)}
    panel.plot(places, means, gid="mean", **marker)
    if slide.saturated:
        panel.plot(places[-1], means[-1], color=look["color"], gid="saturated", zorder=4.0, **style.RING)


def _apart(panel: Axes, places: Array) -> list[int]:
    """Return which places are far enough from the next one that is kept; the last always is."""
    across = panel.transLimits.transform(panel.transScale.transform(np.stack((places, np.zeros_like(places)), axis=1)))
    kept = [places.size - 1]
    for place in range(places.size - 2, -1, -1):
        if across[kept[-1], 0] - across[place, 0] >= _APART:
            kept.append(place)
    return kept[::-1]


def _handles(slides: Sequence[_Slide], looks: Sequence[dict[str, Any]]) -> list[Line2D]:
    handles = []
    for slide, look in zip(slides, looks, strict=True):
        words = plain(slide.speed) + ("" if slide.saturated else "\nnot saturated")
        handles.append(Line2D([], [], label=words, **look | {"linestyle": "-", "linewidth": 0.8, "markersize": 3.4}))
    handles.append(Line2D([], [], color="black", label="Steady sliding,\nsolved directly", **_STEADY))
    if any(slide.means.size for slide in slides):
        handles.append(Line2D([], [], color="black", marker="o", label="Mean over\na wavelength", **_MEAN))
    if any(slide.saturated for slide in slides):
        handles.append(Line2D([], [], color="black", label="Mean saturated", **style.RING))
    return handles


def _note(results: Sequence[xr.Dataset], slides: Sequence[_Slide]) -> str:
    """Return the note below the panels: which block, which steps, and what is not saturated."""
    block = described(**{name: float(results[0].attrs[name]) for name in _BLOCK})
    strains = " and ".join(sorted({str(result.attrs["kinematics_used"]) for result in results}))
    counts = sorted({int(result.attrs["steps_per_wavelength"]) for result in results})
    steps = " to ".join(written(count) for count in sorted({counts[0], counts[-1]}))
    note = f"{block[0].upper()}{block[1:]}; {strains} strain; {steps} time steps to a wavelength at full speed."
    missing = [slide for slide in slides if not slide.saturated]
    if missing:
        note += " Not saturated (wavelengths slid at full speed / that the slowest branch of the rubber remembers): "
        note += ", ".join(_remembered(slide) for slide in missing) + "."
    return note


def _remembered(slide: _Slide) -> str:
    memory = f"{slide.memory:.2g}" if slide.memory < 10.0 else written(round(slide.memory))
    words = f"{slide.means.size} / {memory} at {written(slide.speed)} mm/s"
    return words.replace(" ", "\N{NO-BREAK SPACE}")
