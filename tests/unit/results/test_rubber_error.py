"""What a measured rubber's data leave open of friction: the power of each harmonic, the scatter, the window."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from rubfric import Material, Scene, load, simulate, write
from rubfric.results.campaign import collect
from rubfric.results.rubber_error import beyond, harmonics, spread
from rubfric.results.selection import RUBBER_ERROR
from rubfric.results.summary import summary
from rubfric.results.tables import scale_table
from rubfric.rubber.fitted import Measured, Sample
from rubfric.simulation import solve

CONFIG = Path(__file__).resolve().parents[3] / "config" / "config.yaml"
RUBBER = load(CONFIG).material


def scattered(count: int, size: float) -> tuple[Sample, ...]:
    """Return the paper's rubber with moduli and times that scatter."""
    rng = np.random.default_rng(2019)
    static, moduli = RUBBER.long_term_shear_modulus, RUBBER.branch_shear_moduli
    found = []
    for _ in range(count):
        factors = 1.0 + size * rng.standard_normal((2, len(moduli)))
        times = tuple(factors[1] * RUBBER.relaxation_times)
        found.append(Sample(static * (1.0 + size * rng.standard_normal()), tuple(factors[0] * moduli), times))
    return tuple(found)


def sliding(velocity: float, pressure: float, kinematics: str, measured: Measured | None, scale: int = 1) -> Scene:
    scene = load(CONFIG).scene(scale, velocity, pressure, kinematics=kinematics, preset="draft")
    return replace(scene, measured=measured)


@pytest.mark.parametrize(
    ("kinematics", "velocity", "pressure", "tolerance"),
    [("small", 100.0, 5.0, 1e-9), ("small", 1.0, 0.2, 1e-9), ("finite", 1.0, 5.0, 1e-9), ("finite", 100.0, 0.5, 0.04)],
)
def test_friction_is_the_sum_of_what_its_harmonics_add(
    kinematics: str, velocity: float, pressure: float, tolerance: float
) -> None:
    # Finite strain has the road's slope at the nodes, from which a Fourier series differs at the edges of a contact.
    solution = solve(sliding(velocity, pressure, kinematics, None))
    wanted = solution.friction.stress_power if kinematics == "small" else solution.friction.contact
    assert harmonics(solution).sum() == pytest.approx(wanted, rel=tolerance)


@pytest.mark.parametrize(("kinematics", "least", "most"), [("small", 0.9, 1.1), ("finite", 0.85, 1.4)])
@pytest.mark.parametrize(("scale", "velocity", "pressure"), [(2, 10.0, 2.0), (1, 1.0, 5.0), (4, 1.0, 0.2)])
def test_scatter_on_the_layer_is_that_of_full_solutions(
    scale: int, velocity: float, pressure: float, kinematics: str, least: float, most: float
) -> None:
    # Of eleven scenes the ratio was 0.95 to 1.05 in small strain, 0.92 to 1.25 in finite strain.
    samples = scattered(6, 0.1)
    scene = sliding(velocity, pressure, kinematics, Measured((1e-9, 1e15), samples), scale)
    scene = replace(scene, numerics=replace(scene.numerics, accuracy=0.02))

    def friction(material: Material) -> float:
        return float(simulate(replace(scene, material=material, measured=None))["friction_coefficient"])

    fitted = friction(scene.material)
    full = np.array([friction(sample.material(scene.material)) for sample in samples]) / fitted - 1.0
    assert np.sqrt(np.mean(full**2)) > 0.02
    assert least < spread(scene) / (1.96 * np.sqrt(np.mean(full**2))) < most


def test_a_sample_of_the_fit_itself_leaves_nothing_open() -> None:
    frequency = np.geomspace(1.0, 1e10, 20)
    for rubber in (RUBBER, replace(RUBBER, bulk="proportional"), replace(RUBBER, moduli="instantaneous")):
        same = Sample(rubber.long_term_shear_modulus, tuple(rubber.branch_shear_moduli), rubber.relaxation_times)
        assert same.material(rubber).complex_shear_modulus(frequency) == pytest.approx(
            rubber.complex_shear_modulus(frequency), rel=1e-9
        )
    own = Sample(RUBBER.long_term_shear_modulus, tuple(RUBBER.branch_shear_moduli), RUBBER.relaxation_times)
    # The share at rest is what twelve digits of the others leave.
    assert spread(sliding(100.0, 0.5, "small", Measured((1.0, 1e9), (own, own)))) < 1e-6


def test_frequencies_beyond_the_window_are_found_warned_of_and_in_the_error(tmp_path: Path) -> None:
    fundamental = 35.0 * 100.0
    within = simulate(sliding(100.0, 0.5, "small", Measured((1.0, 1e9), scattered(10, 0.01))))
    assert 0.0 < float(within[RUBBER_ERROR]) < 0.1 * float(within["friction_coefficient"])
    assert "not measured" not in within.attrs["warnings"]
    for low, high, words in (
        (2.0 * fundamental, 1e9, "friction comes from below 7e+03 rad/s (the road excites 3.5e+03)"),
        (1.0, 0.5 * fundamental, "100% of friction comes from above 1.75e+03 rad/s"),
    ):
        scene = sliding(100.0, 0.5, "small", Measured((low, high)))
        found, shares = simulate(scene), beyond(solve(scene))
        assert float(found["friction_beyond_window"]) == pytest.approx(sum(shares))
        assert float(found[RUBBER_ERROR]) == pytest.approx(sum(shares) * float(found["friction_coefficient"]))
        assert words in found.attrs["warnings"]
        assert "uncertainty" in summary(found)
    write(within, tmp_path / "a.nc")
    table = scale_table(collect([tmp_path / "a.nc"]), 1)
    assert table[RUBBER_ERROR].item() == float(within[RUBBER_ERROR])
    assert table.columns.get_loc(RUBBER_ERROR) == table.columns.get_loc("friction_coefficient_error") + 1
    assert Scene.from_parameters(sliding(1.0, 0.5, "small", Measured((1.0, 2.0), scattered(2, 0.1))).parameters())


def test_a_rubber_that_was_not_measured_has_no_such_error(tmp_path: Path) -> None:
    result = simulate(sliding(100.0, 0.5, "small", None))
    assert RUBBER_ERROR not in result
    write(result, tmp_path / "a.nc")
    assert RUBBER_ERROR not in scale_table(collect([tmp_path / "a.nc"]), 1)
