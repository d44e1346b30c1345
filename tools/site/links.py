"""Let links between files of the repository lead from page to page of the site as well.

Pages are written for readers of the repository: their links name files. Those of docs are pages already. Others are
pages where ``repository_pages`` of the configuration says which page shows a file; what is no page stays as text.
"""

from __future__ import annotations

import os.path
import re
from pathlib import Path
from typing import Any

from sphinx.util import logging

_LOGGER = logging.getLogger(__name__)
_LINK = re.compile(r"(!?)\[([^\]]*)\]\(([^)\s#]*)(#[^)\s]*)?\)")
_ELSEWHERE = re.compile(r"[a-z]+:")


def resolved(text: str, source: Path, docs: Path, pages: dict[str, str]) -> str:
    """Return Markdown whose links lead to pages.

    Parameters
    ----------
    text : str
        Of the file ``source``.
    source, docs : Path
        The file, and the folder of the pages.
    pages : dict of str to str
        Page of each file outside that folder, or of its part after ``#``, that has one.
    """
    root = docs.parent

    def page(link: re.Match[str]) -> str:
        image, shown, target, fragment = link[1], link[2], link[3], link[4] or ""
        if not target or _ELSEWHERE.match(target):
            return link[0]
        path = Path(os.path.normpath(source.parent / target))
        name = path.relative_to(root).as_posix()
        if name + fragment in pages:
            return f"[{shown}](/{pages[name + fragment]})"
        if name in pages:
            return f"[{shown}](/{pages[name]}{fragment})"
        if not path.exists():
            _LOGGER.warning("%s links to %s, which does not exist", source.relative_to(root), target)
        if path.is_relative_to(docs) and path.suffix:
            return f"{image}[{shown}](/{path.relative_to(docs).as_posix()}{fragment})"
        return shown

    return _LINK.sub(page, text)


def _read(app: Any, docname: str, content: list[str]) -> None:
    source = Path(app.env.doc2path(docname))
    if source.suffix == ".md":
        content[0] = resolved(content[0], source, Path(app.srcdir), app.config.repository_pages)


def _included(app: Any, path: Path, _parent: str, content: list[str]) -> None:
    source = Path(os.path.normpath(Path(app.srcdir) / path))
    content[0] = resolved(content[0], source, Path(app.srcdir), app.config.repository_pages)


def setup(app: Any) -> dict[str, bool]:
    """Rewrite links as sources are read."""
    app.add_config_value("repository_pages", {}, "env")
    app.connect("source-read", _read)
    app.connect("include-read", _included)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
