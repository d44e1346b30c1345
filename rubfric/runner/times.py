"""What the jobs behind the results have cost: written at the end of each job's log, and gathered from there.

The process that Snakemake's own ``benchmark:`` watches is the one that all jobs share, so that its figures would be of
all that runs at the time; these are of one job.
"""

from __future__ import annotations

import contextlib
import csv
import io
import os
import re
import time
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from rubfric.files import whole

_SAID = re.compile(r"took ([\d.]+) s, ([\d.]+) s of CPU time(?:, ([\d.]+) MB of memory at most)?\n\Z")
# The last line of a log is within its last so many bytes.
_LINE = 200


class Cost(NamedTuple):
    """What one job has cost.

    Parameters
    ----------
    log : str
        Path of the job's log.
    seconds, cpu : float
        Wall time and CPU time of the job and of the processes that it waited for, s.
    memory : float or None
        Peak resident memory of its process, MB; None where the system does not tell.
    """

    log: str
    seconds: float
    cpu: float
    memory: float | None

    @property
    def kind(self) -> str:
        """What kind of job it was: the first folder of its log, ``others`` for a log by itself."""
        folder, _, rest = self.log.partition("/")
        return folder if rest else "others"


@contextlib.contextmanager
def clock() -> Iterator[None]:
    """Print what that which happens within has cost, once it has ended well."""
    _forget_peak()
    began, cpu = time.monotonic(), _cpu()
    yield
    peak = _peak()
    memory = "" if peak is None else f", {peak:.0f} MB of memory at most"
    print(f"took {time.monotonic() - began:.3f} s, {_cpu() - cpu:.3f} s of CPU time{memory}")


def costs(folder: str | Path) -> list[Cost]:
    """Return what all jobs with a log in a folder have cost, the dearest first.

    Parameters
    ----------
    folder : str or Path
        ``logs`` of the results. Logs without such a line, of jobs that failed, are left out.
    """
    found = []
    for path in Path(folder).rglob("*.log"):
        with open(path, "rb") as stream:
            stream.seek(max(0, path.stat().st_size - _LINE))
            said = _SAID.search(stream.read().decode("utf-8", "replace"))
        if said:
            seconds, cpu, memory = said.groups()
            name = path.relative_to(folder).as_posix()
            found.append(Cost(name, float(seconds), float(cpu), float(memory) if memory else None))
    return sorted(found, key=lambda cost: (-cost.cpu, cost.log))


def shares(found: list[Cost]) -> dict[str, tuple[int, float, float]]:
    """Return for each kind of job, the dearest first: how many, their CPU time in s, and its share of all."""
    total = sum(cost.cpu for cost in found)
    kinds = {kind: [cost.cpu for cost in found if cost.kind == kind] for kind in {cost.kind for cost in found}}
    rows = ((kind, (len(each), sum(each), sum(each) / total if total else 0.0)) for kind, each in kinds.items())
    return dict(sorted(rows, key=lambda row: (-row[1][1], row[0])))


def record(folder: str | Path) -> list[Cost]:
    """Write ``times.csv`` into a folder of logs, a row for each job, and return its rows.

    Raises
    ------
    NotWritten
        Where the system does not let it be written.
    """
    found = costs(folder)
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerow(["log", "seconds", "cpu_seconds", "memory_MB"])
    table.writerows([*cost[:3], "" if cost.memory is None else cost.memory] for cost in found)
    with whole(Path(folder) / "times.csv") as part:
        Path(part).write_text(text.getvalue(), encoding="utf-8")
    return found


def _cpu() -> float:
    return sum(os.times()[:4])


def _forget_peak() -> None:
    """Let the system begin anew to note the peak memory of this process, which may have run other jobs."""
    with contextlib.suppress(OSError):
        Path("/proc/self/clear_refs").write_text("5", encoding="ascii")


def _peak() -> float | None:
    """Return the peak resident memory of this process, MB."""
    with contextlib.suppress(OSError):
        said = re.search(r"VmHWM:\s*(\d+) kB", Path("/proc/self/status").read_text(encoding="ascii"))
        return int(said[1]) * 1.024e-3 if said else None
    return None
