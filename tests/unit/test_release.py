"""What names the version or the dependencies agrees, and scripts for users have the form that the site shows."""

from __future__ import annotations

import ast
import re
import tomllib
from pathlib import Path

import pytest
import yaml

import rubfric

ROOT = Path(__file__).resolve().parents[2]
# Packages that conda-forge calls otherwise.
CONDA = {"matplotlib": "matplotlib-base"}
SCRIPTS = sorted((ROOT / "examples").glob("*/[pt]*_*.py"))


def read(name: str) -> str:
    return (ROOT / name).read_text(encoding="utf-8")


def test_everything_that_names_the_version_names_this_one() -> None:
    project = tomllib.loads(read("pyproject.toml"))
    assert "version" in project["project"]["dynamic"]
    assert project["tool"]["setuptools"]["dynamic"]["version"] == {"attr": "rubfric.__version__"}
    changes = re.search(r"^## (\S+)", read("CHANGELOG.md"), flags=re.MULTILINE)
    found = {
        "CHANGELOG.md": changes and changes[1],
        "CITATION.cff": yaml.safe_load(read("CITATION.cff"))["version"],
        "recipe": yaml.safe_load(read("recipe/recipe.yaml"))["context"]["version"],
    }
    assert found == dict.fromkeys(found, rubfric.__version__)


def test_conda_package_needs_what_the_wheel_needs() -> None:
    project = tomllib.loads(read("pyproject.toml"))["project"]
    recipe = yaml.safe_load(read("recipe/recipe.yaml"))
    needed = {"python": project["requires-python"]}
    for dependency in project["dependencies"]:
        name, bound = re.fullmatch(r"([\w-]+)(>=[\d.]+)", dependency).groups()  # type: ignore[union-attr]
        needed[CONDA.get(name, name.lower())] = bound
    assert dict(one.split() for one in recipe["requirements"]["run"]) == needed
    scripts = {f"{name} = {target}" for name, target in project["scripts"].items()}
    assert set(recipe["build"]["python"]["entry_points"]) == scripts


@pytest.mark.parametrize("name", sorted(path.relative_to(ROOT).as_posix() for path in SCRIPTS))
def test_script_has_a_title_and_uses_names_that_exist(name: str) -> None:
    script = read(name)
    tree = ast.parse(script)
    title, line, blank, *text = (ast.get_docstring(tree) or "").splitlines()
    assert len(title) <= len(line)
    assert set(line) == {"="}
    assert not blank
    assert text
    assert script.endswith("plt.show()\n") or "tutorial" in name
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("rubfric"):
            home = __import__(str(node.module), fromlist=["*"])
            assert all(hasattr(home, each.name) and not each.name.startswith("_") for each in node.names)
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id == "rubfric":
            assert node.attr in (*rubfric.__all__, "__file__")
