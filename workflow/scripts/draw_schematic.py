"""Draw a figure that depends on no result."""

from importlib import import_module

from rubfric.figures.style import save


def main(figure: str, outputs: list[str]) -> None:
    """Draw the figure and save it under every path of ``outputs``.

    Parameters
    ----------
    figure : str
        Module of ``rubfric.figures``.
    outputs : list of str
        Paths; their endings choose the formats.
    """
    save(import_module(f"rubfric.figures.{figure}").draw(), *outputs)
