"""Hold the estimated errors of some scenes against the true ones."""

from typing import Any

import pandas as pd

from rubfric.results.tables import write_table
from rubfric.scene.numerics import Numerics
from rubfric.scene.scene import Scene
from rubfric.studies.accuracy.calibration import calibrate


def main(output: str, scenes: dict[str, dict[str, Any]], presets: dict[str, dict[str, Any]]) -> None:
    """Write one row per scene and preset as a CSV table; a scene's name begins with the name of its set."""
    numerics = {preset: Numerics(**values) for preset, values in presets.items()}
    parts = []
    for name, parameters in scenes.items():
        parts.append(calibrate(name, name.partition("_")[0], Scene.from_parameters(parameters), numerics))
        print(parts[-1].to_string(), flush=True)
    write_table(pd.concat(parts), output)
