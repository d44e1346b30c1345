"""What the data of a measured rubber leave open of friction: their scatter, and frequencies that were not measured.

The scatter: friction with each of the fit's bootstrap samples, over that with the fit, in small strain on the
closed-form layer. The frequencies: the friction of a solved scene is the sum over its harmonics of the power that the
contact puts into the surface, with positions x(X), y(X) of the surface, tractions p_x, p_y and k_n = 2 pi n / period,

    mu_n = 2 Re(i k_n (p_y,n* y_n + p_x,n* x_n)) / P;

of what comes from harmonics beyond the measured window, all is taken to be uncertain.
"""

from __future__ import annotations

import numpy as np

from rubfric.arrays import Real
from rubfric.mechanics.steady.solution import SteadySolution
from rubfric.mechanics.theory.layer_contact import Layer, sample_friction
from rubfric.scene.scene import Scene

# Standard errors in a band of 95 %.
_BAND = 1.96
# Share of friction beyond the measured window that is worth a word.
_WORTH = 0.01


def harmonics(solution: SteadySolution) -> Real:
    """Return what each harmonic n k v adds to the friction coefficient, n from 1; shape (columns // 2,)."""
    block, contact, road = solution.block, solution.contact, solution.scene.road
    position = solution.surface_position
    works = [(contact.pressure, road.height(position) + contact.gap)]
    if solution.decision.kinematics == "finite":
        works.append((-contact.pressure * road.slope(position), position - block.column_positions))
    power = np.zeros(block.columns // 2)
    for traction, place in works:
        pair = np.fft.rfft(traction)[1:].conj() * np.fft.rfft(place)[1:] / block.columns**2
        power += 2.0 * block.wavenumbers[1:] * (1j * pair).real
    return power / solution.scene.pressure


def _frequencies(solution: SteadySolution) -> Real:
    """Return the angular frequencies n k v of all harmonics of the mesh, rad/s."""
    return solution.block.wavenumbers[1:] * solution.scene.velocity


def beyond(solution: SteadySolution) -> tuple[float, float]:
    """Return the shares of friction that come from below and from above the measured window; 0 without one."""
    measured = solution.scene.measured
    if measured is None:
        return 0.0, 0.0
    parts, (low, high) = np.abs(harmonics(solution)), measured.window
    total = float(parts.sum())
    if total <= 0.0:
        return 0.0, 0.0
    frequencies = _frequencies(solution)
    return float(parts[frequencies < low].sum()) / total, float(parts[frequencies > high].sum()) / total


def spread(scene: Scene) -> float:
    """Return the half-width of the 95 % band that the scatter of a rubber's data leaves of friction, relative.

    Raises
    ------
    NotConverged
        As ``solve_contact`` does.
    """
    samples = scene.measured.samples if scene.measured else ()
    if not samples:
        return 0.0
    layer = Layer(scene.material, scene.velocity, scene.height, scene.plane)
    rubbers = [each.material(scene.material) for each in samples]
    fitted, *others = sample_friction(layer, rubbers, scene.road, scene.pressure)
    if fitted <= 0.0:
        return 0.0
    return _BAND * float(np.sqrt(np.mean((np.array(others) / fitted - 1.0) ** 2)))


def beyond_warning(solution: SteadySolution) -> list[str]:
    """Return a warning where friction comes from frequencies at which the rubber was not measured."""
    measured = solution.scene.measured
    if measured is None:
        return []
    below, above = beyond(solution)
    low, high = measured.window
    lowest = float(_frequencies(solution)[0])
    found = []
    if below > _WORTH:
        found.append(f"{below:.0%} of friction comes from below {low:.3g} rad/s (the road excites {lowest:.3g})")
    if above > _WORTH:
        found.append(
            f"{above:.0%} of friction comes from above {high:.3g} rad/s (the road excites {lowest:.3g} and more)"
        )
    if not found:
        return []
    return [
        f"{' and '.join(found)}, where the rubber was not measured: that is an extrapolation of the fit, and the error "
        "from the rubber's data holds all of it; measure warmer for slow, colder for fast sliding."
    ]
