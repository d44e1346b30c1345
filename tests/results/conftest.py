"""The paper's campaign, run once from the shipped config, as a user reads it."""

from __future__ import annotations

import pytest
from project_copy import Project


@pytest.fixture(scope="session")
def paper(tmp_path_factory: pytest.TempPathFactory) -> Project:
    """The default campaign, complete. Not to be changed."""
    project = Project.from_source(tmp_path_factory.mktemp("paper"), options=())
    project.run()
    return project
