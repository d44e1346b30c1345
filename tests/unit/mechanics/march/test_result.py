"""Press and slide a scene: what comes back, what is said on the way, what is left to go on from."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from rubfric import marching
from rubfric.marching import march
from rubfric.scene.procedure import Procedure
from rubfric.scene.scene import Scene

SceneMaker = Callable[..., Scene]
QUICK = Procedure(
    columns=16, steps_per_wavelength=16, loading_steps=8, hold_steps=4, wavelengths=3, until_saturated=False
)


def test_means_are_those_of_whole_wavelengths_at_full_speed(paper_scene: SceneMaker) -> None:
    found = march(paper_scene(10.0, 0.5), QUICK)
    assert found.kinematics == "small"
    assert found.sliding == slice(20, None)
    friction = found.records["friction_contact"][20:]
    np.testing.assert_allclose(found.means(), [friction[:16].mean(), friction[16:32].mean(), friction[32:].mean()])
    assert found.saturation.friction == found.means()[-1]
    assert found.saturation.wavelengths == 3
    assert found.seconds > 0.0
    assert 0.0 < found.imbalance < 0.1
    for route in ("friction_work", "friction_energy"):
        assert found.means(route)[-1] == pytest.approx(found.means()[-1], rel=0.1)


def test_progress_is_reported(paper_scene: SceneMaker, monkeypatch: pytest.MonkeyPatch) -> None:
    lines: list[str] = []
    monkeypatch.setattr(marching, "_SILENCE", 0.0)
    march(paper_scene(10.0, 0.5), QUICK, progress=lines.append)
    assert len(lines) == 68
    assert "scale1_v10_p0.5_aspect0.75_strain: step 1 of at most 68 (press), slid 0.00 wavelengths" in lines[0]
    assert "step 68 of at most 68 (slide), slid 3.25 wavelengths, friction 0." in lines[-1]
    assert lines[-1].endswith(" steps/s")


def test_file_to_go_on_from_is_used(paper_scene: SceneMaker, tmp_path: Path) -> None:
    scene, path = paper_scene(10.0, 0.5), tmp_path / "march.npz"
    first = march(scene, QUICK, restart=path, seconds_between=0.0)
    assert path.exists()
    longer = Procedure(**{**vars(QUICK), "wavelengths": 4})
    second, at_once = march(scene, longer, restart=path), march(scene, longer)
    np.testing.assert_array_equal(second.means()[:3], first.means())
    np.testing.assert_allclose(second.means(), at_once.means(), rtol=1e-12)
