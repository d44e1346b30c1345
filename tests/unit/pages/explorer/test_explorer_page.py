"""The page is one file that holds everything, and names cannot change what it is."""

from __future__ import annotations

import json
import re
import tomllib
from collections.abc import Callable
from fnmatch import fnmatch
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
from synthetic_campaign import make_totals

import rubfric
from rubfric.figures import style
from rubfric.pages.explorer.data import payload
from rubfric.pages.explorer.page import page
from rubfric.pages.explorer.palette import palette
from rubfric.pages.render import assets

CampaignMaker = Callable[..., xr.Dataset]
NAME = "</script><img src=x onerror=alert(1)> & $title"


def made(campaign: xr.Dataset) -> dict[str, Any]:
    return payload(campaign, make_totals(campaign), [], 0.75, "road")


class Reader(HTMLParser):
    """What a browser finds in a page: its elements, addresses and the text of the payload."""

    def __init__(self) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.addresses: list[str] = []
        self.open: str | None = None
        self.text: dict[str, str] = {}

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        self.addresses += [value or "" for name, value in attrs if name in ("src", "href")]
        self.open = dict(attrs).get("id") or tag

    def handle_data(self, data: str) -> None:
        if self.open:
            self.text[self.open] = self.text.get(self.open, "") + data


@pytest.fixture(scope="module")
def read(make_campaign: CampaignMaker) -> Reader:
    reader = Reader()
    reader.feed(page(made(make_campaign().assign_attrs(rubber=NAME))))
    return reader


def test_page_refers_to_nothing_outside(read: Reader) -> None:
    assert read.addresses == ["data:,"]
    assert read.tags.count("script") == 3
    assert read.tags.count("noscript") == 1
    assert not {"img", "iframe", "object", "embed"} & set(read.tags)


def test_page_leads_back_to_that_of_all_results(make_campaign: CampaignMaker) -> None:
    reader = Reader()
    reader.feed(page(made(make_campaign()), "index.html"))
    assert reader.addresses == ["data:,", "index.html"]


def test_names_stay_words(read: Reader) -> None:
    assert json.loads(read.text["payload"])["about"]["rubber"] == NAME
    assert read.text["title"].strip() == f"Friction of rubber {NAME} on road road"


def test_every_asset_is_packaged() -> None:
    root = Path(rubfric.__file__).resolve().parents[1]
    patterns = tomllib.loads((root / "pyproject.toml").read_text())["tool"]["setuptools"]["package-data"]["rubfric"]
    folder = root / "rubfric"
    used = {
        path
        for name in ("table", "claims", "index", "rubber", "road", "slide", "areal", "explorer")
        for path in assets(name)
    }
    for path in used:
        assert any(fnmatch(path.relative_to(folder).as_posix(), pattern) for pattern in patterns)
    assert used == {path for path in (folder / "pages").rglob("*.*") if path.suffix in (".js", ".css", ".html")}


@pytest.mark.parametrize(
    "path", [path for path in assets("explorer") if path.suffix == ".js"], ids=lambda path: path.stem
)
def test_scripts_are_short_and_make_no_markup_of_words(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    assert len(text.splitlines()) <= 260
    assert not re.search(
        r"innerHTML|insertAdjacentHTML|document\.write|\beval\(|https?://(?!www\.w3\.org/2000/svg)", text
    )


def test_same_campaign_gives_the_same_page(make_campaign: CampaignMaker) -> None:
    assert page(made(make_campaign())) == page(made(make_campaign()))


@pytest.mark.parametrize("count", [1, 2, 6, 11])
def test_colours_are_those_of_the_figures(count: int) -> None:
    found = [
        [int(colour[place : place + 2], 16) / 255 for place in (1, 3, 5)]
        for colour in palette(count, range(1, 5))["pressures"]
    ]
    wanted = [colour[:3] for colour in style.colours(count)]
    assert np.abs(np.array(found) - np.array(wanted)).max() < 0.03
    kinds = {look["color"] for look in style.kinds(10)}
    assert set(palette(1, range(1, 10))["scales"]) <= kinds
    assert len(set(palette(1, range(1, 10))["scales"])) == 9
    assert palette(1, [2, 12])["scales"] == [palette(1, range(1, 10))["scales"][place] for place in (1, 2)]
