"""The paper's figures: there, large enough to print, and not blank."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from matplotlib.image import imread
from project_copy import Project

FIGURES = ("fig1", "fig2", "fig3", "fig4", "fig5", "fig6", "fig7", "fig8", "fig9", "fig10", "fig11")


@pytest.fixture(params=FIGURES)
def figure(request: pytest.FixtureRequest, paper: Project) -> Path:
    """The path of a figure, without its kind."""
    return paper.results / "figures" / str(request.param)


def test_pdf_is_whole(figure: Path) -> None:
    content = figure.with_suffix(".pdf").read_bytes()
    assert content.startswith(b"%PDF-")
    assert content.rstrip().endswith(b"%%EOF")
    assert len(content) > 5000


def test_png_is_large_and_not_blank(figure: Path) -> None:
    pixels = imread(figure.with_suffix(".png"))[..., :3]
    height, width, _ = pixels.shape
    assert width >= 1000
    assert height >= 500
    inked = np.any(pixels < 0.9, axis=2)
    assert 0.005 < inked.mean() < 0.95
    assert np.ptp(np.flatnonzero(inked.any(axis=0))) > 0.8 * width
    assert np.ptp(np.flatnonzero(inked.any(axis=1))) > 0.8 * height


def test_nothing_else_is_drawn(paper: Project) -> None:
    drawn = {path.name for path in (paper.results / "figures").iterdir()}
    assert drawn == {f"{name}.{kind}" for name in FIGURES for kind in ("pdf", "png")}
