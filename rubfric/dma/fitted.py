"""From a file of measured moduli to a rubber with its shift factors, its window, and bootstrap samples."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass

from rubfric.dma.bootstrap import Bands, bootstrap
from rubfric.dma.entry import POISSONS_RATIO, as_shear, rounded, rubber, series
from rubfric.dma.fit import fit
from rubfric.dma.measurements import ISOTHERM, read
from rubfric.dma.result import Fit, Options
from rubfric.rubber.fitted import FittedRubber, Measured, Sample
from rubfric.rubber.material import Material


@dataclass(frozen=True)
class Bulk:
    """What a measurement of E* or G* alone does not show of a rubber.

    Attributes
    ----------
    poissons_ratio : float
        Constant, so that the bulk modulus relaxes in proportion.
    modulus : float, optional
        Constant bulk modulus, MPa, instead.
    """

    poissons_ratio: float = POISSONS_RATIO
    modulus: float | None = None


@dataclass(frozen=True)
class Reading:
    """How a file is read: the arguments of ``rubfric.dma.measurements.read``."""

    columns: Mapping[str, str] | None = None
    units: Mapping[str, str] | None = None
    modulus: str | None = None
    master: bool = False
    separator: str | None = None
    decimal: str | None = None
    isotherm: float = ISOTHERM


def fit_file(path: str, name: str, reading: Reading, options: Options, bulk: Bulk) -> tuple[Fit, Material]:
    """Fit a rubber to the moduli in a file.

    Parameters
    ----------
    path : str
    name : str
        Of the rubber.
    reading : Reading
    options : Options
        Of the fit; the static modulus is of the measured kind, E or G.
    bulk : Bulk

    Raises
    ------
    InvalidInput
        For a file that cannot be read, or data that do not suffice.
    FileNotFoundError
        For a missing file.
    """
    data = read(path, **{each.name: getattr(reading, each.name) for each in dataclasses.fields(reading)})
    if bulk.modulus is not None:
        static = options.static
        if static is not None and data.kind == "E":
            options = dataclasses.replace(options, static=3.0 * bulk.modulus * static / (9.0 * bulk.modulus - static))
        data = as_shear(data, bulk.modulus)
    found = fit(data, options)
    return found, rubber(found, name, bulk.poissons_ratio, bulk.modulus)


def assemble(found: Fit, material: Material, bands: Bands | None = None) -> FittedRubber:
    """Return a fitted rubber with what the measurement leaves open.

    Parameters
    ----------
    found : Fit
    material : Material
        That of the fit.
    bands : Bands, optional
        Fits of resampled data.
    """
    shift, low_high = found.shift(), found.window
    fits = bands.samples if bands else ()
    shifts = tuple(own for each in fits if (own := each.shift()) is not None)
    return FittedRubber(
        material,
        shift,
        Measured((rounded(low_high[0]), rounded(low_high[1])), tuple(_sample(each, material) for each in fits)),
        shifts,
        (*found.warnings, *found.data.notes),
    )


def fitted(path: str, name: str, reading: Reading, options: Options, bulk: Bulk) -> FittedRubber:
    """Fit a rubber to the moduli in a file, and as often to resampled ones as the options ask for.

    Parameters
    ----------
    path, name, reading, options, bulk
        As of ``fit_file``.

    Raises
    ------
    InvalidInput
        For a file that cannot be read, or data that do not suffice.
    FileNotFoundError
        For a missing file.
    """
    found, material = fit_file(path, name, reading, options, bulk)
    return assemble(found, material, bootstrap(found) if options.samples else None)


def _sample(found: Fit, material: Material) -> Sample:
    static, moduli, times = series(found)
    shear = 0.5 / (1.0 + material.poissons_ratio) if found.data.kind == "E" else 1.0
    return Sample(static, moduli, times).shifted(1.0, shear)
