"""Arrays to go on from: they come back as they were, to the work that they belong to."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from rubfric.errors import BrokenResult
from rubfric.mechanics.march import checkpoint


def test_arrays_come_back_as_they_were(tmp_path: Path, rng: np.random.Generator) -> None:
    arrays = {
        "a.b": rng.standard_normal((2, 3)),
        "c": rng.random(4) > 0.5,
        "d": np.array(np.inf),
        "e": np.zeros(2) * 1j,
    }
    checkpoint.write(tmp_path / "new" / "state.npz", "some work", arrays)
    found = checkpoint.read(tmp_path / "new" / "state.npz", "some work")
    assert found.keys() == arrays.keys()
    for name, array in arrays.items():
        np.testing.assert_array_equal(found[name], array)
        assert found[name].dtype == array.dtype


def test_other_work_is_refused(tmp_path: Path) -> None:
    checkpoint.write(tmp_path / "state.npz", "some work", {})
    with pytest.raises(BrokenResult, match="belongs to other work: it has the label 'some work', not 'more work'"):
        checkpoint.read(tmp_path / "state.npz", "more work")


@pytest.mark.parametrize("content", [b"", b"no archive", b"PK\x03\x04"])
def test_broken_files_are_named(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "state.npz"
    path.write_bytes(content)
    with pytest.raises(BrokenResult, match=r"state\.npz cannot be read"):
        checkpoint.read(path, "some work")


def test_nothing_is_left_of_an_interrupted_writing(tmp_path: Path) -> None:
    with pytest.raises(TypeError):
        checkpoint.write(tmp_path / "state.npz", "some work", {"file": np.zeros(1)})  # the name of savez's own argument
    assert not list(tmp_path.iterdir())
