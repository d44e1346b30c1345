"""Which files a result depends on: those whose import runs, and no others."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

import rubfric
from rubfric.sources import sources

PACKAGE = Path(rubfric.__file__).resolve().parent
MODULES = ["rubfric.simulation", "rubfric.collection", "rubfric.tables", "rubfric.campaign", "rubfric.summary"]
FIGURES = [f"rubfric.figures.{name}" for name in ("fig1", "fig2", "fig3", "fig4", "fig6", "fig7", "fig8", "fig9")]


def imported(module: str) -> set[str]:
    """Return the files of the package that a fresh interpreter has run after importing a module."""
    code = (
        f"import sys, {module}\n"
        "loaded = [value for name, value in sys.modules.items() if name.startswith('rubfric.')]\n"
        "print('\\n'.join(value.__file__ for value in loaded))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return set(done.stdout.split())


@pytest.mark.parametrize("module", [*MODULES, "rubfric.figures.fig7"])
def test_sources_are_the_modules_whose_import_runs(module: str) -> None:
    assert {str(path) for path in sources(module)} == imported(module)


def test_imports_inside_functions_count() -> None:
    assert PACKAGE / "simulation.py" in sources("rubfric.cli")
    assert str(PACKAGE / "simulation.py") not in imported("rubfric.cli")


def test_sources_of_several_modules_are_their_union() -> None:
    both = sources("rubfric.simulation", "rubfric.tables")
    assert set(both) == set(sources("rubfric.simulation")) | set(sources("rubfric.tables"))
    assert list(both) == sorted(both)


def test_sources_are_absolute_files_of_the_package() -> None:
    for path in sources("rubfric.simulation"):
        assert path.is_absolute()
        assert path.is_file()
        assert path.is_relative_to(PACKAGE)
        assert path != PACKAGE / "__init__.py"


def test_package_of_figures_counts_for_each_figure() -> None:
    for module in FIGURES:
        assert PACKAGE / "figures" / "__init__.py" in sources(module)


def test_scenes_do_not_depend_on_what_comes_after_them() -> None:
    files = {path.relative_to(PACKAGE).as_posix() for path in sources("rubfric.simulation")}
    after = ("campaign", "collection", "tables", "multiscale", "summary", "cli", "sources", "jobs", "warm")
    assert not files & {f"{name}.py" for name in after}
    assert not {name for name in files if name.startswith("figures/")}
    assert {"contact.py", "block.py", "steady.py", "energy.py", "dataset.py", "checks.py"} <= files


@pytest.mark.parametrize("module", ["rubfric.simulations", "rubfric.figures.fig99", "numpy", "rubfric", ""])
def test_unknown_module_is_refused(module: str) -> None:
    with pytest.raises(ModuleNotFoundError, match=f"^{module} is no module of rubfric$"):
        sources(module)
