"""One cluster for all tests, and the project on it."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import pytest
from on_cluster import OnCluster
from one_node import one_node
from project_copy import Project


@pytest.fixture(scope="session")
def cluster() -> Iterator[dict[str, str]]:
    """What SLURM's commands need in their environment to find a cluster of one node and two cores."""
    with one_node() as environment:
        yield {name: environment[name] for name in ("PATH", "SLURM_CONF")}


@pytest.fixture(scope="session")
def on_cluster(cluster: dict[str, str], tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], OnCluster]:
    """Return a function that makes a copy of the project without results, to run on the cluster."""
    return lambda name: OnCluster(Project.from_source(tmp_path_factory.mktemp(name)).root, cluster)
