"""The links of a campaign's pages, checked as those of the documentation site are."""

from __future__ import annotations

from pathlib import Path

from check import Page, dead_links


def page_faults(folder: Path) -> list[str]:
    """Return what is wrong with the pages below a folder: links to nothing, ids used twice, levels left out."""
    folder = folder.resolve()
    pages = {path: Page(path) for path in sorted(folder.rglob("*.html"))}
    found = dead_links(folder, pages)
    for path, page in pages.items():
        name = path.relative_to(folder)
        found += [f"{name}: {one} twice" for one in {*page.ids} if page.ids.count(one) > 1]
        levels = zip([0, *page.headings], page.headings, strict=False)
        found += [f"{name}: h{after} after h{before}" for before, after in levels if after > before + 1]
    return found
