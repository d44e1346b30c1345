"""What a figure of a campaign of several temperatures says of the one that it shows."""

from __future__ import annotations

from matplotlib.figure import Figure

from rubfric.figures import panels, style
from rubfric.results.selection import written


def signed(temperature: float) -> str:
    """Return a temperature as figures have it, with a minus sign and no hyphen."""
    return written(temperature).replace("-", "\N{MINUS SIGN}")


def temperature_words(temperature: float | None) -> list[str]:
    """Return the sentence of a note on a temperature in degC; none where there is none."""
    if temperature is None:
        return []
    return [f"Rubber at {signed(temperature)} °C."]


def name_temperature(figure: Figure, temperature: float | None) -> Figure:
    """Return a figure with its temperature in the note below the panels; as it is where there is none.

    A figure that lays out its own panels has it in its own note.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
    temperature : float or None
        degC.
    """
    if temperature is not None and figure.get_layout_engine() is not None:
        with style.applied():
            panels.write_note(figure, [*figure.get_supxlabel().splitlines(), *temperature_words(temperature)])
    return figure
