"""A file cut short or with a changed byte is never taken for what it was."""

from __future__ import annotations

import shutil
from pathlib import Path

import netCDF4
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rubfric.errors import BrokenResult
from rubfric.mechanics.march import checkpoint
from rubfric.results import campaign as collection
from rubfric.results import dataset
from rubfric.road.sine import SineScale
from rubfric.rubber.material import Material
from rubfric.scene.scene import Scene
from rubfric.simulation import simulate

SCENE = Scene(1, SineScale(0.015, 35.0), 100.0, 5.0, 0.75, Material("any", 4.0, 0.45, (0.9,), (1e-4,)), "stress")
ARRAYS = {"a": np.linspace(0.0, 1.0, 50), "b": np.arange(6.0).reshape(2, 3) * 1j}


@pytest.fixture(scope="module")
def place(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a result, a collection, a checkpoint and, for each, a file to damage."""
    folder = tmp_path_factory.mktemp("whole")
    dataset.write(simulate(SCENE), folder / "scene.nc")
    dataset.write(collection.collect([folder / "scene.nc"], [SCENE.digest]), folder / "campaign.nc")
    checkpoint.write(folder / "march.npz", "some work", ARRAYS)
    return folder


def cut(place: Path, name: str, share: float) -> Path:
    """Return a copy of a file that lacks its end."""
    content = (place / name).read_bytes()
    damaged = place / f"damaged-{name}"
    damaged.write_bytes(content[: min(int(share * len(content)), len(content) - 1)])
    return damaged


shares = st.one_of(st.floats(0.0, 1.0), st.sampled_from([0.0, 1e-4, 0.999, 1.0]))


@given(share=shares)
@settings(max_examples=40)
def test_result_cut_anywhere_is_named(place: Path, share: float) -> None:
    damaged = cut(place, "scene.nc", share)
    with pytest.raises(BrokenResult, match=r"damaged-scene\.nc cannot be read: .*; delete it and run again"):
        dataset.read(damaged)
    with pytest.raises(BrokenResult, match=r"damaged-scene\.nc cannot be read: [^;]*; delete it and run again$"):
        collection.collect([damaged])


@pytest.mark.parametrize("name", ["scene.nc", "campaign.nc"])
def test_flipped_bit_is_named(place: Path, name: str, rng: np.random.Generator) -> None:
    content, damaged = (place / name).read_bytes(), place / f"flipped-{name}"
    for bit in rng.integers(8 * len(content), size=300):
        changed = bytearray(content)
        changed[bit // 8] ^= 1 << (bit % 8)
        damaged.write_bytes(changed)
        with pytest.raises(
            BrokenResult, match=rf"flipped-{name} cannot be read: .* checksum.*; delete it and run again$"
        ):
            dataset.load(damaged)
        if name == "scene.nc":
            with pytest.raises(BrokenResult, match=r"flipped-scene\.nc cannot be read"):
                collection.collect([damaged])


def test_forged_attribute_and_scalar_are_named(place: Path) -> None:
    forged = place / "forged.nc"
    for forge in (
        lambda stored: stored.setncattr("velocity", 50.0),
        lambda stored: stored["friction_coefficient"].__setitem__(..., 0.1),
        lambda stored: stored["friction_coefficient"].setncattr("units", "2"),
    ):
        shutil.copy(place / "scene.nc", forged)
        with netCDF4.Dataset(forged, "a") as stored:
            forge(stored)
        with pytest.raises(BrokenResult, match=r"forged\.nc cannot be read: .*; delete it and run again$"):
            collection.collect([forged], [SCENE.digest])


@given(share=shares)
@settings(max_examples=40)
def test_collection_cut_anywhere_is_named(place: Path, share: float) -> None:
    with pytest.raises(BrokenResult, match=r"damaged-campaign\.nc cannot be read: .*; delete it and run again"):
        collection.read(cut(place, "campaign.nc", share))


@given(share=shares)
@settings(max_examples=60)
def test_checkpoint_cut_anywhere_is_named(place: Path, share: float) -> None:
    with pytest.raises(BrokenResult, match=r"damaged-march\.npz cannot be read"):
        checkpoint.read(cut(place, "march.npz", share), "some work")


@given(share=st.floats(0.0, 0.999999), byte=st.integers(1, 255))
@settings(max_examples=100)
def test_checkpoint_with_a_changed_byte_is_named(place: Path, share: float, byte: int) -> None:
    content = bytearray((place / "march.npz").read_bytes())
    content[int(share * len(content))] ^= byte
    damaged = place / "changed.npz"
    damaged.write_bytes(content)
    with pytest.raises(BrokenResult, match=r"changed\.npz cannot be read"):
        checkpoint.read(damaged, "some work")


def test_result_of_another_scene_and_what_is_no_result_are_told_apart(place: Path) -> None:
    assert dataset.read(place / "scene.nc", SCENE.digest).attrs["scene"] == SCENE.name
    with pytest.raises(BrokenResult, match=r"scene\.nc is the result of another scene, rubber or numerics"):
        dataset.read(place / "scene.nc", "0" * 64)
    with pytest.raises(BrokenResult, match=r"campaign\.nc is no result of rubfric"):
        dataset.read(place / "campaign.nc")
    with pytest.raises(BrokenResult, match=r"scene\.nc is no collection of results; delete it and run again"):
        collection.read(place / "scene.nc")


def test_all_that_is_wrong_is_named_with_the_command_that_removes_it(place: Path) -> None:
    damaged = cut(place, "scene.nc", 0.5)
    with pytest.raises(BrokenResult) as caught:
        collection.collect([damaged, place / "scene.nc"], [SCENE.digest, "0" * 64])
    assert str(caught.value).endswith(
        f"; 1 more cannot be used either; delete them all and run again: rm {damaged} {place / 'scene.nc'}"
    )
