"""How to cite: CITATION.cff keeps to the rules of its format, 1.2.0, and names the version that this is."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest
import yaml

import rubfric

ROOT = Path(__file__).resolve().parents[2]
REQUIRED = {"authors", "cff-version", "message", "title"}
ALLOWED = REQUIRED | {"type", "version", "license", "keywords", "references", "abstract", "doi", "repository-code"}


@pytest.fixture
def citation() -> dict[str, Any]:
    return yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))


def test_keys_are_those_of_the_format(citation: dict[str, Any]) -> None:
    assert REQUIRED <= citation.keys() <= ALLOWED
    assert citation["cff-version"] == "1.2.0"
    assert all({"name"} == author.keys() or "family-names" in author for author in citation["authors"])
    assert len(set(citation["keywords"])) == len(citation["keywords"])


def test_version_is_that_of_the_package(citation: dict[str, Any]) -> None:
    assert citation["version"] == rubfric.__version__


def test_paper_is_cited_with_a_doi(citation: dict[str, Any]) -> None:
    (paper,) = citation["references"]
    assert {"type", "title", "authors"} <= paper.keys()
    assert re.fullmatch(r"10\.\d{4,9}/[-._;()/:a-z0-9]+", paper["doi"])
    assert [paper[key] for key in ("year", "volume", "start", "end")] == [2019, 2019, 8986, 8990]


def test_catalogue_of_workflows_finds_what_it_needs() -> None:
    about = yaml.safe_load((ROOT / ".snakemake-workflow-catalog.yml").read_text(encoding="utf-8"))["usage"]
    assert about["report"] is True
    assert about.keys() == {"mandatory-flags", "software-stack-deployment", "report"}
    assert (ROOT / "config" / "README.md").is_file()
    assert (ROOT / "workflow" / "Snakefile").is_file()
    assert re.search("snakemake", (ROOT / "README.md").read_text(encoding="utf-8"))
