"""The files that a config's rig depends on, checked before any job starts."""

from __future__ import annotations

import os

from rubfric.config.rig import RigChoice
from rubfric.errors import InvalidInput
from rubfric.rig.settings import read_settings


def rig_files(rig: RigChoice) -> list[str]:
    """Return the files of measured runs, the one that names their columns, and that of the unloaded pull.

    Raises
    ------
    InvalidInput
        For a missing file, a wrong entry in the file on columns, or one without the area of the rubber.
    """
    if not rig.data:
        return []
    named = {f"rig.data[{place}]": path for place, path in enumerate(rig.data)}
    if rig.columns is None:
        raise InvalidInput(
            "rig.columns is None, but must be the path of a YAML file that gives the nominal area of the rubber, since "
            "rig.data names files"
        )
    _check({**named, "rig.columns": rig.columns})
    settings = read_settings(rig.columns)
    if settings.area <= 0.0:
        raise InvalidInput(f"{rig.columns} lacks the key 'area', the nominal area of the rubber, mm²")
    pull = settings.bearing.file
    _check({f"bearing.file in {rig.columns}": pull} if pull else {})
    return [*rig.data, rig.columns, *([pull] if pull else [])]


def _check(named: dict[str, str]) -> None:
    for key, path in named.items():
        if not os.path.isfile(path):
            raise InvalidInput(f"{key} is {path!r}, but there is no such file")
