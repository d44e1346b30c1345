"""The page of all results: what it says of friction, and that all it links exists."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from check import Page
from page_links import page_faults
from synthetic_campaign import make_campaign, make_totals
from synthetic_site import make_site


@pytest.fixture
def totals() -> pd.DataFrame:
    return make_totals(make_campaign(speeds=(1.0, 100.0, 10000.0)), refused=[(5.0, 100.0)])


@pytest.fixture
def index(totals: pd.DataFrame, tmp_path: Path) -> Path:
    """Return the page of a campaign in a folder whose name is no address."""
    return make_site(tmp_path / "100 % of #1", totals)


def test_every_link_of_every_page_leads_somewhere(index: Path) -> None:
    assert page_faults(index.parent) == []
    links = Page(index).links
    assert {"tables/friction_total.html", "figures/fig6.png", "figures/fig6.pdf", "claims.html"} <= {*links}
    assert not [link for link in links if link.startswith(("/", "http", "file:"))]
    of_claims = Page(index.parent / "claims.html").links
    assert {"explorer.html#scale=1&pressure=1", "figures/fig6.png", "#C6", "index.html"} <= {*of_claims}
    assert "figures/fig5.png" not in of_claims  # was not drawn
    (index.parent / "figures" / "fig6.pdf").unlink()
    (index.parent / "claims.html").write_text('<h1 id="a">A</h1><h3 id="a"><a href="index.html#b">B</a></h3>')
    assert page_faults(index.parent) == [
        "claims.html links to index.html#b, where nothing has that name",
        "index.html links to figures/fig6.pdf, which is not there",
        "claims.html: a twice",
        "claims.html: h3 after h1",
    ]


def test_friction_is_that_of_the_table(index: Path, totals: pd.DataFrame) -> None:
    text = index.read_text(encoding="utf-8")
    best = totals.loc[totals["friction_total"].idxmax()]
    assert f"at {best['velocity_mm_per_s']:g} mm/s, {best['pressure_MPa']:g} MPa" in text
    assert text.count('<span class="mark part">▲') == 3  # the fastest speed at every pressure
    assert "3 of 9" in text  # with a warning
    assert "1 of 9" in text  # refused
    cells = re.findall(r"<td>([\d.]+)<span .*?<small>± ([\d.]+)<span", text)
    assert len(cells) == 9
    values = totals.pivot(index="velocity_mm_per_s", columns="pressure_MPa", values="friction_total").to_numpy()
    np.testing.assert_allclose([float(value) for value, _ in cells], values.ravel(), rtol=0.05)
    assert 'width="600" height="300"' in text
    assert "the &lt;whole&gt; road" in text
    assert "Data</h2>" not in text
