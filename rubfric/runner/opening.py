"""What a run says first: what it understood of the config, and how long it will take."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from rubfric.config.campaign import Campaign
from rubfric.config.pairs import which
from rubfric.config.references import spread
from rubfric.config.temperature import rubber_at
from rubfric.results.limits import MOST
from rubfric.rubber.material import Material
from rubfric.scene.scene import Scene

# CPU time of one job, s, as docs/performance.md has it for two cores of an AMD EPYC: mean of the paper's 224 scenes in
# finite strain at 1 %, of its four marches, and of 42 scenes of the whole road, reduced to 1 %. Small strain and other
# accuracies by the factors measured there.
_SCENE, _WHOLE, _MARCH, _TABLE, _FIGURE, _OTHER = 0.56, 10.0, 17.0, 0.5, 0.9, 1.0
# The fit of a rubber with 200 bootstrap samples, and the reading of a road, each with its page.
_FIT, _ROAD = 5.0, 3.0
_SMALL, _STEPS = 0.05, 64 * 64 * 12
# Temperatures of which the moduli are named.
_MOST_TEMPERATURES = 5
# Accuracy, and the time that it takes over that of 1 %.
_ACCURACIES, _FACTORS = (0.002, 0.01, 0.05), (4.8, 1.0, 0.44)


@dataclass(frozen=True)
class Costs:
    """CPU time that one job of each rule takes, s, as measured before; that of a scene by its weight."""

    by_rule: Mapping[str, float]

    @classmethod
    def of(cls, campaign: Campaign) -> Costs:
        """Return the costs of a campaign's jobs."""
        scene = _weight(campaign.scene(1, campaign.velocities[0], campaign.pressures[0]))
        whole = next(iter(campaign.whole_scenes().values()), None)
        march = campaign.procedure()
        steps = march["columns"] * march["steps_per_wavelength"] * march["wavelengths"] / _STEPS
        # A reading's batch holds the scenes of one scale and speed.
        one = campaign.at(campaign.figures.temperature)
        reading = len(one.scenes()) / (len(campaign.scales) * len(campaign.velocities))
        draft = campaign.presets[campaign.claims.preset].accuracy if campaign.claims else 0.05
        return cls(
            {
                "scene": _SCENE * scene,
                "whole_scene": _WHOLE * _weight(whole) if whole else 0.0,
                "march": _MARCH * steps * (_SMALL if campaign.kinematics == "small" else 1.0),
                "rubber_fit": _FIT,
                "road_read": _ROAD,
                "refined_curve": _added(campaign, _SCENE * scene, _WHOLE * _weight(whole) if whole else 0.0),
                "reading": _SCENE * reading * _factor(draft) * 0.3,
            }
        )

    def job(self, rule: str, kind: str) -> float:
        """Return the time of one job of a rule that makes a ``table``, a ``figure`` or something else, s.

        Parameters
        ----------
        rule : str
        kind : str
            Of what it makes, for rules whose own time was not measured.
        """
        return self.by_rule.get(rule) or {"table": _TABLE, "figure": _FIGURE}.get(kind, _OTHER)


def _added(campaign: Campaign, scene: float, whole: float) -> float:
    """Return the mean time of adding speeds to a curve, s, given that of a scene, and of one of the whole road."""
    scales = len(campaign.scales)
    return 0.5 * MOST * scene * 2.0 * scales / (scales + 1) + 0.25 * MOST * whole * len(campaign.whole_roads) / (
        scales + 1
    )


def _weight(scene: Scene) -> float:
    """Return the cost of a scene over that of finite strain at 1 %."""
    return _factor(scene.numerics.accuracy) * (_SMALL if scene.kinematics == "small" else 1.0)


def _factor(accuracy: float) -> float:
    """Return the time that an accuracy takes over that of 1 %, from log to log."""
    logs = [math.log(value) for value in _ACCURACIES], [math.log(value) for value in _FACTORS]
    return math.exp(float(np.interp(math.log(accuracy), *logs)))


def understood(campaign: Campaign, own: bool) -> list[str]:
    """Return what is understood of a config, a line each: rubber, road, frequencies, scenes, and what is doubtful.

    Parameters
    ----------
    campaign : Campaign
    own : bool
        Whether the config has a rubber, road or grid of its own.
    """
    extras = ("aspect_study", "transient", "rig", "claims")
    off = [name for name in extras if getattr(campaign, name) is None]
    others = [name for name in extras if name not in off]
    grid = f"the grid and {', '.join(others)}" if others else "the grid only"
    without = f", without {', '.join(off)} of the paper's: name them in the config to run them" if off else ""
    lines = [
        campaign.words().removesuffix("."),
        *([f"a campaign of your own, {grid}{without}"] if own else []),
        *_scales(campaign),
        *_fit(campaign),
        *_survey(campaign),
        *_scans(campaign),
        *_moduli(campaign),
        _scenes(campaign),
        *_refinement(campaign),
        *_others(campaign),
    ]
    return [*lines, *(f"UNLIKELY: {sentence}" for sentence in campaign.unlikely())]


def _others(campaign: Campaign) -> list[str]:
    """Say which rubbers and roads are compared, what is made of the first alone, and what is run for the others."""
    if not campaign.others:
        return []
    scenes = sum(len(one.scenes()) for one in campaign.others)
    whole = sum(len(one.whole_scenes()) for one in campaign.others)
    fitted = {one.material.name: one for one in campaign.others if one.material.name != campaign.material.name}
    surveyed = {one.road_name: one for one in campaign.others if one.road_name != campaign.road_name}
    parts = [f"{scenes} scenes", *([f"{whole} of the whole road"] if whole else [])]
    return [
        f"{which(campaign)}: all tables and figures but the comparison are of it; name another first to draw its own",
        *(line for one in fitted.values() for line in _fit(one)),
        *(line for one in surveyed.values() for line in _survey(one)),
        f"{_many(len(campaign.others), 'other pair')}: {', '.join(parts)}",
    ]


def _scales(campaign: Campaign) -> list[str]:
    return [
        f"scale {number}: wavelength {scale.wavelength:.4g} mm, amplitude {scale.amplitude:.4g} mm, "
        f"steepest slope {scale.steepest_slope:.3g}"
        for number, scale in enumerate(campaign.road, 1)
    ]


def _scans(campaign: Campaign) -> list[str]:
    """Say which scans are areal roads."""
    lines = []
    for name, scan in campaign.areal_scans().items():
        about = campaign.areal_roads[name].road(name).parameters()
        heights = f"{about['points']} x {about['lines']} heights, {about['missing']} of them missing and filled"
        lines.append(f"areal road {name} is {scan['path']}: {heights}")
    return lines


def _survey(campaign: Campaign) -> list[str]:
    """Say what a measured road was made into."""
    survey = campaign.survey
    if survey is None:
        return []
    windows = len(campaign.whole_roads) if survey.windows else 0
    slid = f", and itself over {windows} window{'s' if windows > 1 else ''}" if windows else ""
    return [survey.words + slid, *(f"the profile of {campaign.road_name}: {one}" for one in survey.warnings)]


def _fit(campaign: Campaign) -> list[str]:
    """Say what a measured rubber was fitted to, and whether the road excites it beyond what was measured."""
    fitted = campaign.fitted
    if fitted is None:
        return []
    slow, fast = _excited(campaign)
    beyond = []
    for one in campaign.temperatures or (None,):
        low, high = fitted.at(one)[1].window
        where = [f"from {slow:.3g} rad/s up"] * (slow < low) + [f"up to {fast:.3g} rad/s"] * (fast > high)
        if where:
            at = "" if one is None else f" at {one:g} degC, measured from {low:.3g} to {high:.3g} rad/s as from there"
            beyond.append(f"the road excites it {' and '.join(where)}{at}, beyond that: such scenes carry a warning")
    return [
        "; ".join([fitted.words, *beyond]),
        *(f"the fit of {fitted.material.name}: {one}" for one in fitted.warnings),
    ]


def _excited(campaign: Campaign) -> tuple[float, float]:
    """Return the lowest and the highest angular frequency k v of the campaign, rad/s."""
    numbers = [scale.wavenumber for scale in campaign.road]
    return min(numbers) * campaign.velocities[0], max(numbers) * campaign.velocities[-1]


def _moduli(campaign: Campaign) -> list[str]:
    low, high = _excited(campaign)
    excited = f"the road excites the rubber at {low:.3g} to {high:.3g} rad/s"

    def found(material: Material) -> str:
        modulus = material.plane_modulus(np.geomspace(low, high, 64), "stress")
        loss = modulus.imag / modulus.real
        return (
            f"E' is {modulus.real.min():.3g} to {modulus.real.max():.3g} MPa and the loss factor {loss.min():.2g} to "
            f"{loss.max():.2g}"
        )

    if campaign.shift is None or not campaign.temperatures:
        return [f"{excited}, where {found(campaign.material)}"]
    lines = []
    for one in spread(campaign.temperatures, _MOST_TEMPERATURES):
        factor, rubber = campaign.shift.log_factor(one), rubber_at(campaign.material, campaign.shift, one)
        lines.append(f"at {one:g} degC (a_T = {10.0**factor:.3g}) {found(rubber)}")
    return [excited, *lines]


def _scenes(campaign: Campaign) -> str:
    scales, speeds, loads = len(campaign.road), len(campaign.velocities), len(campaign.pressures)
    temperatures = len(campaign.temperatures)
    grid, total = scales * speeds * loads * max(temperatures, 1), len(campaign.scenes())
    warm = f" at {_many(temperatures, 'temperature')}" if temperatures else ""
    parts = [f"{grid} scenes: {_many(scales, 'scale')} at {_many(speeds, 'speed')} and {_many(loads, 'load')}{warm}"]
    parts += [f"{total - grid} more of the aspect study"] if total > grid else []
    parts += [f"{whole} of the whole road"] if (whole := len(campaign.whole_scenes())) else []
    return ", ".join(parts)


def _refinement(campaign: Campaign) -> list[str]:
    """Say what adding speeds to curves of friction may cost."""
    if campaign.refine is None:
        return []
    loads, scales = len(campaign.pressures) * max(len(campaign.temperatures), 1), len(campaign.scales)
    roads = len(campaign.whole_roads)
    curves, whole = loads * (scales + 1), f" and {MOST * loads * roads} of the whole road" if roads else ""
    return [
        f"grid.refine {campaign.refine:g} adds {MOST} speeds at most to each of {_many(curves, 'curve')} of friction: "
        f"{2 * MOST * loads * scales} scenes{whole} more at most, and half as many or fewer as a rule"
    ]


def _many(number: int, what: str) -> str:
    return f"{number} {what}{'s' if number != 1 else ''}"
