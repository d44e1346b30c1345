"""How a logger's file is written, as far as the user says it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from rubfric import checks
from rubfric.errors import InvalidInput
from rubfric.rules import Choice, Integer

SEPARATORS = {"tab": "\t", "semicolon": ";", "comma": ",", "pipe": "|", "space": " "}
DECIMALS = {"point": ".", "comma": ","}


@dataclass(frozen=True)
class Format:
    """How a file is written; what is not said is found out.

    Attributes
    ----------
    separator : str, optional
        A key of ``SEPARATORS``.
    decimal : {"point", "comma"}, optional
    encoding : str, optional
        As Python names it.
    headings : int, optional
        Line of the headings, from 1.
    missing : tuple of str
        Words that mean no value, besides the usual ones; ``*`` is for any characters.
    overloaded : tuple of str
        Words that mean an input beyond its range, likewise.
    """

    separator: str | None = None
    decimal: str | None = None
    encoding: str | None = None
    headings: int | None = None
    missing: tuple[str, ...] = ()
    overloaded: tuple[str, ...] = ()


AS_FOUND = Format()


def _encoding(key: str, value: Any) -> str:
    try:
        b"a".decode(value)
    except (LookupError, TypeError, ValueError) as error:
        raise InvalidInput(
            f"{key} is {checks.shown(value)}, but must be the name of an encoding, such as utf-8 or shift_jis"
        ) from error
    return str(value)


def _words(key: str, value: Any) -> tuple[str, ...]:
    words = value if isinstance(value, list) else [value]
    for word in words:
        if not isinstance(word, (str, int, float)) or isinstance(word, bool):
            raise InvalidInput(f"{key} is {checks.shown(value)}, but must be a list of words as the file has them")
    return tuple(map(str, words))


# key of the YAML file: how its value is checked
FORMAT: dict[str, Any] = {
    "separator": Choice(words=SEPARATORS).check,
    "decimal": Choice(words=DECIMALS).check,
    "encoding": _encoding,
    "headings": Integer().check,
    "missing": _words,
    "overloaded": _words,
}
