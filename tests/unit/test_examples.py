"""Examples of the public names: each has one, and each does what it says."""

from __future__ import annotations

import doctest
from pathlib import Path

import pytest

import rubfric

NAMES = [name for name in rubfric.__all__ if callable(getattr(rubfric, name))]
PAGES = Path(__file__).resolve().parents[2] / "docs" / "reference" / "python"


@pytest.mark.parametrize("name", NAMES)
def test_public_name_has_an_example_that_runs(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    tests = doctest.DocTestFinder().find(getattr(rubfric, name), name, globs={})
    runner = doctest.DocTestRunner(optionflags=doctest.REPORT_NDIFF)
    said: list[str] = []
    for test in tests:
        runner.run(test, out=said.append)
    assert not runner.summarize(verbose=False).failed, "".join(said)
    # Those of the name itself, not of what it inherits or holds; none is skipped.
    examples = next(test.examples for test in tests if test.name == name)
    assert examples
    assert doctest.SKIP not in {flag for example in examples for flag in example.options}


def test_every_public_name_is_on_a_page() -> None:
    lines = [line for page in PAGES.glob("*.md") for line in page.read_text(encoding="utf-8").splitlines()]
    shown = {line.split()[-1] for line in lines if line.startswith(".. auto")}
    assert {name for name in shown if "." not in name} == {name for name in rubfric.__all__ if not name.startswith("_")}
