"""The page of all results: what it says of friction, and that all it links exists."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from links import Page, broken_links
from matplotlib.figure import Figure
from synthetic_campaign import make_campaign, make_totals

from rubfric.pages.index import Linked, index_page
from rubfric.pages.render import write_page
from rubfric.pages.table import table_page
from rubfric.results.tables import write_table


@pytest.fixture
def totals() -> pd.DataFrame:
    return make_totals(make_campaign(speeds=(1.0, 100.0, 10000.0)), refused=[(5.0, 100.0)])


@pytest.fixture
def folder(totals: pd.DataFrame, tmp_path: Path) -> Path:
    """Return the results of a campaign of one table and one figure, in a folder whose name is no address."""
    results = tmp_path / "100 % of #1"
    write_table(totals, results / "tables" / "friction_total.csv")
    page = table_page(totals, "Totals", "Words.", csv="friction_total.csv", home="../index.html")
    write_page(page, results / "tables" / "friction_total.html")
    write_page("<h1>Explorer</h1>", results / "explorer.html")
    (results / "figures").mkdir()
    for kind in ("png", "pdf"):
        Figure((2.0, 1.0), dpi=100).savefig(results / "figures" / f"fig6.{kind}")
    tables = [Linked("the <whole> road", {"CSV": str(results / "tables" / "friction_total.csv")})]
    text = index_page(
        results, "A title", totals, ["rubber a_b"], ["claims: 9"], {"fig6": "friction"}, {"Tables": tables, "Data": []}
    )
    write_page(text, results / "index.html")
    return results


def test_every_link_leads_somewhere(folder: Path) -> None:
    assert broken_links(folder) == []
    links = Page(folder / "index.html").links
    assert {"tables/friction_total.html", "figures/fig6.png", "figures/fig6.pdf", "explorer.html"} <= {*links}
    assert not [link for link in links if link.startswith(("/", "http", "file:"))]
    (folder / "figures" / "fig6.pdf").unlink()
    assert broken_links(folder) == ["index.html: figures/fig6.pdf"]


def test_friction_is_that_of_the_table(folder: Path, totals: pd.DataFrame) -> None:
    text = (folder / "index.html").read_text(encoding="utf-8")
    best = totals.loc[totals["friction_total"].idxmax()]
    assert f"at {best['velocity_mm_per_s']:g} mm/s, {best['pressure_MPa']:g} MPa" in text
    assert text.count('<span class="mark part">▲') == 3  # the fastest speed at every pressure
    assert "3 of 9" in text  # with a warning
    assert "1 of 9" in text  # refused
    cells = re.findall(r"<td>([\d.]+) ± ([\d.]+)<span", text)
    assert len(cells) == 9
    values = totals.pivot(index="velocity_mm_per_s", columns="pressure_MPa", values="friction_total").to_numpy()
    np.testing.assert_allclose([float(value) for value, _ in cells], values.ravel(), rtol=0.05)
    assert 'width="200" height="100"' in text
    assert "the &lt;whole&gt; road" in text
    assert "Data</h2>" not in text
