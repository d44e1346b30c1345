"""Scenes solved side by side, of single scales and of the whole road, and their results kept."""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NamedTuple

import xarray as xr

from rubfric.errors import InvalidInput, NotConverged
from rubfric.progress import Progress
from rubfric.results import kept
from rubfric.results.dataset import write
from rubfric.results.provenance import refusal
from rubfric.results.selection import NOT_NEEDED
from rubfric.results.whole_road import WholeRoad
from rubfric.scene.scene import Scene
from rubfric.simulation import simulate
from rubfric.streams import OneLine
from rubfric.workers import as_completed

# The kinds of jobs, as the workflow's folders of their results are called.
SCENES, WHOLE = "scenes", "whole"
# So long, s, and so many this process solves by itself: workers need as long to begin, and the time left is known from
# so many on.
_ALONE, _FIRST = 1.0, 3


class Job(NamedTuple):
    """A scene of one scale or of the whole road: where its result is kept, and what the workflow has of it.

    Of a whole road for which a cheaper way may do, the road, too; ``path`` then says that, or is a copy of ``direct``.
    """

    kind: str
    name: str
    scene: Scene
    path: Path
    direct: Path
    made: Path
    road: WholeRoad | None = None


def solve_all(jobs: Sequence[Job], at_once: int, progress: bool | Callable[[str], None]) -> None:
    """Solve all jobs: for a while in this process, then, the last and dearest first, in workers.

    Parameters
    ----------
    jobs : sequence of Job
        Scenes of one scale first.
    at_once : int
        How many at a time.
    progress : bool or callable
        Whether to say on standard error how far it is; or what takes a line on it after every job.
    """
    line = OneLine(sys.stderr if progress is True else None)
    rules = {SCENES: "scene", WHOLE: "whole_scene"}
    done = Progress(Counter(rules[job.kind] for job in jobs))

    def begin(place: int) -> None:
        done.start(place, rules[jobs[place].kind], jobs[place].name)

    def end(place: int) -> None:
        done.finish(place)
        line.show(f"rubfric: {done.line()}", last=done.complete)
        if callable(progress):
            progress(done.line())

    places = list(range(len(jobs)))
    try:
        while places and (
            at_once == 1 or len(places) == 1 or done.elapsed < _ALONE or len(jobs) - len(places) < _FIRST
        ):
            begin(places[0])
            solve(jobs[places[0]])
            end(places.pop(0))
        order = places[::-1]
        left, names = [jobs[place] for place in order], [jobs[place].name for place in order]
        for which, _ in as_completed(solve, left, at_once, (__name__,), names, lambda which: begin(order[which])):
            end(order[which])
    finally:
        if not done.complete:  # what stopped it has a line of its own
            line.show(f"rubfric: {done.line()}", last=True)


def solve(job: Job) -> None:
    """Keep the result of a job; of the whole road why there is none, or the way that is cheaper.

    Raises
    ------
    InvalidInput, NotConverged
        For a scene of one scale that is refused.
    """
    scene = job.scene
    way = job.road.cheapest(scene.velocity, scene.pressure) if job.road else "direct"
    if way != "direct":
        write(refusal(scene, NOT_NEEDED + way), job.path)
        return
    known = next((path for path in (job.direct, job.made) if kept.fits(path, scene)), None)
    if known is None:
        known = job.direct
        write(_result(job), known)
    if job.road:
        kept.copy(known, job.path)


def _result(job: Job) -> xr.Dataset:
    try:
        return simulate(job.scene)
    except (InvalidInput, NotConverged) as reason:
        if job.kind == WHOLE:
            return refusal(job.scene, reason)
        if isinstance(reason, NotConverged):  # which names the scene itself
            raise
        raise InvalidInput(f"{job.name}: {reason}") from None
