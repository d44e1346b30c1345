"""Files whole or not at all, and the sentence that says why not: by the system's own refusals."""

from __future__ import annotations

import errno
import os
import resource
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from rubfric.errors import NotWritten, RubfricError
from rubfric.files import check_folder, check_place, mark, remove_parts, whole, why_not
from rubfric.results.dataset import write


@contextmanager
def files_up_to(size: int) -> Iterator[None]:
    """Let no file of this process grow beyond so many bytes; Python ignores the signal that would end it."""
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))


def full_disk(target: Path) -> None:
    """Have what is written for ``target`` end up on a device that is always full."""
    with pytest.raises(ZeroDivisionError), whole(target) as part:
        part.write_text(f"{1 // len('')}")
    part.symlink_to("/dev/full")


def test_file_appears_when_it_is_complete(tmp_path: Path) -> None:
    target = tmp_path / "new" / "file.txt"
    with whole(target) as part:
        part.write_text("some")
        assert part.name.startswith(".")
        assert not target.exists()
    assert target.read_text() == "some"
    assert [path.name for path in target.parent.iterdir()] == ["file.txt"]


def test_failure_leaves_the_file_before_and_nothing_else(tmp_path: Path) -> None:
    target = tmp_path / "file.txt"
    target.write_text("before")
    with pytest.raises(ZeroDivisionError), whole(target) as part:
        part.write_text(f"after {1 // len('')}")
    assert target.read_text() == "before"
    assert [path.name for path in tmp_path.iterdir()] == ["file.txt"]


def test_full_disk_is_said(tmp_path: Path) -> None:
    target = tmp_path / "file.txt"
    full_disk(target)
    with pytest.raises(NotWritten) as caught, whole(target) as part:
        part.write_text("some")
    assert str(caught.value) == (
        f"{target} could not be written, since the disk is full: make room there, then run again "
        "(No space left on device)"
    )
    assert not list(tmp_path.iterdir())


def test_netcdf_file_says_that_the_disk_is_full_though_its_library_does_not(tmp_path: Path) -> None:
    target = tmp_path / "result.nc"
    full_disk(target)
    with pytest.raises(NotWritten, match=r"result\.nc could not be written, since the disk is full"):
        write(xr.Dataset({"a": ("x", np.arange(100000.0))}), target)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("size", [0, 100, 5000, 300000])
def test_netcdf_file_that_may_not_grow_says_so_and_leaves_nothing(
    tmp_path: Path, rng: np.random.Generator, size: int
) -> None:
    target = tmp_path / "result.nc"
    with (
        files_up_to(size),
        pytest.raises(NotWritten, match=r"since files may not grow so large: raise that limit \(ulimit -f unlimited\)"),
    ):
        write(xr.Dataset({"a": ("x", rng.random(100000))}), target)
    assert not list(tmp_path.iterdir())


def test_file_in_place_of_a_folder_is_said(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(NotWritten, match="since a file stands where a folder belongs"), whole(tmp_path / "file" / "a"):
        pass
    for place in (tmp_path / "file", tmp_path / "file" / "below"):
        with pytest.raises(
            NotWritten, match=r"a file stands where a folder belongs: move it away, .*/file is no folder"
        ):
            check_place(place)
        with pytest.raises(NotWritten, match="a file stands where a folder belongs: move it away"):
            check_folder(place)


def test_folder_in_place_of_a_file_is_said(tmp_path: Path) -> None:
    (tmp_path / "file").mkdir()
    with (
        pytest.raises(NotWritten, match="since a folder stands where a file belongs"),
        whole(tmp_path / "file") as part,
    ):
        part.touch()


def test_place_that_can_become_a_folder_passes_and_is_left_alone(tmp_path: Path) -> None:
    for place in (tmp_path, tmp_path / "a", tmp_path / "a" / "b", "relative/to/here", "/"):
        check_place(place)
    assert not list(tmp_path.iterdir())


def test_folder_is_made_and_left_empty(tmp_path: Path) -> None:
    check_folder(tmp_path / "a" / "b")
    assert not list((tmp_path / "a" / "b").iterdir())


@pytest.mark.parametrize("number", [errno.EROFS, errno.EACCES, errno.EPERM, errno.EDQUOT, errno.EIO])
def test_other_refusals_say_what_to_do(number: int) -> None:
    sentence = str(why_not("there", OSError(number, os.strerror(number))))
    assert sentence.startswith("there could not be written, since ")
    assert sentence.endswith(f", then run again ({os.strerror(number)})")


def test_errors_of_other_kinds_are_left_as_they_are() -> None:
    for error in (OSError("netCDF"), OSError(errno.ENOENT, "gone"), NotWritten("said already")):
        assert why_not("there", error) is error


def test_refusal_is_an_error_of_the_project_and_of_the_system() -> None:
    assert issubclass(NotWritten, RubfricError)
    assert issubclass(NotWritten, OSError)


def test_only_what_killed_runs_left_is_removed(tmp_path: Path) -> None:
    dead = subprocess.Popen(["true"])
    dead.wait()
    with whole(tmp_path / "going.nc") as part:
        part.touch()
        host = part.name.split(".")[-3]
        kept = [part.name, "notes.part", ".notes.part", "results.1.part", ".other.nc.ffffff.1.part", ".old.nc.1.part"]
        gone = [f".scene.nc.{host}.{dead.pid}.part", ".far.nc.ffffff.2.part", ".far.nc.2.part"]
        (tmp_path / "deep").mkdir()
        for name in [*kept, *gone]:
            (tmp_path / "deep" / name).touch()
        for name in gone[1:]:
            os.utime(tmp_path / "deep" / name, (0, 0))
        remove_parts(tmp_path)
        assert sorted(path.name for path in (tmp_path / "deep").iterdir()) == sorted(kept)
    assert (tmp_path / "going.nc").exists()


def test_mark_replaces_its_like_and_nothing_of_the_user(tmp_path: Path) -> None:
    (tmp_path / "notes.txt").touch()
    (tmp_path / "folder").mkdir()
    (tmp_path / "0123456789abcdee").write_text("not empty")
    for name in ("0123456789abcdef", "fedcba9876543210", "fedcba9876543210"):
        mark(tmp_path / name)
    assert sorted(path.name for path in tmp_path.iterdir()) == [
        "0123456789abcdee",
        "fedcba9876543210",
        "folder",
        "notes.txt",
    ]
