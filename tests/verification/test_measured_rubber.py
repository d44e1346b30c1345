"""Friction of a rubber that was fitted to measured moduli, against that of the rubber which was measured."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from synthetic_dma import drawn

from rubfric import Material, Scene, SineScale, load, simulate
from rubfric.dma.bootstrap import bootstrap
from rubfric.dma.entry import rubber
from rubfric.dma.fit import fit
from rubfric.dma.fitted import assemble
from rubfric.dma.result import Options
from rubfric.results.selection import RUBBER_ERROR

CONFIG = Path(__file__).resolve().parents[2] / "config" / "config.yaml"
RUBBERS, SAMPLES = 36, 20


@pytest.mark.thorough
def test_stated_error_covers_what_the_fit_misses_for_95_percent_of_random_rubbers() -> None:
    numerics = load(CONFIG).presets["draft"]
    missed, numerical, data = [], [], []
    for seed in range(RUBBERS):
        truth, measured, _ = drawn(seed)
        found = fit(measured, Options(20.0, "wlf", samples=SAMPLES))
        fitted = assemble(found, rubber(found, "fitted"), bootstrap(found))
        total = truth.static + truth.moduli.sum()
        shares = tuple(truth.moduli / total)
        true = Material("true", truth.static, 0.49, shares, tuple(truth.times), "long_term", "proportional")
        rng, (low, high) = np.random.default_rng(seed), fitted.measured.window
        for _ in range(2):
            frequency = low * (high / low) ** rng.uniform()
            road = SineScale(*((0.015, 35.0) if rng.uniform() < 0.5 else (0.002, 300.0)))
            speed, pressure = frequency / road.wavenumber, 10.0 ** rng.uniform(-0.7, 1.0)
            scene = Scene(
                1, road, speed, pressure, 0.75, fitted.material, "stress", numerics, "small", measured=fitted.measured
            )
            result, right = simulate(scene), simulate(replace(scene, material=true, measured=None))
            wanted = float(right["friction_coefficient"])
            missed.append(abs(float(result["friction_coefficient"]) - wanted) / wanted)
            numerical.append(float(result["friction_coefficient_error"]) / wanted)
            data.append(float(result[RUBBER_ERROR]) / wanted)
    deviation, mesh, own = np.array(missed), np.array(numerical), np.array(data)
    assert np.mean(deviation <= mesh + own) >= 0.95
    # Both scenes have the same mesh errors, nearly: what is left is the rubber's, and its error is not far too wide.
    assert np.mean(deviation <= own) >= 0.9
    assert np.median(own) < 8.0 * np.median(deviation)
