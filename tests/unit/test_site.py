"""What the documentation site is built with: equations, links between files, and the check of what was built."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path

import pytest


@pytest.mark.parametrize(
    ("equation", "part"),
    [
        (r"\tfrac12 x", "<mn>1</mn>\n    <mn>2</mn>"),
        (r"\ln\det A", '&ApplyFunction;</mo><mspace width="0.17em"/>'),
        (r"\lvert E \rvert", '<mo lspace="0" rspace="0">|</mo>'),
    ],
)
def test_equation_has_the_parts_and_spaces_that_tex_gives_it(equation: str, part: str) -> None:
    assert part in import_module("mathml").mathml(equation, block=True)


def test_links_between_files_lead_to_pages(tmp_path: Path) -> None:
    for name in ("docs/rubber.md", "config/README.md", "workflow/Snakefile"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).touch()
    text = (
        "[a](rubber.md#fit), [b](../config/README.md#grid), [c](../workflow/Snakefile), [d](https://doi.org/1), [e](#f)"
    )
    docs = tmp_path / "docs"
    found = import_module("links").resolved(text, docs / "theory.md", docs, {"config/README.md": "reference/config.md"})
    assert found == "[a](/rubber.md#fit), [b](/reference/config.md#grid), c, [d](https://doi.org/1), [e](#f)"


def test_check_names_every_dead_link_and_what_is_loaded_from_elsewhere(tmp_path: Path) -> None:
    (tmp_path / "sound.html").write_text(
        '<h1 id="top-of-it">x</h1><a href="#top-of-it">y</a><a href="https://doi.org/1">z</a>'
    )
    faults = import_module("check").faults
    assert faults(tmp_path) == []
    (tmp_path / "page.html").write_text(
        '<script src="https://cdn.example/x.js"></script><a href="sound.html#nowhere">a</a><a href="gone.html">b</a>'
        '<img src="big.png">'
    )
    (tmp_path / "big.png").write_bytes(bytes(3_000_001))
    (tmp_path / "style.css").write_text("@import url(//fonts.example/font.css); p { background: url(near.png) }")
    assert sorted(faults(tmp_path)) == [
        "page.html has 3.0 MB with its pictures, but may have 3",
        "page.html links to gone.html, which is not there",
        "page.html links to sound.html#nowhere, where nothing has that name",
        "page.html loads https://cdn.example/x.js from elsewhere",
        "style.css loads //fonts.example/font.css from elsewhere",
    ]


def test_commands_are_shown_down_to_the_last(monkeypatch: pytest.MonkeyPatch) -> None:
    commands = import_module("commands")
    shown = "".join(commands.pages(commands._parser()))
    assert "## rubfric\n" in shown
    assert "## rubfric rubber fit\n" in shown
    assert shown.count("usage: ") == shown.count("\n## ") + 1
