"""Completion in the shell: ``rubfric --print-completion bash``, or zsh, tcsh, fish, powershell, by shtab."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path
from typing import Any

SHELLS = ("bash", "zsh", "tcsh", "fish", "powershell")
# How arguments are called that are paths.
_FILES = ("FILE", "DECK", "YAML", "RESULTS")


class PrintCompletion(argparse.Action):
    """Print the script that completes commands, options and files in a shell, and end."""

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: str | Sequence[Any] | None,
        option_string: str | None = None,
    ) -> None:
        """Print the script for the shell that is given."""
        try:
            import shtab
        except ImportError:
            parser.exit(2, f"rubfric: {option_string} needs the library shtab: pip install 'rubfric[completion]'\n")
        _complete_files(parser, shtab.FILE)
        print(shtab.complete(parser, str(values)))
        parser.exit()


def _complete_files(parser: argparse.ArgumentParser, how: Any) -> None:
    """Have files completed where a path is meant, in all commands."""
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            for command in action.choices.values():
                _complete_files(command, how)
        elif action.type is Path or action.metavar in _FILES:
            action.complete = how  # type: ignore[attr-defined]
