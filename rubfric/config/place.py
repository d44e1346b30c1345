"""Paths in a config."""

from __future__ import annotations

import hashlib
import os
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

from rubfric.checks import shown
from rubfric.errors import InvalidInput
from rubfric.rules import Rule

# A name has room for 255 bytes; a path for 4096, of which the outputs take their share.
LONGEST_NAME, LONGEST_PATH = 255, 1000


@dataclass(frozen=True)
class Place(Rule):
    """The path of a file or a folder.

    Parameters
    ----------
    kind : {"file", "folder"}
    optional : bool
        Whether None may take its place.
    """

    kind_of_item: ClassVar[str] = "file"
    kind: str = "file"
    optional: bool = False

    def check(self, key: str, value: Any) -> str | None:
        """Return a path that the system can take, that of a folder without a slash at its end."""
        if value is None and self.optional:
            return None
        given, value = value, _expanded(key, value)
        if not isinstance(value, str) or not value.strip() or not value.isprintable() or set(value) & set("{}"):
            raise InvalidInput(f"{key} is {shown(given)}, but must be the path of a {self.kind}, without braces")
        if len(os.fsencode(value)) > LONGEST_PATH or max(map(len, os.fsencode(value).split(b"/"))) > LONGEST_NAME:
            raise InvalidInput(
                f"{key} is {shown(value)}, but must have at most {LONGEST_PATH} letters, {LONGEST_NAME} a name"
            )
        return (value.rstrip("/") or "/") if self.kind == "folder" else value

    def _schema(self) -> dict[str, Any]:
        kind = ["string", "null"] if self.optional else "string"
        return {"type": kind, "minLength": 1, "maxLength": LONGEST_PATH}


def digest_of(key: str, path: str) -> str:
    """Return the SHA-256 of a file that the config names.

    Parameters
    ----------
    key : str
        That names it.
    path : str

    Raises
    ------
    InvalidInput
        For a file that is missing or cannot be read.
    """
    try:
        return hashlib.sha256(Path(path).read_bytes()).hexdigest()
    except OSError as error:
        missing = isinstance(error, FileNotFoundError)
        why = "there is no such file" if missing else f"it cannot be read: {error.strerror}"
        raise InvalidInput(
            f"{key} is {path!r}, but {why}; a relative path counts from the folder of the config that has it"
        ) from error


def _expanded(key: str, value: Any) -> Any:
    """Return a path in which ``~`` and environment variables stand for what they do in a shell."""
    if not isinstance(value, str) or not {"~", "$"} & set(value):
        return value
    unset = [name for name in re.findall(r"\$(\w+)|\$\{(\w+)\}", value) if "".join(name) not in os.environ]
    if unset:
        name = "".join(unset[0])
        raise InvalidInput(
            f"{key} is {shown(value)}, but the environment variable {name} is not set; set it, or write out the path"
        )
    path = os.path.expanduser(os.path.expandvars(value))
    if value.startswith("~") and path.startswith("~"):
        raise InvalidInput(f"{key} is {shown(value)}, but there is no such user; write ./~ for a file of that name")
    return path
