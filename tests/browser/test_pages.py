"""The pages of a campaign in a browser: nothing clips, dark or light, on a phone or on paper, and all can read them."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from selenium.webdriver.remote.webdriver import WebDriver
from synthetic_campaign import make_campaign, make_totals
from synthetic_site import make_site
from visit import colours, console_errors, resize, violations

pytestmark = pytest.mark.thorough
NAMES = ("index.html", "claims.html", "tables/friction_total.html")
# A4 within the margins of the pages, lying, at 96 pixels an inch.
PAPER = 1047


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("site") / "results"
    make_site(folder, make_totals(make_campaign(), refused=[(5.0, 100.0)]))
    return folder


@pytest.mark.parametrize("name", NAMES)
def test_page_fits_every_screen_and_has_no_barrier(browser: WebDriver, site: Path, name: str) -> None:
    for dark in (False, True):
        colours(browser, dark)
        browser.get((site / name).as_uri())
        for width in (390, 800, 1400):
            resize(browser, width, 900)
            assert browser.execute_script("return document.documentElement.scrollWidth") <= width
        assert violations(browser) == []
    assert console_errors(browser) == []


def test_first_columns_and_head_stay_where_the_rest_scrolls(browser: WebDriver, site: Path) -> None:
    colours(browser)
    resize(browser, 390, 600)
    browser.get((site / NAMES[2]).as_uri())
    script = """
    const cells = document.querySelector(".cells"), row = cells.querySelector("tbody tr:nth-child(9)");
    const head = cells.querySelector("thead tr:last-child th:nth-child(4)");
    cells.scrollIntoView();
    const box = (one) => one.getBoundingClientRect();
    const places = () => [...[...row.children].slice(0, 3).map((one) => box(one).left), box(head).top];
    const before = places();
    cells.scrollBy({ left: 200, top: 100, behavior: "instant" });
    return [before, places()];
    """
    before, after = browser.execute_script(script)
    assert after[:2] == before[:2]
    assert after[2] == before[2] - 200
    assert after[3] == before[3]


@pytest.mark.parametrize("name", NAMES)
def test_nothing_is_cut_off_on_paper(browser: WebDriver, site: Path, name: str) -> None:
    colours(browser, dark=True, media="print")
    resize(browser, PAPER, 700)
    browser.get((site / name).as_uri())
    script = "return [...document.querySelectorAll('main *')].map((one) => one.getBoundingClientRect().right)"
    assert max(browser.execute_script(script)) <= PAPER
    colour = browser.execute_script("return getComputedStyle(document.body).backgroundColor")
    assert colour == "rgb(255, 255, 255)"
    colours(browser)


def test_links_to_other_pages_are_hidden_within_a_report(browser: WebDriver, site: Path, tmp_path: Path) -> None:
    colours(browser)
    frame = tmp_path / "report.html"
    address = json.dumps((site / "claims.html").as_uri())
    frame.write_text(f"<!doctype html><iframe width=800 height=800 src={address}></iframe>", encoding="utf-8")
    hidden = "return [...document.querySelectorAll('.beside')].map((one) => one.offsetParent === null)"
    browser.get((site / "claims.html").as_uri())
    assert not any(browser.execute_script(hidden))
    browser.get(frame.as_uri())
    browser.switch_to.frame(0)
    assert all(browser.execute_script(hidden))
    browser.switch_to.default_content()
