"""The rule of imports holds, and the picture of the architecture is drawn from it."""

from __future__ import annotations

import ast
from pathlib import Path
from xml.etree import ElementTree

import pytest
from importlinter.cli import lint_imports

ROOT = Path(__file__).resolve().parents[2]


def test_imports_keep_their_contracts(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    assert lint_imports(no_cache=True) == 0, "see lint-imports"


def test_picture_is_of_the_package_as_it_is(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(ROOT / "tools")
    import architecture

    drawn = architecture.picture()
    assert architecture.PICTURE.read_text(encoding="utf-8") == drawn, "draw it anew: make docs"
    texts = [text.text for text in ElementTree.fromstring(drawn).iter("{http://www.w3.org/2000/svg}text")]
    modules = [path.relative_to(ROOT / "rubfric") for path in (ROOT / "rubfric").rglob("*.py")]
    assert {path.stem for path in modules} - {"__init__"} <= set(texts)
    assert {f"{name.replace('.', '/')}.py" for name in architecture.WAY} <= {path.as_posix() for path in modules}


def test_packages_hold_a_docstring_only() -> None:
    # What importing a package runs counts for no result: rubfric.runner.reruns.
    packages = [path for path in (ROOT / "rubfric").rglob("__init__.py") if path.parent.name != "rubfric"]
    assert packages
    for path in packages:
        assert [type(node) for node in ast.parse(path.read_text(encoding="utf-8")).body] == [ast.Expr], path
