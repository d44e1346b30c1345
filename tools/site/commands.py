"""The page of the command line, written from the parsers themselves when the site is built."""

from __future__ import annotations

import argparse
import os
from collections.abc import Iterator
from typing import Any

from rubfric.cli import _parser

_PAGE = "reference/commands"
_COLUMNS = "96"


def pages(parser: argparse.ArgumentParser) -> Iterator[str]:
    """Yield a section of Markdown for a command and for each of those below it: its help as a terminal shows it."""
    groups = [action for action in parser._actions if isinstance(action, argparse._SubParsersAction)]
    yield f"## {parser.prog}\n\n```text\n{parser.format_help().rstrip()}\n```\n"
    for name, below in (each for group in groups for each in group.choices.items()):
        assert below.prog.endswith(name)
        yield from pages(below)


def _read(_app: Any, docname: str, content: list[str]) -> None:
    if docname == _PAGE:
        os.environ["COLUMNS"] = _COLUMNS
        content[0] += "\n" + "\n".join(pages(_parser()))


def setup(app: Any) -> dict[str, bool]:
    """Write the page anew at every build: nothing else says when a parser has changed."""
    app.connect("source-read", _read)
    app.connect("env-get-outdated", lambda *_: [_PAGE])
    return {"parallel_read_safe": True, "parallel_write_safe": True}
