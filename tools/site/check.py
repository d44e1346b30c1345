"""Check a built site: every link leads somewhere, nothing is loaded from elsewhere, no page is above 3 MB.

``python tools/site/check.py FOLDER`` prints what is wrong, a line each, and fails if anything is.
"""

from __future__ import annotations

import re
import sys
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
    """What a page links to, loads, shows, and can be linked at."""

    def __init__(self, path: Path) -> None:
        super().__init__()
        self.path = path
        self.links: set[str] = set()
        self.loaded: set[str] = set()
        self.pictures: set[str] = set()
        self.anchors = {"", "top"}
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        for name, value in attrs:
            if name in ("id", "name") and value:
                self.anchors.add(value)
            if name in ("href", "src", "data") and value and (tag, name) not in _LOADED:
                self.links.add(value)
            if (tag, name) in _LOADED and value and dict(attrs).get("rel") not in _NAMED_ONLY:
                self.loaded.add(value)
            if tag == "img" and name == "src" and value:
                self.pictures.add(value)


def faults(folder: Path) -> list[str]:
    """Return a sentence for everything that is wrong with the site in a folder."""
    pages = {path: Page(path) for path in sorted(folder.rglob("*.html")) if "_static" not in path.parts}
    found = [] if pages else [f"{folder} has no pages"]
    for path, page in pages.items():
        name = path.relative_to(folder)
        found += [f"{name} loads {one} from elsewhere" for one in page.loaded if _elsewhere(one)]
        for link in page.links | page.loaded:
            target = urlsplit(link)
            if target.scheme or target.netloc:
                continue
            aim = (path.parent / unquote(target.path)).resolve() if target.path else path
            if not aim.is_file():
                found.append(f"{name} links to {link}, which is not there")
            elif aim in pages and unquote(target.fragment) not in pages[aim].anchors:
                found.append(f"{name} links to {link}, where nothing has that name")
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
