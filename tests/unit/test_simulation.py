"""One scene from its parameters to its dataset."""

from __future__ import annotations

import ast
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
import xarray as xr

import rubfric
from rubfric import simulation
from rubfric.errors import InvalidInput, NotConverged
from rubfric.mechanics.block import contact
from rubfric.mechanics.finite import continuation
from rubfric.mechanics.finite.newton import Stalled
from rubfric.mechanics.steady.energies import Energies
from rubfric.road.sine import SineScale
from rubfric.rubber.material import Material
from rubfric.scene.numerics import Numerics, fineness
from rubfric.scene.scene import Scene
from rubfric.simulation import simulate

KINEMATICS = pytest.mark.parametrize("kinematics", ["small", "finite"])
CONFIG = Path(__file__).resolve().parents[2] / "config" / "config.yaml"


@pytest.fixture
def scene() -> Scene:
    rubber = Material("small", 4.17, 0.49, (0.3, 0.4), (1e-3, 1e-5))
    coarse = Numerics(
        contact_nodes=16,
        finite_contact_nodes=8,
        columns_min=64,
        finite_columns_min=32,
        row_growth=1.4,
        output_columns=32,
    )
    return Scene(1, SineScale(0.015, 35.0), 100.0, 0.5, 0.75, rubber, "stress", coarse, "small")


@pytest.fixture
def finite(scene: Scene) -> Scene:
    return replace(scene, kinematics="finite")


@KINEMATICS
def test_dataset_holds_what_the_solver_and_the_energies_say(scene: Scene, kinematics: str) -> None:
    scene = replace(scene, kinematics=kinematics)
    result = simulate(scene)
    solution = simulation.solve(scene)
    energies = simulation.evaluate(solution)
    assert isinstance(result, xr.Dataset)
    assert float(result["friction_coefficient"]) == energies.stress_power
    assert float(result["friction_coefficient_dissipation"]) == energies.dissipation
    assert float(result["friction_coefficient_contact"]) == energies.contact
    assert float(result["energy_closure"]) == energies.closure
    assert result["contact_pressure"].values.tolist() == solution.contact.pressure.tolist()
    assert int(result["iterations"]) == solution.iterations


@KINEMATICS
def test_same_scene_gives_the_same_numbers(scene: Scene, kinematics: str) -> None:
    scene = replace(scene, kinematics=kinematics)
    first, second = (simulate(scene).drop_vars("wall_time") for _ in range(2))
    xr.testing.assert_identical(first, second)


def test_wall_time_is_that_of_the_solution(scene: Scene, monkeypatch: pytest.MonkeyPatch) -> None:
    clock = iter([10.0, 12.5])
    monkeypatch.setattr("rubfric.simulation.time.perf_counter", lambda: next(clock))
    assert float(simulate(scene)["wall_time"]) == 2.5


def test_scene_that_does_not_converge_has_no_result(scene: Scene, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(contact, "MOST_STEPS", 1)
    with pytest.raises(
        NotConverged, match=rf"^{scene.name}: not converged after 1 steps, number of .* is \d+; another mesh may do: "
    ):
        simulate(scene)


def test_scene_that_does_not_converge_in_finite_strain_has_no_result(
    finite: Scene, monkeypatch: pytest.MonkeyPatch
) -> None:
    def stall(*_: object) -> None:
        raise Stalled("too many steps", 3, 40, 0.5)

    monkeypatch.setattr(continuation, "newton", stall)
    with pytest.raises(NotConverged, match=rf"^{finite.name}: not converged after \d+ steps, distance from balance"):
        simulate(finite)


def test_full_contact_needs_no_steps(scene: Scene, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(contact, "MOST_STEPS", 0)
    assert int(simulate(replace(scene, pressure=50.0))["iterations"]) == 0


def test_three_lines_of_the_package_answer() -> None:
    campaign = rubfric.load(CONFIG)
    result = rubfric.simulate(campaign.scene(scale=1, velocity=100, pressure=5))
    assert float(result.friction_coefficient) == pytest.approx(0.206, rel=0.01)


def test_three_lines_answer_in_small_strain_too() -> None:
    campaign = rubfric.load(CONFIG)
    scene = campaign.scene(scale=1, velocity=100, pressure=5, kinematics="small")
    result = rubfric.simulate(scene)
    finer = rubfric.simulate(replace(scene, numerics=replace(scene.numerics, **fineness(1.0))))
    assert float(finer.friction_coefficient) == pytest.approx(0.1287, abs=5e-5)
    error = float(result.friction_coefficient_error)
    assert 0.0 < error <= 0.01 * float(result.friction_coefficient)
    assert float(result.friction_coefficient) == pytest.approx(float(finer.friction_coefficient), abs=error)


def test_accuracy_may_be_given_beside_the_scene(scene: Scene) -> None:
    sharper = rubfric.simulate(scene, accuracy=0.002)
    same = rubfric.simulate(replace(scene, numerics=replace(scene.numerics, accuracy=0.002)))
    for name in ("friction_coefficient", "friction_coefficient_error"):
        assert float(sharper[name]) == float(same[name])
    assert sharper.attrs["scene_digest"] == same.attrs["scene_digest"]
    with pytest.raises(InvalidInput, match="accuracy is 2"):
        rubfric.simulate(scene, accuracy=2)


def test_package_offers_what_it_lists_to_users_and_to_editors() -> None:
    for name in rubfric.__all__:
        assert getattr(rubfric, name) is not None
    tree = ast.parse(Path(rubfric.__file__).read_text(encoding="utf-8"))
    seen = {alias.name for node in ast.walk(tree) if isinstance(node, ast.ImportFrom) for alias in node.names}
    assert set(rubfric.__all__) - {"__version__"} <= seen
    assert set(dir(rubfric)) == set(rubfric.__all__)
    with pytest.raises(AttributeError, match="module 'rubfric' has no attribute 'simulat'"):
        rubfric.simulat  # noqa: B018


@KINEMATICS
def test_routes_that_contradict_each_other_are_no_result(
    scene: Scene, kinematics: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    mechanics = simulation.MECHANICS[kinematics]

    def halved(solution: object) -> Energies:
        energies = mechanics.evaluate(solution)
        return replace(energies, contact=0.5 * energies.contact)

    monkeypatch.setitem(simulation.MECHANICS, kinematics, replace(mechanics, evaluate=halved))
    with pytest.raises(NotConverged, match=r"relative difference of the three friction coefficients is 0\.[45]"):
        simulate(replace(scene, kinematics=kinematics))


@pytest.mark.parametrize("solve", [simulate, rubfric.march])
@pytest.mark.parametrize("plane", ["stress", "strain"])
@pytest.mark.parametrize(
    ("kinematics", "tolerance", "largest"),
    [("small", 1e-12, "0.499999995 in small strain"), ("finite", 1e-10, "0.4999995 in finite strain at .* 1e-10")],
)
def test_rubber_without_digits_left_is_refused_by_its_poissons_ratio(
    scene: Scene, solve: Callable[[Scene], object], plane: str, kinematics: str, tolerance: float, largest: str
) -> None:
    rubber = replace(scene.material, poissons_ratio=0.499999999999)
    numerics = replace(scene.numerics, tolerance=tolerance)
    scene = replace(scene, material=rubber, plane=plane, kinematics=kinematics, numerics=numerics)
    sentence = rf"^rubbers\.small\.poissons_ratio is 0\.499999999999, but must be at most {largest}: so nearly "
    with pytest.raises(InvalidInput, match=sentence):
        solve(scene)


@KINEMATICS
@pytest.mark.parametrize("plane", ["stress", "strain"])
def test_largest_poissons_ratio_loses_no_digits(scene: Scene, kinematics: str, plane: str) -> None:
    scene = replace(scene, kinematics=kinematics, plane=plane, pressure=50.0 if kinematics == "small" else 5.0)
    friction = []
    for ratio in (0.49999995, 0.499999995):
        result = simulate(replace(scene, material=replace(scene.material, poissons_ratio=ratio)))
        friction.append(float(result["friction_coefficient"]))
    assert friction[0] == pytest.approx(friction[1], rel=3e-6)


@pytest.mark.parametrize(("refinements", "first_row"), [(0, 1.0), (0, 5.0), (0, 20.0), (0, 100.0), (3, 100.0)])
@pytest.mark.parametrize("point", [(4, 470.0, 0.26, 0.3), (3, 270.0, 0.15, 0.75), (1, 250.0, 0.18, 0.5)])
def test_error_is_within_its_bar_however_high_the_first_row(
    point: tuple[float, ...], refinements: int, first_row: float
) -> None:
    campaign = rubfric.load(CONFIG)
    scene = campaign.scene(*point, kinematics="small", preset="reference")
    fine = simulate(scene)
    draft = replace(campaign.presets["draft"], refinements=refinements, first_row=first_row)
    found = simulate(replace(scene, numerics=draft))
    off = abs(float(found["friction_coefficient"] - fine["friction_coefficient"]))
    assert off <= float(found["friction_coefficient_error"] + fine["friction_coefficient_error"])
    if first_row == 100.0:
        assert "is not met" in found.attrs["warnings"]
        assert "lower numerics.first_row" in found.attrs["warnings"]
