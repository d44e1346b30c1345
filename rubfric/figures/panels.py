"""Panels of a figure: their arrangement, headings, shared labels and legend."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from string import ascii_lowercase
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from rubfric.errors import InvalidInput
from rubfric.figures.scaling import plain
from rubfric.figures.style import COLUMN, DOUBLE_COLUMN
from rubfric.results.selection import described

_MOST_COLUMNS = 3
# The height of a line of a legend, in inches, and the size of type of a note, points.
_LEGEND_LINE, _NOTE_TYPE = 0.13, 6.0
# Letters of a note to an inch.
_LETTERS = 21.5


def arrange(count: int, height: float, share_ordinate: bool = True) -> tuple[Figure, list[Axes]]:
    """Return a figure of panels with one abscissa, at most three in a row (two of four), none of them empty.

    Parameters
    ----------
    count : int
        Number of panels.
    height : float
        Height of a row, in inches.
    share_ordinate : bool
        Whether all panels have one ordinate too.
    """
    if count < 1:
        raise InvalidInput("the figure has 0 panels, but must show at least one scale and pressure")
    columns = 2 if count == 4 else min(count, _MOST_COLUMNS)
    rows = -(-count // columns)
    size = (COLUMN if columns == 1 else DOUBLE_COLUMN, height * rows)
    figure = Figure(figsize=size, layout="constrained")
    axes: list[Axes] = list(figure.subplots(rows, columns, sharex=True, sharey=share_ordinate, squeeze=False).flat)
    for spare in axes[count:]:
        spare.remove()
    for bottom in axes[max(count - columns, 0) : count]:
        bottom.tick_params(labelbottom=True)
    return figure, axes[:count]


def label(axes: Sequence[Axes], abscissa: str, ordinate: str) -> None:
    """Label the panels that ``arrange`` returned: the lowest of each column, the first of each row.

    Parameters
    ----------
    axes : sequence of matplotlib.axes.Axes
        All panels.
    abscissa, ordinate : str
        Quantity and unit.
    """
    columns = 2 if len(axes) == 4 else min(len(axes), _MOST_COLUMNS)
    for panel in axes[max(len(axes) - columns, 0) :]:
        panel.set_xlabel(abscissa)
    for panel in axes[::columns]:
        panel.set_ylabel(ordinate)


def entitle(axes: Sequence[Axes], titles: Sequence[str]) -> None:
    """Write a letter and a title above each panel, at the left; one panel alone has no letter.

    Parameters
    ----------
    axes : sequence of matplotlib.axes.Axes
    titles : sequence of str
        One for each panel.
    """
    for place, (panel, title) in enumerate(zip(axes, titles, strict=True)):
        panel.set_title(title if len(axes) == 1 else f"{letter(place)} {title}", loc="left")


def letter(place: int) -> str:
    """Return the letter of a panel, counted from zero: (a) to (z), then (aa)."""
    before = ascii_lowercase[place // 26 - 1] if place >= 26 else ""
    return f"({before}{ascii_lowercase[place % 26]})"


def place_words(**chosen: float) -> str:
    """Return values on the axes of a campaign as a title: ``Scale 1, pressure 5 MPa``."""
    return sentence(described(**chosen).replace("e-", "e\N{MINUS SIGN}"))


def sentence(words: str) -> str:
    """Return words with a capital at their beginning, as labels have them."""
    return words[:1].upper() + words[1:]


def scale_words(campaign: xr.Dataset, scale: int) -> str:
    """Return a scale with its wavelength: ``Scale 1, 0.18 mm``.

    Parameters
    ----------
    campaign : xarray.Dataset
        As gathered by ``rubfric.results.campaign.collect``; ``wavenumber`` is 2 pi over the wavelength, 1/mm.
    scale : int
    """
    wavelength = 2.0 * np.pi / float(campaign["wavenumber"].sel(scale=scale))
    return f"Scale {scale}, {plain(wavelength, 3)} mm"


def legend_beside(figure: Figure, handles: Sequence[Any], title: str) -> None:
    """Put one legend for all panels at the right of them, where it covers no data; above one panel alone.

    One panel is a column of a page wide and would be too narrow beside a legend: the figure grows in height instead.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
    handles : sequence of matplotlib artists
        With labels.
    title : str
    """
    if len(figure.axes) == 1:
        lines = 1 + max(str(handle.get_label()).count("\n") for handle in handles)
        rows = -(-len(handles) // _MOST_COLUMNS) - 1 + lines + 1
        figure.set_figheight(figure.get_figheight() + _LEGEND_LINE * rows)
        legend_above(figure, handles, title.replace("\n", " "), _MOST_COLUMNS)
        return
    figure.legend(handles=list(handles), title=title, loc="outside right upper", alignment="left")


def legend_above(figure: Figure, handles: Sequence[Any], title: str | None, columns: int) -> None:
    """Put one legend for all panels above them.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
    handles : sequence of matplotlib artists
        With labels.
    title : str or None
    columns : int
        Entries in a row.
    """
    figure.legend(handles=list(handles), title=title, loc="outside upper center", ncols=columns)


def line_handles(labels: Sequence[str], looks: Sequence[dict[str, Any]]) -> list[Artist]:
    """Return the entries of lines in a legend.

    Parameters
    ----------
    labels : sequence of str
    looks : sequence of dict
        Keywords of ``Axes.plot``, one for each label.
    """
    return [Line2D([], [], label=words, **look) for words, look in zip(labels, looks, strict=True)]


def write_note(figure: Figure, lines: Sequence[str]) -> None:
    """Write a note in small type below all panels, and below any note that is there.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
    lines : sequence of str
    """
    letters = int(_LETTERS * (figure.get_figwidth() - 0.1))
    wrapped = [part for line in lines for part in textwrap.wrap(line, letters)]
    figure.supxlabel(
        "\n".join([*figure.get_supxlabel().splitlines(), *wrapped]),
        x=0.01,
        ha="left",
        multialignment="left",
        fontsize=_NOTE_TYPE,
    )
