"""The links of pages: what they name exists."""

from __future__ import annotations

from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

_ADDRESSES = {"a": "href", "img": "src", "script": "src", "link": "href", "iframe": "src"}


class Page(HTMLParser):
    """The links of a page, its ids, and the levels of its headings."""

    def __init__(self, path: Path) -> None:
        super().__init__()
        self.links: list[str] = []
        self.ids: list[str] = []
        self.headings: list[int] = []
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        about = dict(attrs)
        if about.get("id"):
            self.ids.append(str(about["id"]))
        if address := about.get(_ADDRESSES.get(tag, "")):
            self.links.append(address)
        if len(tag) == 2 and tag[0] == "h" and tag[1].isdigit():
            self.headings.append(int(tag[1]))


def broken_links(folder: Path) -> list[str]:
    """Return what is wrong with the pages below a folder: links to nothing, ids used twice, levels left out."""
    paths = sorted(folder.rglob("*.html"))
    pages = {path.resolve(): Page(path) for path in paths}
    found = []
    for path, page in pages.items():
        for link in page.links:
            target = urlsplit(link)
            if target.scheme:
                continue
            place = (path.parent / unquote(target.path)).resolve() if target.path else path
            ids = pages[place].ids if place in pages else None
            # What an explorer shows is chosen by what follows the #: it has no such id.
            is_choice = "=" in target.fragment
            if not place.exists() or (target.fragment and not is_choice and target.fragment not in (ids or [])):
                found.append(f"{path.name}: {link}")
        found += [f"{path.name}: {name} twice" for name in {*page.ids} if page.ids.count(name) > 1]
        levels = zip([0, *page.headings], page.headings, strict=False)
        found += [f"{path.name}: h{after} after h{before}" for before, after in levels if after > before + 1]
    return found
