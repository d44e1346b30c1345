"""A wrong config stops the workflow before any job, with one sentence."""

from __future__ import annotations

import re
import subprocess

import pytest
from project_copy import MINIMAL, Project


@pytest.fixture(scope="module")
def fresh(tmp_path_factory: pytest.TempPathFactory) -> Project:
    return Project.from_source(tmp_path_factory.mktemp("fresh"))


def own_lines(done: subprocess.CompletedProcess[str]) -> list[str]:
    """Return what stands on stderr beside Snakemake's two remarks on the profile and on the configs."""
    return [
        line for line in done.stderr.splitlines() if not re.match(r"Using workflow specific|Config file \S+ is", line)
    ]


def assert_refused(fresh: Project, done: subprocess.CompletedProcess[str], sentence: str) -> None:
    assert done.returncode == 1
    assert own_lines(done) == [f"The config is wrong: {sentence}."]
    assert sentence in done.stderr
    assert not fresh.results.exists()


@pytest.mark.parametrize(
    ("overlay", "sentence"),
    [
        (
            "grid: {velocities: [1e-3, 1]}",
            "grid.velocities[0] is the text '1e-3', but must be a number (YAML reads it as text; write 1.0e-3)",
        ),
        pytest.param(
            "grid: {velocity: [1]}",
            "grid has the unknown key 'velocity'; allowed are velocities, pressures, aspect, temperatures, refine "
            "(did you mean velocities?)",
            marks=pytest.mark.thorough,
        ),
        pytest.param(
            "rubbers: {gummi_weiß: {youngs_modulus: 1, poissons_ratio: 0, shear_fractions: [], relaxation_times: []}}",
            "name in rubbers is 'gummi_weiß', but must be a word of letters, digits, '-' and '_'",
            marks=pytest.mark.thorough,
        ),
        (
            "grid:\n  pressures: [1]\n  aspect: 1\n  pressures: [2]\n",
            "bad.yaml has the key 'grid.pressures' twice, in lines 2 and 4; keep one",
        ),
    ],
)
def test_bad_overlay_is_refused_in_one_sentence(fresh: Project, overlay: str, sentence: str) -> None:
    (fresh.root / "bad.yaml").write_text(overlay, encoding="utf-8")
    with_overlay = Project(fresh.root, (*MINIMAL, "bad.yaml"))
    assert_refused(fresh, with_overlay.snakemake(), sentence)


def test_bad_value_on_the_command_line_is_refused_in_one_sentence(fresh: Project) -> None:
    done = fresh.snakemake("--config", "plane=flat")
    assert_refused(fresh, done, "plane is 'flat', but must be one of stress, strain")


def test_file_that_snakemake_cannot_read_is_refused_in_one_sentence(fresh: Project) -> None:
    (fresh.root / "bad.yaml").write_bytes(b"plane: strain  # gr\xfcn\n")
    done = Project(fresh.root, (*MINIMAL, "bad.yaml")).snakemake()
    assert done.returncode == 1
    assert [line for line in own_lines(done) if line.startswith("The config is wrong: bad.yaml is not")] == own_lines(
        done
    )


@pytest.mark.thorough
def test_dry_run_refuses_it_too(fresh: Project) -> None:
    done = fresh.snakemake("-n", "--config", "rubber=zhou")
    assert_refused(fresh, done, "rubber is 'zhou', but must be one of zhou2019 (did you mean zhou2019?)")
