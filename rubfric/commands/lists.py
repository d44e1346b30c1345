"""Lists of numbers on the command line, the same in all commands: ``--velocity 1,10,100``."""

from __future__ import annotations

import argparse
import re
from collections.abc import Sequence
from typing import Any

from rubfric.errors import InvalidInput


class Numbers(argparse.Action):
    """Numbers with commas between, as a list of float; with ``nargs="+"`` also with blanks between.

    Raises
    ------
    InvalidInput
        For anything else.
    """

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: str | Sequence[Any] | None,
        option_string: str | None = None,
    ) -> None:
        """Keep the numbers of the words that were given."""
        words = [values] if isinstance(values, str) else [*(values or [])]
        try:
            found = [float(part) for word in words for part in str(word).strip(",").split(",")]
        except ValueError:
            given = " ".join(map(str, words))
            raise InvalidInput(
                f"{option_string} is {given!r}, but must be numbers with commas between, 1,10,100 say"
            ) from None
        setattr(namespace, self.dest, found)


_WHAT = {
    "velocity": "sliding speeds, mm/s",
    "pressure": "nominal pressures, MPa",
    "temperature": "temperatures of a rubber with shift factors, degC",
}


def add_points(command: argparse.ArgumentParser, *names: str, default: str) -> None:
    """Add options that take lists.

    Parameters
    ----------
    command : argparse.ArgumentParser
    *names : str
        Of ``velocity``, ``pressure`` and ``temperature``.
    default : str
        What they are by default, in words.
    """
    for name in names:
        words = f"{_WHAT[name]}, with commas between (default: {default})"
        command.add_argument(f"--{name}", action=Numbers, metavar=f"{name[0].upper()},...", help=words)
    take_negative_lists(command)


def take_negative_lists(command: argparse.ArgumentParser) -> None:
    """Let a command take -10,20 for a list, not for an option."""
    command._negative_number_matcher = re.compile(r"^-\.?\d[\d.,eE+-]*$")
