"""The documentation site: ``make site`` builds it into build/site, offline, and runs every example."""

import sys
from pathlib import Path

DOCS = Path(__file__).resolve().parent
ROOT = DOCS.parent
sys.path[:0] = [str(ROOT), str(ROOT / "tools" / "site")]

import rubfric  # noqa: E402

project = "rubfric"
author = copyright = "The rubfric developers"
release = version = rubfric.__version__
language = "en"

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "sphinx_copybutton",
    "sphinx_design",
    "sphinx_gallery.gen_gallery",
    "mathml",
    "links",
    "commands",
    "fields",
]
# README.md is the list of these pages for readers of the repository.
exclude_patterns = ["README.md"]
# Files elsewhere in the repository, or parts of them, that a page shows.
repository_pages = {
    "README.md": "index.md",
    "README.md#limits": "limits.md",
    "docs/README.md": "index.md",
    "config/README.md": "reference/config.md",
    "examples/README.md": "gallery/index.rst",
    "examples/own_rubber/README.md": "guides/own_rubber.md",
    "examples/own_road/README.md": "guides/own_road.md",
    "CONTRIBUTING.md": "project/contributing.md",
    "CHANGELOG.md": "project/changelog.md",
    "SUPPORT.md": "project/support.md",
    "CODE_OF_CONDUCT.md": "project/conduct.md",
}

myst_enable_extensions = ["dollarmath", "colon_fence"]
myst_disable_syntax = ["myst_line_comment"]  # a line may begin with a per cent sign
myst_fence_as_directive = ["math"]
myst_heading_anchors = 4
html_math_renderer = "mathml"

autodoc_typehints = "none"
autodoc_member_order = "bysource"
toc_object_entries_show_parents = "hide"
autodoc_default_options = {"members": True}
napoleon_google_docstring = False
napoleon_use_ivar = True
napoleon_use_rtype = False
napoleon_preprocess_types = True
napoleon_type_aliases = {name: f"rubfric.{name}" for name in rubfric.__all__ if not name.startswith("_")}
# Types of other packages, and shapes: they are shown as text, since a site that is built offline knows no other.
nitpick_ignore_regex = [(r"py:(class|obj|exc)", r"(?!rubfric).*")]

sphinx_gallery_conf = {
    "examples_dirs": [str(ROOT / "examples" / "gallery"), str(ROOT / "examples" / "tutorials")],
    "gallery_dirs": ["gallery", "tutorials"],
    "filename_pattern": r"/(plot|tutorial)_",
    "ignore_pattern": r"/_",
    "within_subsection_order": "order.ReadingOrder",
    "backreferences_dir": "gallery/uses",
    "doc_module": ("rubfric",),
    "download_all_examples": False,
    "show_signature": False,
    "write_computation_times": False,
}

html_theme = "pydata_sphinx_theme"
html_title = "rubfric"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_copy_source = False
html_show_sourcelink = False
# A summary of each page found is fetched, which browsers allow from a server only: the site is read from a folder.
html_show_search_summary = False
html_context = {"default_mode": "auto"}
html_sidebars = {"index": [], "start": []}
html_theme_options = {
    "logo": {"text": f"rubfric {release}"},
    "navbar_align": "left",
    "header_links_before_dropdown": 8,
    "navigation_with_keys": False,
    "show_nav_level": 2,
    "show_toc_level": 2,
    "footer_start": ["copyright"],
    "footer_end": [],
    "pygments_light_style": "a11y-high-contrast-light",
    "pygments_dark_style": "a11y-high-contrast-dark",
}
copybutton_prompt_text = r">>> |\.\.\. |\$ "
copybutton_prompt_is_regexp = True
