"""What a figure of a campaign of several temperatures says of the one that it shows."""

from __future__ import annotations

from matplotlib.figure import Figure

from rubfric.figures import panels, style
from rubfric.figures.scaling import plain


def temperature_words(temperature: float | None) -> list[str]:
    """Return the sentence of a note on a temperature in degC; none where there is none."""
    if temperature is None:
        return []
    return [f"Rubber at {plain(temperature)} °C."]


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
            panels.write_note(figure, temperature_words(temperature))
    return figure
