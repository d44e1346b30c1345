"""Config files checked before Snakemake reads them, whose errors are tracebacks without a name.

The workflow's profile, the first of its files that Snakemake reads, calls it.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence

from rubfric.config.models import Config
from rubfric.config.overlay import overlaid
from rubfric.errors import InvalidInput
from rubfric.outputs import no_file


def check_given(arguments: Sequence[str]) -> None:
    """Exit with one sentence where a file given by ``--configfile`` is missing, no text in UTF-8, or no config in YAML.

    Parameters
    ----------
    arguments : sequence of str
        Of Snakemake's command line.
    """
    for path in _config_files(arguments):
        try:
            overlaid([path], Config.model_fields)
        except InvalidInput as error:
            sys.exit(f"The config is wrong: {error}.")
        except FileNotFoundError:
            sys.exit(f"The config is wrong: {no_file(path)}.")
        except OSError as error:
            sys.exit(f"The config is wrong: {path} cannot be read ({error.strerror}).")


def _config_files(arguments: Sequence[str]) -> Iterator[str]:
    within = False
    for argument in arguments:
        if argument.startswith("-"):
            name, equals, value = argument.partition("=")
            within = name in ("--configfile", "--configfiles") and not equals
            if name in ("--configfile", "--configfiles") and equals:
                yield value
        elif within:
            yield argument
