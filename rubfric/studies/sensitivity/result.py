"""What sensitivities come to: a table, sentences, and sums that vanish."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import pandas as pd

from rubfric.checks import written
from rubfric.scene.scene import ALL, Scene

# Exact sums of sensitivities, by the names that a parameter begins with and their signs, and why they vanish.
_IDENTITIES: Mapping[str, tuple[str, Mapping[str, float]]] = {
    "E + p": ("all moduli and the pressure together", {"E": 1.0, "p": 1.0}),
    "sum of tau_i - v": ("all relaxation times longer and the speed lower", {"tau_": 1.0, "v": -1.0}),
    "sum of a_i + lambda + v": ("all lengths and the speed together", {"a": 1.0, "a_": 1.0, "lambda": 1.0, "v": 1.0}),
}


@dataclass(frozen=True)
class Identity:
    """A sum of sensitivities that is zero, since friction depends on numbers without dimension only.

    Attributes
    ----------
    sum : str
        The sum, in symbols.
    why : str
        What may change without a change of friction.
    residual, error : float
        What the sum comes to, and what the errors of its parts allow.
    """

    sum: str
    why: str
    residual: float
    error: float


@dataclass(frozen=True, repr=False)
class Sensitivities:
    """By how much each parameter moves friction.

    Attributes
    ----------
    scene : Scene
    friction, friction_error : float
        Dimensionless.
    kinematics : {"small", "finite"}
    change : float
        By how much a parameter is changed, relative.
    table : pandas.DataFrame
        A row for each parameter, the largest change of friction first: ``parameter``, ``words``, ``unit``, ``value``,
        ``sensitivity`` (d ln mu / d ln x), ``sensitivity_error``, ``changed_to``, ``friction_change`` (relative) and
        ``friction_change_error``, and a ``note`` where it could not be found.
    identities : tuple of Identity
    sobol : pandas.DataFrame or None
        First and total order with 95 % intervals, where asked for.
    notes : tuple of str
    """

    scene: Scene
    friction: float
    friction_error: float
    kinematics: str
    change: float
    table: pd.DataFrame
    identities: tuple[Identity, ...]
    sobol: pd.DataFrame | None = None
    notes: tuple[str, ...] = field(default=())

    @property
    def title(self) -> str:
        """Road, speed, pressure and friction, in words."""
        scene = self.scene
        road = "whole road" if scene.scale == ALL else f"scale {scene.scale}"
        warm = "" if scene.temperature is None else f", {written(scene.temperature)} °C"
        where = f"{road}, {written(scene.velocity)} mm/s, {written(scene.pressure)} MPa{warm}"
        return f"{where}: friction {self.friction:.4g} ± {self.friction_error:.1g}"

    def __repr__(self) -> str:
        clear = self.table[self.table["friction_change"].abs() > self.table["friction_change_error"]]
        most = ", ".join(
            f"{row['parameter']} {signed(row['friction_change'], row['friction_change_error'])}"
            for row in clear.head(3).to_dict("records")
        )
        return f"<Sensitivities of {self.scene.name}: friction {self.friction:.4g}; {self.change:.0%} more: {most}>"

    def sentences(self) -> list[str]:
        """Return what a change of each parameter does, in words; what does nothing that can be told, in one."""
        at = f"at {written(self.scene.velocity)} mm/s and {written(self.scene.pressure)} MPa"
        found, unclear, bound = [], [], 0.0
        for row in self.table[self.table["note"] == ""].to_dict("records"):
            size, error = abs(row["friction_change"]), row["friction_change_error"]
            if size <= error:
                unclear.append(row["parameter"])
                bound = max(bound, size + error)
                continue
            verb = "raises" if row["friction_change"] > 0.0 else "lowers"
            found.append(f"{self._changed(row)} {verb} friction {at} by {with_error(size, error)} %")
        if unclear:
            found.append(
                f"no effect that can be told from its error, at most {100.0 * bound:.1g} %: {', '.join(unclear)}"
            )
        return found

    def _changed(self, row: Mapping[str, Any]) -> str:
        if row["parameter"] in ("nu", "T"):
            unit = f" {row['unit']}" if row["unit"] else ""
            return f"{row['parameter']} of {row['changed_to']:.4g} instead of {row['value']:.4g}{unit}"
        return f"a {100.0 * self.change:g} % larger {row['parameter']}"


def identities(table: pd.DataFrame) -> tuple[Identity, ...]:
    """Return the exact sums of the sensitivities to all parameters of a scene, where no part is missing.

    They test steps and solver. Meshes move along, so that they hold on a coarse mesh as on a fine one.

    Parameters
    ----------
    table : pandas.DataFrame
        As of ``Sensitivities``.
    """
    answer = []
    kinds = table["parameter"].str.replace(r"(?<=_)\d+$", "", regex=True)
    for name, (why, parts) in _IDENTITIES.items():
        signs = kinds.map(parts)
        rows = table[signs.notna()]
        if set(parts) - {"a", "a_"} <= set(kinds) and not rows["sensitivity"].isna().any():
            residual = float((signs.dropna() * rows["sensitivity"]).sum())
            answer.append(Identity(name, why, residual, math.hypot(*rows["sensitivity_error"])))
    return tuple(answer)


def with_error(value: float, error: float) -> str:
    """Return a share and its error in per cent, without the sign of per cent: 3.1 ± 0.2.

    Parameters
    ----------
    value, error : float
    """
    digits = _digits(error)
    return f"{100.0 * value:.{digits}f} ± {100.0 * error:.{digits}f}"


def signed(change: float, error: float) -> str:
    """Return a change and its error in per cent, with the sign of either: +3.1 ± 0.2 %.

    Parameters
    ----------
    change, error : float
        Relative.
    """
    return f"{'-' if change < 0.0 else '+'}{with_error(abs(change), error)} %"


def _digits(error: float) -> int:
    """Return the decimals in which an error has one significant digit, or two where it begins with 1."""
    percent = 100.0 * error
    if percent <= 0.0 or not math.isfinite(percent):
        return 2
    exponent = math.floor(math.log10(percent))
    return min(max(0, -exponent + (1 if percent / 10.0**exponent < 2.0 else 0)), 6)
