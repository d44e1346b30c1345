"""A road of the config of which a profile was measured: what the file is, and what is made of it."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from pydantic import model_validator

from rubfric.config.entries import Entry
from rubfric.config.fitting import in_config
from rubfric.config.place import Place
from rubfric.errors import InvalidInput
from rubfric.rules import HERE, Choice, Integer, Items, Number, Rule

if TYPE_CHECKING:  # heavy
    from rubfric.profile.analysis import Analysis
    from rubfric.road.profile import ProfileRoad

_FORMS = ("mean", "tilt", "bow")
# Of a block on a window, in lengths of the window.
_HEIGHTS = (0.01, 10.0)


@dataclass(frozen=True)
class Text(Rule):
    """A text, such as a heading or units."""

    def check(self, key: str, value: Any) -> str:
        """Return the text."""
        if not isinstance(value, (str, int)) or isinstance(value, bool) or not str(value).strip():
            raise InvalidInput(f"{key} is {value!r}, but must be a text")
        return str(value)

    def _schema(self) -> dict[str, Any]:
        return {"type": "string", "minLength": 1, "maxLength": 200}


class MeasuredRoad(Entry):
    """A road of which a profile was measured; it is read, cleaned and analysed before anything is simulated."""

    profile: Annotated[
        str, Place("File of the measured profile; a relative path counts from the folder of the config that has it.")
    ]
    scales: Annotated[
        int, Integer("Number of sines that are fitted to its spectrum: the scales of the road.", 1, 12)
    ] = 4
    window: Annotated[
        float | None, Number("Length of a window; without, 40 mm or the longest that fits.", "mm", 1e-9, 1e6)
    ] = None
    cutoff: Annotated[
        float | None, Number("Shortest wavelength kept; without, the shortest to be trusted.", "mm", 1e-9, 1e6)
    ] = None
    windows: Annotated[
        int,
        Integer(
            "Number of windows of the profile itself that are slid over in place of the sines where the whole road is "
            "simulated (multiscale direct or auto, which is direct then); its friction is their mean. 0 for the sines.",
            0,
            999,
        ),
    ] = 0
    cutoffs: Annotated[
        tuple[float, ...] | None,
        Items(
            "Longer cutoffs down to which its windows are slid over too, at the pressure figures.total_pressure: which "
            "waves carry friction; without, twice and four times the cutoff, [] for none.",
            Number(unit="mm"),
            least=0,
        ),
    ] = None
    block_height: Annotated[
        float, Number("Height of the block on a window, which is as wide as that.", "mm", 1e-9, 1e6)
    ] = 8.0
    blend: Annotated[float, Number("Share of a window over which its ends are blended.", "", 0.0, 0.5)] = 0.1
    longest_gap: Annotated[float, Number("Gaps up to this length are bridged.", "mm", 0.0, 1e4)] = 5.0
    form: Annotated[str, Choice("What is subtracted: the mean, tilt, or tilt and bow.", _FORMS)] = "tilt"
    ends: Annotated[
        str, Choice("Whether flat ends are calibration plates, which are cut off, or road.", ("plates", "road"))
    ] = "plates"
    unit: Annotated[
        str | None, Text("Unit of distances and heights, or both, as in mm,um, where the file does not say.")
    ] = None
    spacing: Annotated[float | None, Number("Of heights without distances.", "mm", 1e-9, 1e6)] = None
    distance: Annotated[str | None, Text("Heading or number of the distances, where it is not recognised.")] = None
    height: Annotated[str | None, Text("Heading or number of the heights, where it is not recognised.")] = None
    decimal: Annotated[str | None, Choice("Decimal mark, where it is not recognised.", ("point", "comma"))] = None
    separator: Annotated[
        str | None,
        Choice("What separates columns, where it is not recognised.", ("tab", "semicolon", "comma", "pipe", "space")),
    ] = None
    line: Annotated[int | None, Integer("Line of an areal scan; without, the middle one.")] = None
    direction: Annotated[str, Choice("Of the lines of an areal scan.", ("x", "y"))] = "x"

    @classmethod
    def unknown(cls, name: Any) -> str:
        """Return what to say of a key that there is not; of those of a sine, why not."""
        if name in ("amplitude", "wavenumber", "wavelength", "phase"):
            return f"{HERE} has both profile and {name}: a road is a profile, or a list of scales"
        return super().unknown(name)

    @model_validator(mode="after")
    def _bounds(self) -> MeasuredRoad:
        if self.window is not None and self.cutoff is not None and self.cutoff > 0.5 * self.window:
            raise InvalidInput(
                f"{HERE}.cutoff is {self.cutoff:g} mm, but must be at most half of window, {0.5 * self.window:g} mm"
            )
        return self


@dataclass(frozen=True)
class Survey:
    """What a campaign needs of a measured road.

    Attributes
    ----------
    source : str
        The file.
    scales : tuple of (float, float)
        Amplitude, mm, and wavenumber, 1/mm, of each sine, from coarse to fine.
    windows : tuple of ProfileRoad
        Those that are slid over in place of the sines.
    cutoff : float
        Shortest wavelength kept, mm.
    coarser : mapping of float to tuple of ProfileRoad
        The same windows down to longer cutoffs, mm.
    block_height : float
        Of the block on them, mm.
    words : str
        On the profile.
    warnings : tuple of str
    """

    source: str
    scales: tuple[tuple[float, float], ...]
    windows: tuple[ProfileRoad, ...]
    cutoff: float
    coarser: Mapping[float, tuple[ProfileRoad, ...]]
    block_height: float
    words: str
    warnings: tuple[str, ...]


def surveyed(name: str, entry: MeasuredRoad) -> Survey:
    """Return what is made of a measured road; the same data and options are analysed once in a process.

    Parameters
    ----------
    name : str
        Of the road.
    entry : MeasuredRoad

    Raises
    ------
    InvalidInput
        For a file that is missing or cannot be read, or a profile that holds no such windows.
    """
    key = f"roads.{name}"
    try:
        digest = hashlib.sha256(Path(entry.profile).read_bytes()).hexdigest()
    except OSError as error:
        missing = isinstance(error, FileNotFoundError)
        why = "there is no such file" if missing else f"it cannot be read: {error.strerror}"
        raise InvalidInput(
            f"{key}.profile is {entry.profile!r}, but {why}; a relative path counts from the folder of the config that "
            "has it"
        ) from error
    try:
        return _surveyed(name, entry, digest)
    except InvalidInput as error:
        raise InvalidInput(*(f"{key}: {in_config(fault)}" for fault in error.faults)) from error


def analysed(entry: MeasuredRoad) -> Analysis:
    """Return the analysis of a measured road.

    Parameters
    ----------
    entry : MeasuredRoad
    """
    from rubfric.columns.format import Format  # heavy: only where a profile is read
    from rubfric.profile.analysis import analyse
    from rubfric.profile.cleaning import clean
    from rubfric.profile.reading import Options, read

    options = Options(
        tuple(word.strip() for word in (entry.unit or "").split(",") if word.strip()),
        entry.spacing,
        (entry.distance, entry.height),
        entry.line,
        entry.direction,
        Format(entry.separator, entry.decimal),
    )
    cleaned = clean(read(entry.profile, options), entry.longest_gap, _FORMS.index(entry.form), entry.ends == "road")
    return analyse(cleaned, entry.window, entry.cutoff, entry.scales, entry.blend)


@lru_cache(maxsize=16)
def _surveyed(name: str, entry: MeasuredRoad, digest: str) -> Survey:
    """Return what is made of the file of this digest."""
    del digest
    found = analysed(entry)
    if entry.windows > found.windows:
        raise InvalidInput(
            f"windows is {entry.windows}, but the profile has {found.windows} of {found.window:g} mm: take fewer, or "
            "shorter ones with window"
        )
    low, high = (share * found.window for share in _HEIGHTS)
    if entry.windows and not low <= entry.block_height <= high:
        raise InvalidInput(
            f"block_height is {entry.block_height:g} mm, but on windows of {found.window:g} mm must be from {low:g} to "
            f"{high:g} mm"
        )
    numbers = range(1, entry.windows + 1)
    waves = found.sines
    profile = found.cleaned.profile
    kept = f"{found.cleaned.heights.std():.3g} mm rms, wavelengths from {found.cutoff:g} to {found.window:g} mm"
    return Survey(
        entry.profile,
        tuple(zip(waves.amplitudes, waves.wavenumbers, strict=True)),
        tuple(found.road(number) for number in numbers),
        found.cutoff,
        {one: tuple(found.road(number, one) for number in numbers) for one in _coarser(entry, found)},
        entry.block_height,
        f"road {name} is {profile.length:.4g} mm of {entry.profile}: {kept} as {entry.scales} sines",
        tuple(found.warnings()),
    )


def _coarser(entry: MeasuredRoad, found: Analysis) -> list[float]:
    """Return the longer cutoffs of the windows, descending."""
    longest = 0.5 * found.window
    if entry.cutoffs is None:
        return [each for each in (4.0 * found.cutoff, 2.0 * found.cutoff) if each <= longest]
    wrong = [each for each in entry.cutoffs if not found.cutoff <= each <= longest]
    if wrong:
        raise InvalidInput(
            f"cutoffs has {wrong[0]:g} mm, but each must be from cutoff, {found.cutoff:g} mm, to half of window, "
            f"{longest:g} mm"
        )
    return sorted(set(entry.cutoffs) - {found.cutoff}, reverse=True)
