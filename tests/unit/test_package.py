"""What is installed stands alone: a wheel in an empty folder, and a clone beside the user's scripts."""

from __future__ import annotations

import subprocess
import sys
import sysconfig
import venv
import zipfile
from pathlib import Path

import pytest
from project_copy import SOURCE, Project

pytestmark = pytest.mark.thorough


@pytest.fixture(scope="module")
def clone(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The project in a folder of the package's name, as git makes it."""
    return Project.from_source(tmp_path_factory.mktemp("projects") / "rubfric").root


def run(folder: Path, *command: str, **environment: str) -> str:
    done = subprocess.run(
        command, cwd=folder, env={"PATH": "/usr/bin:/bin", **environment}, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_wheel_works_in_any_folder(clone: Path, tmp_path: Path) -> None:
    pip = (sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", "--no-index", "--no-build-isolation")
    run(clone, *pip, "--wheel-dir", str(tmp_path), ".")
    with zipfile.ZipFile(next(tmp_path.glob("*.whl"))) as wheel:
        wheel.extractall(tmp_path / "site")
    package, empty = tmp_path / "site" / "rubfric", tmp_path / "empty"
    assert (package / "config" / "default.yaml").read_text() == (SOURCE / "config" / "config.yaml").read_text()
    schema = SOURCE / "workflow" / "schemas" / "config.schema.yaml"
    assert (package / "config" / "schema.yaml").read_text() == schema.read_text()
    templates = {path.relative_to(SOURCE) for path in (SOURCE / "rubfric" / "pages").rglob("*.*") if path.is_file()}
    kept = {path for path in templates if path.suffix in {".html", ".css", ".js"}}
    assert kept
    assert all((package.parent / path).is_file() for path in kept)
    empty.mkdir()
    scene = ("simulate", "--scale", "1", "--velocity", "100", "--pressure", "5", "--kinematics", "small")
    said = run(empty, sys.executable, "-m", "rubfric.cli", *scene, PYTHONPATH=str(package.parent))
    assert "friction coefficient" in said
    name = run(
        empty, sys.executable, "-c", "import rubfric; print(rubfric.load().road_name)", PYTHONPATH=str(package.parent)
    )
    assert name == "zhou2019\n"
    assert not list(empty.iterdir())


def test_clone_beside_a_script_does_not_hide_the_package(clone: Path, tmp_path: Path) -> None:
    venv.create(tmp_path / "venv", with_pip=False)
    python = tmp_path / "venv" / "bin" / "python"
    site = Path(run(tmp_path, str(python), "-c", "import sysconfig; print(sysconfig.get_path('purelib'))").strip())
    (site / "libraries.pth").write_text(f"{sysconfig.get_path('purelib')}\n")
    pip = ("-m", "pip", "install", "--quiet", "--no-deps", "--no-index", "--no-build-isolation", "--editable")
    run(clone, str(python), *pip, ".")
    script = clone.parent / "beside.py"
    script.write_text("import rubfric; print(rubfric.load().road_name, rubfric.__file__)")
    assert run(clone.parent, str(python), "beside.py") == f"zhou2019 {clone / 'rubfric' / '__init__.py'}\n"
    assert run(clone.parent, str(python), "-m", "rubfric.cli", "--version").startswith("rubfric ")
