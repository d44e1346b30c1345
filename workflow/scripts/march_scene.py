"""Press a block onto its road and slide it step by step; write what happened."""

import glob
import hashlib
from pathlib import Path
from typing import Any

from rubfric.errors import BrokenResult
from rubfric.marching import march
from rubfric.mechanics.march.result import Transient
from rubfric.results.dataset import write
from rubfric.results.march import build
from rubfric.scene.procedure import Procedure
from rubfric.scene.scene import Scene
from rubfric.simulation import simulate
from rubfric.sources import sources


def main(output: str, parameters: dict[str, Any], procedure: dict[str, Any]) -> None:
    """March and write the result.

    A march that was killed continues from its checkpoint, a hidden file beside the output, if it is of the same config
    and of the same code.

    Parameters
    ----------
    output : str
        Path of the march (netCDF).
    parameters : dict
        Those of the ``Scene``.
    procedure : dict
        Those of the ``Procedure``.
    """
    scene = Scene.from_parameters(parameters)
    place = Path(output)
    checkpoint = checkpoint_of(place)
    for left in place.parent.glob(f".{glob.escape(place.name)}*.checkpoint"):
        if left != checkpoint:
            print(f"{left} is the checkpoint of other code; starting from the beginning", flush=True)
            left.unlink()
    steady = float(simulate(scene)["friction_coefficient"])

    def go() -> Transient:
        return march(scene, Procedure(**procedure), progress=lambda line: print(line, flush=True), restart=checkpoint)

    try:
        found = go()
    except BrokenResult as error:  # of a march of another config, or damaged
        print(f"{error}; starting from the beginning", flush=True)
        checkpoint.unlink()
        found = go()
    write(build(found, steady), output)
    checkpoint.unlink(missing_ok=True)
    print(f"{scene.name}: {found.saturation}; steady sliding gives {steady:.5g}")


def checkpoint_of(output: Path) -> Path:
    """Return where a march of this code keeps its state; other code has another name."""
    code = hashlib.sha256(b"".join(path.read_bytes() for path in sources("rubfric.marching"))).hexdigest()[:16]
    return output.with_name(f".{output.name}.{code}.checkpoint")
