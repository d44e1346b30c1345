"""The report in a browser, from a file: what it shows, and that it fetches nothing."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from urllib.parse import unquote, urlsplit

import pytest
from project_copy import Project
from selenium.webdriver.common.by import By
from selenium.webdriver.remote.webdriver import WebDriver
from selenium.webdriver.remote.webelement import WebElement
from selenium.webdriver.support.ui import WebDriverWait

PATIENCE = 20.0  # s
# Groups, by the way to them, and how many results each has.
GROUPS = {
    ("1 Answers",): 2,
    ("2 Figures",): 11,
    ("3 Tables", "each scale"): 4,
    ("3 Tables", "test rig"): 2,
    ("6 Fields and data",): 2,
}
# What Snakemake's own page says to itself.
TAILWIND = "cdn.tailwindcss.com should not be used in production"


@pytest.fixture(scope="module")
def report(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The report of the minimal campaign."""
    project = Project.from_source(tmp_path_factory.mktemp("report"))
    project.run()
    path = project.results / "report.html"
    project.run("everything", "--report", str(path))
    return path


@pytest.fixture
def page(browser: WebDriver, report: Path) -> Iterator[WebDriver]:
    """The report, open; afterwards it must have fetched nothing and complained of nothing."""
    browser.set_window_size(1400, 900)
    for kind in ("browser", "performance"):
        browser.get_log(kind)
    browser.get(report.as_uri())
    wait_for(browser, "#app nav li")
    yield browser
    requests = [json.loads(entry["message"])["message"] for entry in browser.get_log("performance")]
    urls = [about["params"]["request"]["url"] for about in requests if about["method"] == "Network.requestWillBeSent"]
    assert report.as_uri() in urls
    assert not [url[:80] for url in urls if not url.startswith(("file:", "data:", "blob:", "chrome"))]
    told = [entry for entry in browser.get_log("browser") if entry["level"] in ("WARNING", "SEVERE")]
    assert not [entry["message"] for entry in told if TAILWIND not in entry["message"]]


def wait_for(page: WebDriver, selector: str) -> WebElement:
    return WebDriverWait(page, PATIENCE).until(lambda page: page.find_element(By.CSS_SELECTOR, selector))


def choose(page: WebDriver, words: str) -> None:
    """Click the entry of the menu with these words."""
    entry = next(entry for entry in page.find_elements(By.CSS_SELECTOR, "#app nav li a") if entry.text.strip() == words)
    entry.click()


def rows(page: WebDriver) -> list[WebElement]:
    return page.find_elements(By.CSS_SELECTOR, "#app nav tbody tr")


def shown(page: WebDriver, opened: WebElement) -> bool:
    """Return whether a picture or a page that was opened has come; a browser leaves a page that is too large empty."""
    if opened.tag_name == "img":
        script = "return arguments[0].naturalWidth > 0"
        return bool(WebDriverWait(page, PATIENCE).until(lambda page: page.execute_script(script, opened)))
    page.switch_to.frame(opened)
    try:
        return bool(wait_for(page, "h1").text)
    finally:
        page.switch_to.default_content()


def buttons(row: WebElement) -> tuple[WebElement, WebElement]:
    """Return the buttons of a row that open the result and its caption."""
    eye, info = row.find_elements(By.CSS_SELECTOR, "td:last-child a")
    return eye, info


def test_front_page_says_what_was_run_from_its_top_on(page: WebDriver) -> None:
    title = wait_for(page, "#app h1.title")
    assert title.text == "Friction of zhou2019 rubber on the zhou2019 road"
    assert title.rect["y"] >= 0
    text = page.find_element(By.CSS_SELECTOR, "#app .prose").text
    assert "Friction of the whole road: at most 0.509" in text
    assert "Every scale at 1, 100 mm/s and 0.2, 0.5 MPa" in text
    assert "accuracy of 1.0 %" in text
    assert "System Message" not in text
    link = page.find_element(By.LINK_TEXT, "Explore every scene").get_attribute("href")
    assert Path(unquote(urlsplit(str(link)).path)).is_file()


@pytest.mark.parametrize("way", GROUPS, ids=" ".join)
def test_every_result_opens_and_has_its_caption(page: WebDriver, way: tuple[str, ...]) -> None:
    menu = [entry.text for entry in page.find_elements(By.CSS_SELECTOR, "#app nav li") if entry.text[:1].isdigit()]
    assert menu == list(dict.fromkeys(category for category, *_ in GROUPS))
    for name in way:
        choose(page, name)
    count = GROUPS[way]
    WebDriverWait(page, PATIENCE).until(lambda page: len(rows(page)) == count)
    captions = set()
    for number in range(count):
        eye, info = buttons(rows(page)[number])
        if not eye.get_attribute("download"):
            eye.click()
            opened = wait_for(page, "#app .grow img, #app .grow iframe")
            assert opened.size["width"] > 500
            assert shown(page, opened)
        _, info = buttons(rows(page)[number])
        info.click()
        captions.add(wait_for(page, "#app nav .prose").text)
        back = page.find_element(By.CSS_SELECTOR, "#app nav ol").find_element(By.XPATH, f".//*[text()='{way[-1]}']")
        back.click()
        WebDriverWait(page, PATIENCE).until(lambda page: len(rows(page)) == count)
    assert len(captions) == (1 if way[-1] == "test rig" else count)  # one caption for both tables of the rig
    assert min(len(caption) for caption in captions) > 60


def test_pictures_come_first_and_tables_can_be_read(page: WebDriver) -> None:
    choose(page, "2 Figures")
    wait_for(page, "#app nav tbody tr")
    assert [row.text.split()[1] for row in rows(page)] == [str(number) for number in range(1, 12)]
    buttons(rows(page)[5])[0].click()
    picture = wait_for(page, "#app .grow img")
    assert str(picture.get_attribute("src")).startswith("data:image/png")
    assert page.execute_script("return arguments[0].naturalWidth", picture) > 1000
    page.find_element(By.CSS_SELECTOR, "#app nav ol a").click()
    WebDriverWait(page, PATIENCE).until(lambda page: "1 Answers" in page.find_element(By.CSS_SELECTOR, "#app nav").text)
    choose(page, "1 Answers")
    wait_for(page, "#app nav tbody tr")
    total = next(row for row in rows(page) if row.text.startswith("friction of the whole road: at most"))
    buttons(total)[0].click()
    page.switch_to.frame(wait_for(page, "#app .grow iframe"))
    assert wait_for(page, "h1").text == "Friction of rubber zhou2019 on road zhou2019: all scales"
    assert len(page.find_elements(By.CSS_SELECTOR, "tbody tr")) == 4
    page.switch_to.default_content()
