"""The parser of the command line and of each command."""

from __future__ import annotations

import argparse
import difflib
from typing import Any


class CommandParser(argparse.ArgumentParser):
    """A parser that refuses unknown options itself, with its own usage and the option that may have been meant.

    That of argparse leaves them to the parser above, whose usage names no option of the command.
    """

    def parse_known_args(self, args: Any = None, namespace: Any = None) -> Any:
        """Return the options, and no other arguments: where there are any, the program ends with status 2."""
        found, unknown = super().parse_known_args(args, namespace)
        if unknown:
            options = [one for one in self._option_string_actions if one.startswith("--")]
            close = difflib.get_close_matches(unknown[0].partition("=")[0], options, n=1, cutoff=0.75)
            self.error(f"unrecognized arguments: {' '.join(unknown)}{f' (did you mean {close[0]}?)' if close else ''}")
        return found, unknown
