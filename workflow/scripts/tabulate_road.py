"""Write friction on a measured road, window by window and cutoff by cutoff, as a table and a page."""

import os
from typing import Any

import pandas as pd

from rubfric.config.measured_road import MeasuredRoad, analysed
from rubfric.errors import BrokenResult
from rubfric.pages.render import sentence, write_page
from rubfric.pages.slide import slide_page
from rubfric.results.carriers import carriers
from rubfric.results.dataset import load
from rubfric.results.provenance import OTHER_SCENE
from rubfric.results.road_friction import Block, Outcome, means, tabulate
from rubfric.results.selection import REFUSAL
from rubfric.results.tables import read_table, write_table
from rubfric.scene.scene import Scene


def main(
    output: str,
    page: str,
    road: str,
    entry: dict[str, Any],
    scene: dict[str, Any],
    points: list[tuple[float, float, float, dict[str, str]]],
    sines: list[tuple[float, float, str, str]],
    total: str,
    temperature: float | None,
) -> None:
    """Write the table and its page.

    Parameters
    ----------
    output, page : str
        Paths of the table (CSV) and the page.
    road : str
        Name of the road.
    entry : dict
        Its entry in the config, with ``profile``.
    scene : dict
        Parameters of one of the scenes: of the block that slides.
    points : list
        Pressure, MPa, speed, mm/s, cutoff, mm, and the digests of the results of all windows by their paths.
    sines : list
        Pressure, speed, path and digest of each result of the sines at once.
    total : str
        Path of the table of totals, which has the sum over the sines.
    temperature : float or None
        That of the results, degC.
    """
    found = analysed(MeasuredRoad.read(f"roads.{road}", entry))
    block = Block.of(Scene.from_parameters(scene))
    files = {(pressure, velocity, cutoff): of for pressure, velocity, cutoff, of in points}
    windows = len(points[0][3])
    whole = {(pressure, velocity): (path, digest) for pressure, velocity, path, digest in sines}
    sums = _sums(read_table(total, ["way", "note"]), temperature)

    def solved(pressure: float, velocity: float, cutoff: float) -> list[Outcome]:
        return [_outcome(*one) for one in files[pressure, velocity, cutoff].items()]

    def fitted(pressure: float, velocity: float) -> list[dict[str, Any]]:
        place = (pressure, velocity)
        if place not in whole:
            return []
        at_once = block.row_of_sines("sines", found.sines, velocity, pressure) | means([_outcome(*whole[place])])
        summed = block.row_of_sines("sum", found.sines, velocity, pressure) | sums.get(place, {})
        return [at_once, summed]

    asked: dict[tuple[float, float], list[float]] = {}
    for pressure, velocity, cutoff in files:
        asked.setdefault((pressure, velocity), []).append(cutoff)
    table = tabulate(found, block, asked, windows, solved, fitted, print)
    write_table(table, output)
    warm = "" if temperature is None else f" at {temperature:g} degC"
    lead = (
        f"{block.material.name}{warm}, a block {block.height:.4g} mm high, plane {block.plane}, {block.kinematics} "
        f"kinematics, over {windows} windows of {found.window:g} mm. The sum over sines is that of the scales, each "
        "under a block of its own height"
    )
    carrying = carriers(table)
    words = f"{lead}. {sentence(carrying) if carrying else ''}".strip()
    write_page(slide_page(table, road, words, os.path.basename(output), "../index.html"), page)


def _outcome(path: str, digest: str) -> Outcome:
    """Return friction, its error and contact of a result, or why it was refused."""
    result = load(path)
    if result.attrs.get("scene_digest") != digest:
        raise BrokenResult(f"{path} {OTHER_SCENE}; delete it and run again")
    if REFUSAL in result.attrs:
        return str(result.attrs[REFUSAL])
    friction, error, contact = (
        float(result[name]) for name in ("friction_coefficient", "friction_coefficient_error", "contact_fraction")
    )
    return friction, error, contact


def _sums(table: pd.DataFrame, temperature: float | None) -> dict[tuple[float, float], dict[str, float]]:
    """Return the sum over the sines with its error, by pressure and speed."""
    if temperature is not None:
        table = table[table["temperature_degC"] == temperature]
    columns = ["pressure_MPa", "velocity_mm_per_s", "friction_sum", "friction_sum_error"]
    return {
        (pressure, velocity): {"friction_coefficient": friction, "friction_numerical_error": error}
        for pressure, velocity, friction, error in table[columns].itertuples(index=False)
    }
