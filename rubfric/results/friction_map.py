"""Friction over speed and pressure, interpolated between the scenes of a campaign."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator

from rubfric.errors import BrokenResult, InvalidInput
from rubfric.results.scales import AXES, TOTAL
from rubfric.results.selection import pick
from rubfric.results.temperature import rows_at

Array = NDArray[np.float64]

_VARIABLES = ("friction_coefficient", "friction_coefficient_error")


@dataclass(frozen=True)
class FrictionCurve:
    """Friction over speed at one pressure.

    Between the speeds of the campaign it is a monotone piecewise cubic in the logarithm of speed, which adds no peaks
    (Fritsch and Carlson 1980). Below the slowest it falls to zero in proportion to speed, as for any rubber that
    relaxes; a sled needs it there to start. Above the fastest it is constant, which is no prediction.

    Attributes
    ----------
    speeds : numpy.ndarray, shape (speeds,)
        Of the campaign, mm/s, ascending.
    friction, error : numpy.ndarray, shape (speeds,)
        Friction coefficients there and their estimated absolute errors, dimensionless.
    """

    speeds: Array
    friction: Array
    error: Array

    @cached_property
    def _friction(self) -> Callable[[Array], Array]:
        return _through(np.log(self.speeds), self.friction)

    @cached_property
    def _error(self) -> Callable[[Array], Array]:
        return _through(np.log(self.speeds), self.error)

    def __call__(self, speed: Any) -> Array:
        """Return friction coefficients at speeds (mm/s, any shape)."""
        return self._at(speed, self._friction)

    def error_at(self, speed: Any) -> Array:
        """Return the interpolated errors of the friction coefficients at speeds (mm/s, any shape)."""
        return self._at(speed, self._error)

    def _at(self, speed: Any, curve: Callable[[Array], Array]) -> Array:
        slowest, fastest = self.speeds[0], self.speeds[-1]
        inside = curve(np.log(np.clip(speed, slowest, fastest)))
        return np.asarray(inside * np.minimum(np.asarray(speed) / slowest, 1.0))


@dataclass(frozen=True)
class FrictionMap:
    """Friction over speed and pressure.

    Attributes
    ----------
    speeds : numpy.ndarray, shape (speeds,)
        mm/s, ascending.
    pressures : numpy.ndarray, shape (pressures,)
        Nominal, MPa, ascending.
    friction, error : numpy.ndarray, shape (pressures, speeds)
        Friction coefficients and their estimated absolute errors, dimensionless.
    """

    speeds: Array
    pressures: Array
    friction: Array
    error: Array

    @classmethod
    def from_campaign(
        cls, campaign: xr.Dataset, aspect: float, scale: int, temperature: float | None = None
    ) -> FrictionMap:
        """Take the friction of one scale at one height-to-width ratio.

        Speeds and pressures at which nothing was run are left out.

        Parameters
        ----------
        campaign : xarray.Dataset
            As gathered by ``rubfric.results.campaign.collect``.
        aspect : float
            Height over width of the blocks.
        scale : int
            Of the road, 1 being the coarsest.
        temperature : float, optional
            degC; of several one has to be chosen.

        Raises
        ------
        InvalidInput
            Where the campaign lacks the ratio, the scale or the temperature, or has a gap.
        BrokenResult
            For a campaign without friction or its errors.
        """
        chosen: dict[str, float] = {"aspect": aspect, "scale": scale}
        chosen |= {} if temperature is None else {"temperature": temperature}
        return cls._whole(*(pick(campaign, name, **chosen) for name in _VARIABLES))

    @classmethod
    def from_totals(cls, totals: pd.DataFrame) -> FrictionMap:
        """Take the friction of the whole road, with its whole error.

        Parameters
        ----------
        totals : pandas.DataFrame
            As from ``rubfric.results.totals.total_table``, of one temperature.

        Raises
        ------
        InvalidInput
            Where the table has a gap, or several temperatures.
        BrokenResult
            For a table without the totals or their errors.
        """
        totals = rows_at(totals)
        lacking = [name for name in (*AXES, *TOTAL) if name not in totals]
        if lacking:
            raise BrokenResult(f"the table of totals lacks {', '.join(lacking)}: make it again")
        field = totals.set_index(list(AXES))[list(TOTAL)].to_xarray()
        field = field.rename(dict(zip(AXES, ("velocity", "pressure"), strict=True)))
        return cls._whole(*(field[name] for name in TOTAL))

    @classmethod
    def _whole(cls, friction: xr.DataArray, error: xr.DataArray) -> FrictionMap:
        friction, error = (field.transpose("pressure", "velocity") for field in (friction, error))
        friction = friction.dropna("pressure", how="all").dropna("velocity", how="all")
        if friction.size == 0 or not bool(np.isfinite(friction.values).all()):
            raise InvalidInput("the campaign has no friction at some of its speeds and pressures: run it whole")
        error = error.sel(pressure=friction["pressure"], velocity=friction["velocity"])
        return cls(friction["velocity"].values, friction["pressure"].values, friction.values, error.values)

    def at(self, pressure: float) -> FrictionCurve:
        """Return friction over speed at a pressure (MPa) of the campaign or in between; InvalidInput for any other."""
        if not self.holds(pressure):
            raise InvalidInput(
                f"pressure is {pressure:g} MPa, but must lie within those simulated, "
                f"{self.pressures[0]:g} to {self.pressures[-1]:g} MPa"
            )
        place = np.log(np.clip(pressure, self.pressures[0], self.pressures[-1]))
        logs = np.log(self.pressures)
        return FrictionCurve(self.speeds, _through(logs, self.friction)(place), _through(logs, self.error)(place))

    def holds(self, pressure: float) -> bool:
        """Return whether a pressure (MPa) lies within those of the campaign."""
        return bool(self.pressures[0] * (1.0 - 1e-9) <= pressure <= self.pressures[-1] * (1.0 + 1e-9))


def _through(places: Array, values: Array) -> Callable[[Array], Array]:
    """Return a monotone piecewise cubic through points along the first axis; a constant through one."""
    if places.size == 1:
        return lambda place: np.broadcast_to(values[0], np.shape(place) + values.shape[1:])
    return PchipInterpolator(places, values, axis=0)
