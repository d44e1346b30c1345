"""Copies of the project in folders of their own, where Snakemake may do its worst."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml

from rubfric.config.campaign import Campaign, load

SOURCE = Path(__file__).resolve().parents[2]
MINIMAL = ("--configfile", "config/minimal.yaml")


@dataclass(frozen=True)
class Plan:
    """What a dry run would do.

    Attributes
    ----------
    jobs : dict
        Number of jobs by rule, without ``all`` and the page of all results, which is written after anything else.
    scenes : set of str
        Names of the scenes that would run.
    figures : set of str
        Names of the figures that would be drawn.
    text : str
        All that Snakemake said.
    """

    jobs: dict[str, int]
    scenes: set[str]
    figures: set[str]
    text: str

    @classmethod
    def read(cls, text: str) -> Plan:
        table = re.search(r"^job +count\n[- ]+\n((?:\w+ +\d+\n)+)", text, re.MULTILINE)
        counts = dict(line.split() for line in table[1].splitlines()) if table else {}
        if not table and "Nothing to be done" not in text:
            raise AssertionError(f"there is no table of jobs in:\n{text}")
        messages = re.findall(r"^Job \d+: (.*)$", text, re.MULTILINE)
        return cls(
            jobs={rule: int(count) for rule, count in counts.items() if rule not in ("all", "total", "index_page")},
            scenes={message for message in messages if re.match(r"scale\d+_v", message)},
            figures={message.removeprefix("Drawing ") for message in messages if message.startswith("Drawing ")},
            text=text,
        )


class Project:
    """The project in a folder of its own, with its results and Snakemake's memory."""

    def __init__(self, root: Path, options: tuple[str, ...] = MINIMAL) -> None:
        self.root = root
        self.options = options

    @classmethod
    def from_source(cls, root: Path, options: tuple[str, ...] = MINIMAL) -> Project:
        """Copy every file that git tracks or would track."""
        listed = subprocess.run(
            ["git", "ls-files", "-coz", "--exclude-standard"], cwd=SOURCE, capture_output=True, text=True, check=True
        )
        for name in filter(None, listed.stdout.split("\0")):
            if (SOURCE / name).exists():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy2(SOURCE / name, root / name, follow_symlinks=False)
        return cls(root, options)

    def copy(self, root: Path) -> Project:
        """Return a copy with all results, their times included."""
        shutil.copytree(self.root, root, symlinks=True)
        return Project(root, self.options)

    def command(self, *arguments: str) -> list[str]:
        return [sys.executable, "-m", "snakemake", *self.options, "--cores", "2", *arguments]

    @property
    def environment(self) -> dict[str, str]:
        """Environment in which the copy's package comes before the installed one."""
        kept = {name: value for name, value in os.environ.items() if not name.startswith("SNAKEMAKE")}
        return kept | {"PYTHONPATH": str(self.root), "OPENBLAS_NUM_THREADS": "1"}

    def snakemake(self, *arguments: str) -> subprocess.CompletedProcess[str]:
        """Run Snakemake, whatever comes of it."""
        return subprocess.run(
            self.command(*arguments),
            cwd=self.root,
            env=self.environment,
            capture_output=True,
            text=True,
            check=False,
            timeout=600,
        )

    def run(self, *arguments: str) -> str:
        """Run Snakemake, which must succeed; return what it said."""
        done = self.snakemake(*arguments)
        assert done.returncode == 0, done.stderr
        return done.stderr

    def plan(self, *arguments: str) -> Plan:
        """Return what a run would do."""
        done = self.snakemake("--quiet", "host", "-n", *arguments)  # every job by name
        assert done.returncode == 0, done.stderr
        return Plan.read(done.stdout + done.stderr)

    def edit(self, name: str, change: Callable[[str], str]) -> None:
        """Change the text of a file, which must be another one then."""
        path = self.root / name
        before = path.read_text(encoding="utf-8")
        after = change(before)
        assert after != before
        path.write_text(after, encoding="utf-8")

    def comment(self, *names: str) -> None:
        """Append a comment to files."""
        for name in names:
            self.edit(name, lambda text: f"{text.rstrip()}\n# A remark.\n")

    def configure(self, at: str, value: Any, config: str = "config/minimal.yaml") -> None:
        """Put a value into a config, at a place such as ``grid.velocities``."""

        def put(text: str) -> str:
            tree = yaml.safe_load(text)
            *way, last = (int(key) if key.isdigit() else key for key in at.split("."))
            place = tree
            for key in way:
                place = place[key]
            place[last] = value
            return yaml.safe_dump(tree, sort_keys=False, allow_unicode=True)

        self.edit(config, put)

    @property
    def campaign(self) -> Campaign:
        """What the config of the copy asks for."""
        return load(self.root / "config" / "config.yaml", *(self.root / path for path in self.options[1:]))

    @property
    def results(self) -> Path:
        return self.root / self.campaign.results

    @property
    def scene_files(self) -> dict[str, Path]:
        """The results that exist of the rubber in use, by the names of their scenes."""
        folder = self.results / "scenes" / self.campaign.material.name / self.campaign.road_name
        return {path.stem: path for path in sorted(folder.glob("*.nc"))}

    @property
    def tables(self) -> dict[str, str]:
        """The texts of the tables of friction, by file name."""
        return {path.name: path.read_text() for path in sorted((self.results / "tables").glob("friction_*.csv"))}
