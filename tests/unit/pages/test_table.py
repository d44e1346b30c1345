"""A table as a page: complete, escaped, with units."""

from __future__ import annotations

import re
from html.parser import HTMLParser
from pathlib import Path

import pandas as pd
import pytest

from rubfric.pages.render import write_page
from rubfric.pages.table import table_page


class Cells(HTMLParser):
    """Collects the rows of a page's table, and every tag."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.rows: list[list[str]] = []
        self.tags: list[str] = []
        self.groups: list[int] = []
        self.feed(page)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        if tag == "tr":
            self.rows.append([])
            if ("class", "group") in attrs:
                self.groups.append(len(self.rows) - 1)
        if tag in ("td", "th"):
            self.rows[-1].append("")

    def handle_data(self, data: str) -> None:
        if self.rows and self.rows[-1] and self.tags[-1] in ("td", "th", "small", "br", "span", "b"):
            self.rows[-1][-1] += data.strip("\n\N{FIGURE SPACE}\N{PUNCTUATION SPACE}")


@pytest.fixture
def table() -> pd.DataFrame:
    return pd.DataFrame(
        {
            "velocity_mm_per_s": [0.1, 10000.0, 0.1],
            "pressure_MPa": [0.5, 0.5, 5.0],
            "friction_coefficient": [0.123456, float("nan"), 1.0e-7],
            "contact_nodes": [12, 3, 4],
            "rubber": ["a<b", "c&d", "e"],
        }
    )


def test_page_holds_every_value_and_leaves_gaps(table: pd.DataFrame) -> None:
    cells = Cells(table_page(table, "Title", "Words."))
    assert cells.rows == [
        ["", "friction", "numerics", ""],
        ["velocitymm/s", "pressureMPa", "from stress power", "contact nodes", "rubber"],
        ["0.1", "0.5", "0.1235", "12", "a<b"],
        ["10000", "0.5", "", "3", "c&d"],
        ["0.1", "5", "1e\N{MINUS SIGN}07", "4", "e"],
    ]
    assert not cells.groups


def test_value_has_the_digits_of_its_error_below_one_another() -> None:
    rows = {"friction_total": [0.123456, 12.34567, 0.5], "friction_total_error": [0.00996, 0.0347, 0.0]}
    page = table_page(pd.DataFrame(rows), "Title", "Words.")
    shown = [re.findall(r"<td>([^<]*)</td>", line) for line in page.splitlines() if "<td>" in line]
    wide = "\N{FIGURE SPACE}"
    assert shown == [
        [f"0.123{wide}", "0.010"],
        [f"12.346{wide}", "0.035"],
        ["0.5000", f"0\N{PUNCTUATION SPACE}{3 * wide}"],
    ]


def test_line_is_drawn_where_the_group_changes(table: pd.DataFrame) -> None:
    assert Cells(table_page(table, "Title", "Words.", group="pressure_MPa")).groups == [4]


def test_names_are_escaped_and_nothing_is_fetched(table: pd.DataFrame) -> None:
    page = table_page(table, "<script>1</script>", "a & b")
    assert "<script>1" not in page
    assert "a &amp; b" in page
    assert not re.search(r"(src|href|url|@import)\b", page)


def test_empty_table_is_a_page_too(table: pd.DataFrame) -> None:
    assert len(Cells(table_page(table[:0], "Title", "Words.")).rows) == 2
    assert len(Cells(table_page(table[["rubber"]][:0], "Title", "Words.")).rows) == 1


def test_page_is_written_whole(table: pd.DataFrame, tmp_path: Path) -> None:
    target = tmp_path / "pages" / "one.html"
    write_page(table_page(table, "Titel ±", "Words."), target)
    assert "Titel ±" in target.read_text(encoding="utf-8")
    assert [path.name for path in target.parent.iterdir()] == ["one.html"]
