from __future__ import annotations

import pickle

import pytest

from rubfric.errors import BrokenResult, InvalidInput, NotConverged, RubfricError


@pytest.mark.parametrize(
    ("error", "builtin"), [(InvalidInput, ValueError), (NotConverged, RuntimeError), (BrokenResult, OSError)]
)
def test_each_error_is_the_projects_and_the_builtin(error: type, builtin: type) -> None:
    assert issubclass(error, RubfricError)
    assert issubclass(error, builtin)


def test_not_converged_names_scene_step_residual_and_measure() -> None:
    message = str(NotConverged("scale1_v100", 37, 0.012345, "force imbalance in N/mm"))
    assert message == "scale1_v100: not converged after 37 steps, force imbalance in N/mm is 0.0123"


def test_not_converged_survives_pickling() -> None:
    error = NotConverged("scale1_v100", 37, 0.5, "violated nodes")
    twin = pickle.loads(pickle.dumps(error))
    assert type(twin) is NotConverged
    assert (twin.scene, twin.step, twin.residual, twin.measure) == ("scale1_v100", 37, 0.5, "violated nodes")
    assert str(twin) == str(error)
