"""Tables, figures and pages that an earlier config made and this one does not, which would stay beside the new."""

from __future__ import annotations

import base64
import binascii
import json
import os
from collections.abc import Collection, Iterator, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

from rubfric.checksums import remove_signature

# Time between the end of a job by Snakemake's record and the age of its files, at most, s.
_SLACK = 2.0


def remove_leftovers(records: str | os.PathLike[str], results: str, wanted: Mapping[str, Collection[str]]) -> list[str]:
    """Remove what the workflow made for an earlier config; return in a line each what was removed and what was left.

    Only files that Snakemake recorded as made by one of these rules are removed, and of them none that was changed
    after: it is named instead.

    Parameters
    ----------
    records : path-like
        Where Snakemake keeps its records.
    results : str
        Folder of the results.
    wanted : mapping
        What the present config makes, by rule: names without the prefix of a module.
    """
    known = {os.path.normpath(path) for paths in wanted.values() for path in paths}
    removed, changed = [], []
    for path, record in _made(Path(records), os.path.normpath(results)):
        rule = str(record.get("rule", ""))
        if os.path.normpath(path) in known or not any(rule == name or rule.endswith(f"_{name}") for name in wanted):
            continue
        with suppress(OSError):  # gone already, or not ours to remove
            if os.stat(path).st_mtime > float(record.get("endtime") or 0.0) + _SLACK:
                changed.append(path)
            else:
                os.remove(path)
                remove_signature(path)
                removed.append(path)
    lines = (
        [f"removed, since an earlier config made them and this one does not: {', '.join(removed)}"] if removed else []
    )
    if changed:
        lines.append(f"left of an earlier config, since changed after they were made: {', '.join(changed)}")
    return lines


def _made(records: Path, results: str) -> Iterator[tuple[str, dict[str, Any]]]:
    """Yield the files below a folder that have a record, in order, with it."""
    found = []
    for place in records.rglob("*"):
        # Snakemake splits long names into folders that begin with @.
        name = "".join(part.removeprefix("@") for part in place.relative_to(records).parts)
        with suppress(binascii.Error, UnicodeDecodeError, ValueError):
            path = base64.urlsafe_b64decode(name.encode()).decode()
            inside = os.path.normpath(path).startswith(f"{results}{os.sep}")
            if inside and place.is_file() and os.path.isfile(path):
                found.append((path, place))
    for path, place in sorted(found):
        with suppress(OSError, ValueError):
            record = json.loads(place.read_text(encoding="utf-8"))
            if isinstance(record, dict):
                yield path, record
