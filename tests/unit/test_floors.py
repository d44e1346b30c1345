"""The architecture: imports point down a fixed order of floors, and heavy libraries stay in their places."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

import rubfric

PACKAGE = Path(rubfric.__file__).resolve().parent
WORKFLOW = PACKAGE.parent / "workflow"

# Lowest first. A module may import from the floors below its own; those of one sub-package also one another.
FLOORS = [
    {"errors", "arrays", "measured"},
    {"checks", "atomic"},
    {"material", "road", "choices", "rigchoice", "relaxation", "outcome", "checkpoint"},
    {"reference", "past"},
    {"scene", "homogeneous"},
    {"readings", "configfile", "statements"},
    {"folding", "cell", "finitestrain", "procedure", "saturation", "presets", "resolvable"},
    {"block", "branches"},
    {"smallstrain", "finiteblock", "surfacemodes", "resolution", "routes"},
    {"strain", "contact", "circulant"},
    {"solution", "slidingcontact", "prolongation", "finitehistory"},
    {"kinematics", "newton"},
    {"continuation", "uncertainty"},
    {"refinement"},
    {"smallsteady", "finitesteady", "smalltransient", "finitetransient"},
    {"steady"},
    {"marching"},
    {"transient"},
    {"smallenergy", "finiteenergy"},
    {"energy", "cautions", "scalars"},
    {"dataset", "converged"},
    {"simulation", "summary", "marchdata"},
    {"ladder", "calibration"},
    {"trade"},
    {"pages"},
    {"multiscale", "tablepage"},
    {"collection", "frictionmap"},
    {"tables"},
    {"rig", "observation"},
    {"evidence"},
    {"judgement"},
    {"claimspage"},
    {"figures"},
    {"explorer"},
    {"campaign", "verdict"},
    {"rigcli"},
    {"trials", "extremes", "sources"},
    {"jobs", "warm", "cli", "trial", "records", "progress", "findings", "configdoc"},
    {"stability", "runlog"},
]
MOST_LINES = 260

MODULES = {
    path.relative_to(PACKAGE).with_suffix("").as_posix().replace("/", "."): path
    for path in sorted(PACKAGE.rglob("*.py"))
    if path != PACKAGE / "__init__.py"
}


def imports(module: str) -> Iterator[tuple[str, bool]]:
    """Yield the dotted names that a module imports, and whether each import stands inside a function."""
    tree = ast.parse(MODULES[module].read_text(encoding="utf-8"))
    functions = [
        node for node in ast.walk(tree) if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda))
    ]
    inner = {id(below) for function in functions for below in ast.walk(function)}
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            for alias in node.names:
                yield alias.name, id(node) in inner
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{module} imports relatively"
            for alias in node.names:
                yield f"{node.module}.{alias.name}", id(node) in inner


def own_imports(module: str) -> set[str]:
    """Return the modules of the package, by their dotted names in it, that a module imports."""
    found = set()
    for name, _ in imports(module):
        first, *rest = name.split(".")
        if first == "rubfric":
            candidates = [".".join(rest[:length]) for length in range(len(rest), 0, -1)]
            found |= {next((candidate for candidate in candidates if candidate in MODULES), "")} - {""}
    return found


def outside_imports(module: str) -> set[tuple[str, bool]]:
    """Return the libraries that a module imports, and whether it does so inside a function."""
    return {(name.partition(".")[0], inside) for name, inside in imports(module) if not name.startswith("rubfric")}


def floor(module: str) -> int:
    """Return the number of a module's floor, 0 being the lowest."""
    top = module.partition(".")[0]
    return next(number for number, names in enumerate(FLOORS) if top in names)


def are_neighbours(module: str, other: str) -> bool:
    """Return whether two modules belong to one sub-package."""
    return "." in module and module.partition(".")[0] == other.partition(".")[0]


def is_figure(module: str) -> bool:
    return module.startswith("figures.")


FIGURES = [module for module in MODULES if is_figure(module)]


def test_every_module_has_a_floor_and_every_floor_its_modules() -> None:
    named = [name for names in FLOORS for name in names]
    assert len(named) == len(set(named))
    assert {module.partition(".")[0] for module in MODULES} == set(named)


@pytest.mark.parametrize("module", MODULES)
def test_imports_point_down(module: str) -> None:
    for below in own_imports(module):
        if are_neighbours(module, below):
            continue
        assert floor(below) < floor(module), f"{module} imports {below}"


@pytest.mark.parametrize("module", FIGURES)
def test_no_figure_is_imported_by_another(module: str) -> None:
    assert not {below for below in own_imports(module) if re.fullmatch(r"figures\.fig\d+", below)}


@pytest.mark.parametrize("package", ["figures", "rig", "explorer"])
def test_sub_packages_do_not_import_in_circles(package: str) -> None:
    modules = [module for module in MODULES if module.startswith(f"{package}.")]
    waiting = {module: {below for below in own_imports(module) if are_neighbours(module, below)} for module in modules}
    assert waiting
    while waiting:
        free = {module for module, below in waiting.items() if not below & waiting.keys()}
        assert free, f"circle among {sorted(waiting)}"
        waiting = {module: below for module, below in waiting.items() if module not in free}


def test_figures_read_datasets_and_nothing_of_the_mechanics() -> None:
    allowed = {"errors", "arrays", "atomic", "checks", "multiscale", "frictionmap"}
    for module in FIGURES:
        assert {below for below in own_imports(module) if not is_figure(below)} <= allowed, module


def test_campaign_stays_below_the_mechanics() -> None:
    assert {floor(below) for below in own_imports("campaign")} <= set(range(floor("block")))


def test_only_figures_import_matplotlib() -> None:
    users = {(module, inside) for module in MODULES for name, inside in outside_imports(module) if name == "matplotlib"}
    assert users
    assert {module for module, inside in users if not is_figure(module)} <= {"warm"}
    assert ("warm", False) not in users


def test_only_explorer_imports_plotly() -> None:
    users = {module for module in MODULES for name, _ in outside_imports(module) if name == "plotly"}
    assert users
    assert all(module.startswith("explorer.") for module in users)


def test_explorer_reads_datasets_and_nothing_of_the_mechanics() -> None:
    allowed = {"errors", "arrays", "atomic", "checks", "multiscale", "figures.deformation"}
    for module in (module for module in MODULES if module.startswith("explorer.")):
        assert {below for below in own_imports(module) if not below.startswith("explorer.")} <= allowed, module


def test_only_cell_imports_skfem() -> None:
    assert {module for module in MODULES for name, _ in outside_imports(module) if name == "skfem"} == {"cell"}


def test_nothing_uses_pyplot() -> None:
    scripts = [*MODULES.values(), *WORKFLOW.rglob("*.py")]
    assert not [path.name for path in scripts if re.search(r"\bpyplot\b|\bpylab\b", path.read_text(encoding="utf-8"))]


def test_package_itself_imports_nothing_of_its_own() -> None:
    tree = ast.parse((PACKAGE / "__init__.py").read_text(encoding="utf-8"))
    froms = [node.module for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)]
    plain = [alias.name for node in ast.walk(tree) if isinstance(node, ast.Import) for alias in node.names]
    assert not [name for name in (*froms, *plain) if name and name.startswith("rubfric")]


@pytest.mark.parametrize("module", MODULES)
def test_no_module_is_a_drawer_for_odds_and_ends(module: str) -> None:
    words = re.split(r"[._]", module)
    assert not set(words) & {"util", "utils", "utilities", "helper", "helpers", "misc", "common", "tools"}


@pytest.mark.parametrize("module", MODULES)
def test_modules_are_short_and_described(module: str) -> None:
    source = MODULES[module].read_text(encoding="utf-8")
    assert len(source.splitlines()) <= MOST_LINES
    assert ast.get_docstring(ast.parse(source))
