"""The minimal campaign on a cluster of one node."""

from __future__ import annotations

import subprocess
from pathlib import Path

from project_copy import MINIMAL, Project

PROFILE = ("--profile", "workflow/profiles/slurm", "--default-resources", "slurm_partition=main")
# The cluster keeps no accounts and is asked often; real ones are not. Two batches of scenes, one for each core, and one
# of the whole road.
HURRY = ("--slurm-status-command", "squeue", "--slurm-init-seconds-before-status-checks", "1", "--slurm-no-account")
BATCHES = ("--group-components", "scenes=9", "whole=4", "readings=8")


class OnCluster(Project):
    """The minimal campaign in a folder of its own, its scenes in batches on a cluster."""

    def __init__(self, root: Path, cluster: dict[str, str]) -> None:
        super().__init__(root, MINIMAL)
        self.cluster = cluster

    def command(self, *arguments: str) -> list[str]:
        here = super().command()
        return [*here[: here.index("--cores")], *PROFILE, *HURRY, *BATCHES, "--", *arguments]

    @property
    def environment(self) -> dict[str, str]:
        return super().environment | self.cluster

    @property
    def here(self) -> Project:
        """The same folder, for Snakemake without the cluster."""
        return Project(self.root)

    def cancel_all(self) -> None:
        subprocess.run(["scancel", "--state=PENDING"], env=self.environment, check=True)
        subprocess.run(["scancel", "--state=RUNNING"], env=self.environment, check=True)

    def queue(self) -> str:
        """Return what runs on the cluster, or waits."""
        command = ["squeue", "--noheader", "--states", "PENDING,RUNNING,COMPLETING"]
        return subprocess.run(command, env=self.environment, capture_output=True, text=True, check=True).stdout
