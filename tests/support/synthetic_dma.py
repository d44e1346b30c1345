"""Measured moduli of rubbers that are known: Prony series at several temperatures, with noise."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rubfric.dma.measurements import Measurements, ordered

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Truth:
    """A rubber, MPa and s, at its reference temperature, degC, with its WLF constants."""

    static: float
    moduli: Array
    times: Array
    c1: float = 8.86
    c2: float = 101.6
    reference: float = 20.0
    energy: float | None = None

    def log_factor(self, temperatures: Array) -> Array:
        change = temperatures - self.reference
        if self.energy is not None:
            inverse = 1.0 / (temperatures + 273.15) - 1.0 / (self.reference + 273.15)
            return self.energy / 8.314462618e-3 * inverse / np.log(10.0)
        return -self.c1 * change / (self.c2 + change)

    def at(self, temperature: Array, frequency: Array) -> tuple[Array, Array]:
        """Return storage and loss modulus for frequencies in rad/s."""
        x = np.multiply.outer(frequency * 10.0 ** self.log_factor(temperature), self.times)
        part = self.moduli / (1.0 + x**2)
        return self.static + (part * x**2).sum(axis=-1), (part * x).sum(axis=-1)


def measured(
    truth: Truth, temperatures: Array, hertz: Array, noise: float, rng: np.random.Generator
) -> tuple[Array, Array, Array, Array]:
    """Return temperature, frequency in rad/s, storage and loss modulus of every point."""
    temperature = np.repeat(temperatures, len(hertz))
    frequency = np.tile(2.0 * np.pi * hertz, len(temperatures))
    storage, loss = truth.at(temperature, frequency)
    scatter = 1.0 + noise * rng.standard_normal((2, len(frequency)))
    return temperature, frequency, storage * scatter[0], loss * scatter[1]


def measurements(
    truth: Truth, temperatures: Array, hertz: Array, noise: float, rng: np.random.Generator, kind: str = "E"
) -> Measurements:
    temperature, frequency, storage, loss = measured(truth, temperatures, hertz, noise, rng)
    return ordered("synthetic", kind, frequency, temperature, storage, loss)


def table_1(c1: float = 6.838, c2: float = 131.6) -> Truth:
    """The paper's rubber, with the WLF constants of a rubber whose glass transition is at -60 degC."""
    shares = np.array([0.000592717, 0.002536278, 0.024459921, 0.17432432, 0.387971288, 0.408678482])
    times = np.array([0.01134034, 0.0002628, 1.316e-05, 1.295e-06, 7.708e-08, 4.2e-10])
    return Truth(4.17, shares * 4.17 / (1.0 - shares.sum()), times, c1, c2)


def drawn(seed: int, arrhenius: bool = False) -> tuple[Truth, Measurements, float]:
    """Return a random rubber, what was measured of it, and the noise: temperatures are those that overlap."""
    rng = np.random.default_rng(seed)
    branches, noise, count = int(rng.integers(5, 21)), float(rng.choice([0.005, 0.01, 0.03])), int(rng.integers(6, 16))
    decades = float(rng.uniform(1.0, 4.0))
    times = 10.0 ** np.sort(rng.uniform(-9.0, 1.0, branches))
    moduli = 10.0 ** (np.linspace(2.5, 0.0, branches) + rng.normal(0.0, 0.2, branches))
    c1, c2 = float(rng.uniform(5.0, 14.0)), float(rng.uniform(60.0, 140.0))
    energy = float(rng.uniform(80.0, 250.0)) if arrhenius else None
    truth = Truth(2.0, moduli, times, c1, c2, 20.0, energy)
    whole = min(0.75 * decades * (count - 1), 12.0)
    logs = np.linspace(0.6 * whole, -0.4 * whole, count)
    if energy is not None:
        temperatures = 1.0 / (1.0 / 293.15 + logs * np.log(10.0) * 8.314462618e-3 / energy) - 273.15
    else:
        logs = logs[np.abs(logs) < 0.7 * c1]
        temperatures = 20.0 - c2 * logs / (c1 + logs)
    hertz = np.geomspace(10.0 ** (1.0 - decades / 2.0), 10.0 ** (1.0 + decades / 2.0), int(3 + 3 * decades))
    return truth, measurements(truth, np.sort(temperatures), hertz, noise, rng), noise
