"""Imported by the fork server of the jobs: everything that a job needs, imported and used once.

Much of the scientific stack is loaded on first use only; what is loaded here, no job loads again.
"""

from __future__ import annotations

import gc
import io
import pkgutil
import sys
import tempfile
from importlib import import_module
from pathlib import Path

import rubfric.curve_simulation
import rubfric.figures
import rubfric.results.campaign
import rubfric.results.tables
from rubfric.results.dataset import write
from rubfric.road.sine import SineScale
from rubfric.rubber.material import Material
from rubfric.scene.numerics import Numerics
from rubfric.scene.scene import Scene
from rubfric.simulation import simulate


def _use_everything() -> None:
    rubber = Material("warm", 1.0, 0.4, (0.5,), (1.0,))
    numerics = Numerics(contact_nodes=4, columns_min=8, finite_columns_min=8, row_growth=2.0, output_columns=8)
    for kinematics in ("small", "finite"):
        scene = Scene(1, SineScale(0.1, 1.0), 1.0, 0.01, 0.5, rubber, "stress", numerics, kinematics)
        with tempfile.TemporaryDirectory() as folder:
            write(simulate(scene), Path(folder) / "warm.nc")
    for module in pkgutil.iter_modules(rubfric.figures.__path__, "rubfric.figures."):
        import_module(module.name)
    from matplotlib.figure import Figure

    for kind in ("pdf", "png"):
        drawn = Figure()
        drawn.add_subplot().plot([0, 1], label="1")
        drawn.savefig(io.BytesIO(), format=kind)


try:
    _use_everything()
except Exception as error:  # what is wrong here fails a job too, with a better message
    print(f"The jobs start cold: {error}", file=sys.stderr)
# Frozen objects are left alone by the garbage collection of the forks, which would otherwise copy their pages.
gc.collect()
gc.freeze()
