"""The fit of a measured rubber of the config: made once for the same data, options and code."""

from __future__ import annotations

import hashlib
import json
import os
import re
from collections.abc import Mapping
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from typing import Any

from rubfric.config.measured import MeasuredRubber
from rubfric.errors import InvalidInput
from rubfric.files import whole
from rubfric.rubber.fitted import FittedRubber

# What of the package a fit depends on.
_CODE = Path(__file__).resolve().parents[1]
# What this process has fitted, by the digest of its name, data, options and code.
_FITTED: dict[str, FittedRubber] = {}


def fitted_rubber(name: str, entry: MeasuredRubber, kept: str | os.PathLike[str] | None = None) -> FittedRubber:
    """Return a rubber fitted to its measurements; the same data, options and code are fitted once.

    Parameters
    ----------
    name : str
        Of the rubber.
    entry : MeasuredRubber
    kept : path-like, optional
        Folder in which the fit is kept from run to run.

    Raises
    ------
    InvalidInput
        For a file that is missing or cannot be read, or data that do not suffice.
    """
    key = f"rubbers.{name}"
    try:
        content = Path(entry.measurements).read_bytes()
    except OSError as error:
        why = (
            "there is no such file" if isinstance(error, FileNotFoundError) else f"it cannot be read: {error.strerror}"
        )
        raise InvalidInput(
            f"{key}.measurements is {entry.measurements!r}, but {why}; a relative path counts from the folder of the "
            "config that has it"
        ) from error
    options = entry.model_dump(exclude={"measurements"})
    digest = hashlib.sha256(content + json.dumps([name, options], sort_keys=True).encode() + _code()).hexdigest()
    place = Path(kept, f"{name}.json") if kept is not None else None
    known = _read(place, digest) if place else None
    if known is not None:
        return replace(known, source=entry.measurements)
    try:
        found = _fit(digest, name, entry)
    except InvalidInput as error:
        raise InvalidInput(*(f"{key}: {in_config(fault)}" for fault in error.faults)) from error
    if place:
        with whole(place) as part:
            part.write_text(json.dumps({"digest": digest, "rubber": found.parameters()}), encoding="utf-8")
    return replace(found, source=entry.measurements)


def in_config(words: str) -> str:
    """Return words that name options of ``rubfric rubber fit`` with the keys that do the same here."""
    words = words.replace(" in the YAML file of --columns", "").replace("--master", "data: master")
    words = re.sub(r"--(modulus|law) (\w+)", r"\1: \2", words)
    return re.sub(r"--([a-z-]+)", lambda found: found[1].replace("-", "_"), words)


def arguments(name: str, entry: MeasuredRubber) -> tuple[Any, ...]:
    """Return the arguments of ``rubfric.dma.fitted.fitted`` for an entry of the config.

    Parameters
    ----------
    name : str
        Of the rubber.
    entry : MeasuredRubber
    """
    from rubfric.dma.fitted import Bulk, Reading  # heavy: only where something is fitted
    from rubfric.dma.result import Options

    reading = Reading(
        *(entry.columns, entry.units, entry.modulus, entry.data == "master"),
        *(entry.separator, entry.decimal, entry.isotherm),
    )
    options = Options(
        *(entry.reference_temperature, entry.law, entry.vertical, entry.static_modulus),
        *(entry.branches_per_decade, entry.uncertainty, entry.seed),
    )
    return entry.measurements, name, reading, options, Bulk(entry.poissons_ratio, entry.bulk_modulus)


def _fit(digest: str, name: str, entry: MeasuredRubber) -> FittedRubber:
    if digest not in _FITTED:
        from rubfric.dma.fitted import fitted

        found = fitted(*arguments(name, entry))
        _FITTED[digest] = replace(
            found,
            material=replace(found.material, density=entry.density),
            warnings=tuple(map(in_config, found.warnings)),
        )
    return _FITTED[digest]


def _read(place: Path, digest: str) -> FittedRubber | None:
    """Return the fit that is kept in a file; None for another one, or none."""
    try:
        held: Mapping[str, Any] = json.loads(place.read_text(encoding="utf-8"))
        return FittedRubber.from_parameters(held["rubber"]) if held["digest"] == digest else None
    except (OSError, ValueError, LookupError, TypeError):
        return None


@lru_cache(maxsize=1)
def _code() -> bytes:
    """Return the digest of what of the package makes a fit."""
    paths = [*sorted((_CODE / "dma").glob("*.py")), *sorted((_CODE / "rubber").glob("*.py"))]
    return hashlib.sha256(b"".join(path.read_bytes() for path in paths)).digest()
