"""Gather what was measured of accuracy into tables and a page."""

from pathlib import Path

import pandas as pd

from rubfric.files import whole
from rubfric.results.tables import read_table, write_table
from rubfric.studies.accuracy.calibration import coverage_table, preset_rows
from rubfric.studies.accuracy.page import accuracy_page
from rubfric.studies.accuracy.presets import knob_table, start_table, with_costs

# What a label holds is text, though it may look like a number.
_TEXT = ("rung", "note")


def main(outputs: dict[str, str], ladders: list[str], calibrations: list[str], accuracies: dict[str, float]) -> None:
    """Write the tables ladder, knobs, starts, calibration and verdict, and the page."""
    ladder = with_costs(pd.concat([read_table(path, _TEXT) for path in ladders], ignore_index=True), accuracies)
    drawn = [read_table(path, _TEXT) for path in calibrations]
    calibration = pd.concat([preset_rows(ladder), *drawn], ignore_index=True)
    write_table(ladder, outputs["ladder"])
    write_table(knob_table(ladder), outputs["knobs"])
    write_table(start_table(ladder), outputs["starts"])
    write_table(calibration, outputs["calibration"])
    write_table(coverage_table(calibration), outputs["verdict"])
    with whole(outputs["page"]) as part:
        Path(part).write_text(accuracy_page(ladder, calibration, accuracies), encoding="utf-8")
