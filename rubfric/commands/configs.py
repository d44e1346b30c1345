"""What commands on a campaign share: the option for its configs, and what to know of it before it is run."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterable
from pathlib import Path

from rubfric.config.campaign import Campaign
from rubfric.config.pairs import which


def add_configs(command: argparse.ArgumentParser) -> None:
    """Add the option ``--config``."""
    command.add_argument(
        "--config",
        action="append",
        type=Path,
        metavar="FILE",
        help="YAML config to lay over config/config.yaml; may be given again",
    )


def warn(campaign: Campaign, unlikely: Iterable[str] = ()) -> None:
    """Say on standard error what is unlikely of its numbers, and which of several rubbers and roads it is of.

    Parameters
    ----------
    campaign : Campaign
    unlikely : iterable of str
        As from ``rubfric.config.plausibility.check_plausible``.
    """
    for line in [*(f"unlikely: {sentence}" for sentence in unlikely), *([which(campaign)] if campaign.others else [])]:
        print(f"rubfric: {line}", file=sys.stderr)
