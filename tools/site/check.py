"""Check a built site: every link leads somewhere, nothing is loaded from elsewhere, no page is above 3 MB.

``python tools/site/check.py FOLDER`` prints what is wrong, a line each, and fails if anything is.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Mapping
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

# A page, and a page with the pictures that it shows.
MOST_BYTES = 3_000_000
_LOADED = {
    ("script", "src"),
    ("img", "src"),
    ("link", "href"),
    ("iframe", "src"),
    ("source", "src"),
    ("object", "data"),
}
_STYLE_URL = re.compile(r"""(?:url\(|@import\s+["'])\s*["']?([^"')\s;]+)""")
# Links that say what a page is, and load nothing.
_NAMED_ONLY = {"canonical", "license", "author"}


class Page(HTMLParser):
    """What a page links to, loads, shows, and can be linked at; its ids and the levels of its headings."""

    def __init__(self, path: Path) -> None:
        super().__init__()
        self.path = path
        self.links: set[str] = set()
        self.loaded: set[str] = set()
        self.pictures: set[str] = set()
        self.anchors = {"", "top"}
        self.ids: list[str] = []
        self.headings: list[int] = []
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        if len(tag) == 2 and tag[0] == "h" and tag[1].isdigit():
            self.headings.append(int(tag[1]))
        for name, value in attrs:
            if not value:
                continue
            if name in ("id", "name"):
                self.anchors.add(value)
            if name == "id":
                self.ids.append(value)
            if name in ("href", "src", "data"):
                self.links.add(value)
            if (tag, name) in _LOADED and dict(attrs).get("rel") not in _NAMED_ONLY:
                self.loaded.add(value)
            if tag == "img" and name == "src":
                self.pictures.add(value)


def dead_links(folder: Path, pages: Mapping[Path, Page]) -> list[str]:
    """Return a sentence for every link of pages that leads nowhere.

    Parameters
    ----------
    folder : Path
        Sentences name pages from there.
    pages : mapping of Path to Page
        By their paths, which are absolute.
    """
    found = []
    for path, page in pages.items():
        for link in sorted(page.links):
            target = urlsplit(link)
            if target.scheme or target.netloc:
                continue
            aim = (path.parent / unquote(target.path)).resolve() if target.path else path
            # What an explorer shows is chosen by KEY=VALUE after the #: it has no such id.
            choice = "=" in target.fragment
            if not aim.exists():
                found.append(f"{path.relative_to(folder)} links to {link}, which is not there")
            elif aim in pages and not choice and unquote(target.fragment) not in pages[aim].anchors:
                found.append(f"{path.relative_to(folder)} links to {link}, where nothing has that name")
    return found


def faults(folder: Path) -> list[str]:
    """Return a sentence for everything that is wrong with the site in a folder."""
    pages = {path: Page(path) for path in sorted(folder.rglob("*.html")) if "_static" not in path.parts}
    found = dead_links(folder, pages) if pages else [f"{folder} has no pages"]
    for path, page in pages.items():
        name = path.relative_to(folder)
        found += [f"{name} loads {one} from elsewhere" for one in page.loaded if _elsewhere(one)]
        shown = [(path.parent / unquote(one)).resolve() for one in page.pictures if not urlsplit(one).scheme]
        size = path.stat().st_size + sum(one.stat().st_size for one in shown if one.is_file())
        if size > MOST_BYTES:
            found.append(f"{name} has {size / 1e6:.1f} MB with its pictures, but may have {MOST_BYTES / 1e6:.0f}")
    for sheet in sorted(folder.rglob("*.css")):
        urls = _STYLE_URL.findall(sheet.read_text(encoding="utf-8"))
        found += [f"{sheet.relative_to(folder)} loads {url} from elsewhere" for url in urls if _elsewhere(url)]
    return found


def _elsewhere(link: str) -> bool:
    target = urlsplit(link)
    return target.scheme in ("http", "https") or bool(target.netloc)


def main() -> int:
    """Check the site that the command line names."""
    folder = Path(sys.argv[1]).resolve()
    found = faults(folder)
    print("\n".join(found) or f"{len(list(folder.rglob('*.html')))} pages: every link leads somewhere")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
