"""Reduce measured runs of the rig to friction over speed and pressure; without any, those of the virtual rig."""

from rubfric.config.rig import RigChoice
from rubfric.results.friction_map import FrictionMap
from rubfric.results.scales import WORDS
from rubfric.results.tables import read_table, write_table
from rubfric.results.temperature import rows_at
from rubfric.rig.reduction import point_table, reduce_files, rejected_table
from rubfric.rig.settings import read_settings
from rubfric.rig.summary import summary
from rubfric.rig.virtual import measure, parts_of, plan, targets


def main(points: str, rejected: str, totals: str, rig: dict[str, object], temperature: float | None) -> None:
    """Write the CSV tables ``points`` and ``rejected``; ``rig`` is the config's, ``totals`` the table of totals.

    The virtual rig runs at a ``temperature`` (degC) of these; of measured runs none is known.
    """
    choice = RigChoice.read("rig", rig)
    if choice.data:
        runs = reduce_files(choice.data, read_settings(choice.columns))
    else:
        runs = virtual_runs(choice, FrictionMap.from_totals(rows_at(read_table(totals, WORDS), temperature)))
    write_table(point_table(runs), points)
    write_table(rejected_table(runs), rejected)
    print(summary(runs))


def virtual_runs(choice: RigChoice, friction: FrictionMap) -> list:
    """Return what the virtual rig measures."""
    sled, sensors = parts_of(choice.virtual)
    wanted = targets(friction, choice.pressures, choice.speeds)
    runs, beyond = plan(friction, sled, wanted, choice.virtual.heaviest_weight)
    return [*measure(runs, friction, sled, sensors, choice.virtual.seed), *beyond]
