"""Compare the estimated errors of some scenes with the true ones."""

from typing import Any

import pandas as pd

from rubfric.results.tables import write_table
from rubfric.scene.numerics import Numerics
from rubfric.scene.scene import Scene
from rubfric.studies.accuracy.calibration import calibrate


def main(output: str, scenes: dict[str, dict[str, Any]], presets: dict[str, dict[str, Any]]) -> None:
    """Write one row per scene and preset.

    Parameters
    ----------
    output : str
        Path of the table (CSV).
    scenes : dict
        Parameters of each ``Scene`` by its name, which begins with the name of its set.
    presets : dict
        Parameters of each ``Numerics`` by the name of the preset.
    """
    numerics = {preset: Numerics(**values) for preset, values in presets.items()}
    parts = []
    for name, parameters in scenes.items():
        parts.append(calibrate(name, name.partition("_")[0], Scene.from_parameters(parameters), numerics))
        print(parts[-1].to_string(), flush=True)
    write_table(pd.concat(parts), output)
