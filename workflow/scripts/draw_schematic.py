"""Draw a figure that depends on no result."""

from importlib import import_module

from rubfric.figures.style import save


def main(figure: str, outputs: list[str]) -> None:
    """Draw ``rubfric.figures.<figure>`` and save it under every path of ``outputs``."""
    save(import_module(f"rubfric.figures.{figure}").draw(), *outputs)
