"""A scene solved in a process of its own, from a cold start, within a limit of CPU time."""

from __future__ import annotations

import json
import resource
import signal
import subprocess
import sys
import time
from collections.abc import Sequence
from typing import Any

import xarray as xr

from rubfric.errors import RubfricError
from rubfric.scene.scene import Scene
from rubfric.simulation import simulate

# Of a scene of which the refusal, as a limit of CPU time, says nothing.
STOPPED = "stopped: more than {} s"


def child(arguments: Sequence[str], budget: int) -> dict[str, Any]:
    """Return what a script prints of one scene as JSON, or that it took more than so many seconds of CPU time.

    Parameters
    ----------
    arguments : sequence of str
        Script and arguments.
    budget : int
        s.
    """
    limits = (budget, budget + 1)
    found = subprocess.run(
        [sys.executable, *arguments],
        stdout=subprocess.PIPE,
        check=False,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, limits),
    )
    if found.returncode == -signal.SIGXCPU:
        return {"cpu": float(budget), "refusal": STOPPED.format(budget)}
    if found.returncode:
        raise SystemExit(f"{' '.join(arguments)} ended with {found.returncode}")
    return dict(json.loads(found.stdout))


def measured(scene: Scene) -> tuple[dict[str, Any], xr.Dataset | None]:
    """Return CPU time, s, peak memory, MB, and columns, friction and error, or a refusal; and the result, if any."""
    row: dict[str, Any] = {}
    result = None
    started = time.process_time()
    try:
        result = simulate(scene)
    except RubfricError as error:
        row["refusal"] = str(error)
    row["cpu"] = time.process_time() - started
    row["memory"] = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0
    if result is not None:
        friction = float(result["friction_coefficient"])
        error = float(result["friction_coefficient_error"]) / friction
        row |= {"columns": int(result["columns"]), "friction": friction, "error": error}
    return row, result
