"""Which files a result depends on: those whose import runs, and no others."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

import rubfric
import rubfric.sources
from rubfric.errors import BrokenResult
from rubfric.runner.reruns import check_records, stamp
from rubfric.sources import sources

PACKAGE = Path(rubfric.__file__).resolve().parent
MODULES = [
    "rubfric.simulation",
    "rubfric.results.campaign",
    "rubfric.results.tables",
    "rubfric.config.rig",
    "rubfric.results.summary",
]


def imported(module: str) -> set[str]:
    """Return the modules of the package that a fresh interpreter has run after importing one, by their files."""
    code = (
        f"import sys, {module}\n"
        "loaded = [value for name, value in sys.modules.items() if name.startswith('rubfric.')]\n"
        "print('\\n'.join(value.__file__ for value in loaded))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return {path for path in done.stdout.split() if not path.endswith("__init__.py")}


@pytest.mark.parametrize("module", [*MODULES, "rubfric.figures.fig7"])
def test_sources_are_the_modules_whose_import_runs(module: str) -> None:
    assert {str(path) for path in sources(module)} == imported(module)


def test_imports_inside_functions_count() -> None:
    assert PACKAGE / "simulation.py" in sources("rubfric.cli")
    assert str(PACKAGE / "simulation.py") not in imported("rubfric.cli")


def test_sources_of_several_modules_are_their_union() -> None:
    both = sources("rubfric.simulation", "rubfric.results.tables")
    assert set(both) == set(sources("rubfric.simulation")) | set(sources("rubfric.results.tables"))
    assert list(both) == sorted(both)


def test_sources_are_absolute_files_of_the_package() -> None:
    for path in sources("rubfric.simulation"):
        assert path.is_absolute()
        assert path.is_file()
        assert path.is_relative_to(PACKAGE)
        assert path.name != "__init__.py"


def test_scenes_do_not_depend_on_what_comes_after_them() -> None:
    files = {path.relative_to(PACKAGE).as_posix() for path in sources("rubfric.simulation")}
    after = {f"results/{name}.py" for name in ("campaign", "tables", "scales", "summary")} | {"cli.py", "marching.py"}
    assert not files & after
    assert not {name for name in files if name.startswith(("figures/", "pages/", "rig/", "runner/", "studies/"))}
    assert {
        f"mechanics/{name}.py" for name in ("block/contact", "block/block", "small/steady", "finite/energy")
    } <= files
    assert {"results/dataset.py", "checks.py"} <= files


@pytest.mark.parametrize(
    "module", ["rubfric.simulations", "rubfric.figures.fig99", "numpy", "rubfric", "rubfric.figures", ""]
)
def test_unknown_module_is_refused(module: str) -> None:
    with pytest.raises(ModuleNotFoundError, match=f"^{module} is not a module of rubfric$"):
        sources(module)


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A package of two modules, the first of which imports the second; both an hour old."""
    folder = tmp_path / "rubfric"
    folder.mkdir()
    for name, text in (("first", "from rubfric.second import this\n"), ("second", "this = 1\n"), ("third", "")):
        (folder / f"{name}.py").write_text(text)
        os.utime(folder / f"{name}.py", (1e9, 1e9))
    monkeypatch.setattr("rubfric.sources.PACKAGE", folder)
    forget()
    return folder


def forget() -> None:
    """Let the next call read the files anew, as another run does."""
    for function in (sources, stamp, rubfric.sources._imported):
        function.cache_clear()


def test_stamp_is_as_old_as_the_youngest_source_and_stays_while_they_do(package: Path, tmp_path: Path) -> None:
    os.utime(package / "second.py", (1.1e9, 1.1e9))
    place = Path(stamp(tmp_path / "stamps", "rubfric.first"))
    assert place == tmp_path / "stamps" / "rubfric.first"
    assert [line.split()[1] for line in place.read_text().splitlines()] == ["rubfric/first.py", "rubfric/second.py"]
    assert place.stat().st_mtime == 1.1e9
    os.utime(package / "second.py")
    (package / "third.py").write_text("other = 2\n")
    forget()
    assert stamp(tmp_path / "stamps", "rubfric.first") == str(place)
    assert place.stat().st_mtime == 1.1e9


@pytest.mark.parametrize("name", ["first", "second"])
def test_stamp_is_new_where_a_source_has_changed_however_old_it_looks(package: Path, tmp_path: Path, name: str) -> None:
    place = Path(stamp(tmp_path, "rubfric.first"))
    before = place.read_text()
    (package / f"{name}.py").write_text((package / f"{name}.py").read_text() + "# A remark.\n")
    os.utime(package / f"{name}.py", (1e9, 1e9))
    forget()
    stamp(tmp_path, "rubfric.first")
    changed = [line for line in place.read_text().splitlines() if line not in before.splitlines()]
    assert [line.split()[1] for line in changed] == [f"rubfric/{name}.py"]
    assert place.stat().st_mtime > 1.1e9


def test_stamp_that_was_lost_or_damaged_is_made_again(package: Path, tmp_path: Path) -> None:
    place = Path(stamp(tmp_path, "rubfric.first", "rubfric.third"))
    text = place.read_text()
    assert len(text.splitlines()) == 3
    for damage in (lambda: place.write_bytes(b"\xff\xfe"), place.unlink):
        damage()
        forget()
        assert stamp(tmp_path, "rubfric.first", "rubfric.third") == str(place)
        assert place.read_text() == text
    assert place.stat().st_mtime == 1e9


def test_records_of_text_pass_and_so_does_a_missing_folder(tmp_path: Path) -> None:
    (tmp_path / "below").mkdir()
    (tmp_path / "below" / "a").write_text('{"rule": "scene", "rubber": "weiß"}')
    (tmp_path / "b").write_bytes(b'{"rule": "sc')
    (tmp_path / "c").write_bytes(b"")
    check_records(tmp_path)
    check_records(tmp_path / "nowhere")


def test_records_that_are_not_text_are_named(tmp_path: Path) -> None:
    (tmp_path / "a").write_text("{}")
    (tmp_path / "b").write_bytes(b"\xff\xfe{}")
    sentence = f"Snakemake's record {tmp_path}/b is damaged: delete all of them (rm -r {tmp_path}) and run again"
    with pytest.raises(BrokenResult, match=f"^{re.escape(sentence)}"):
        check_records(tmp_path)
