"""A small campaign, run once; every test gets a copy of it."""

from __future__ import annotations

from pathlib import Path

import pytest
from project_copy import Project


@pytest.fixture(scope="session")
def template(tmp_path_factory: pytest.TempPathFactory) -> Project:
    """The minimal campaign, complete. Not to be changed."""
    project = Project.from_source(tmp_path_factory.mktemp("a path with spaces"))
    project.run()
    return project


@pytest.fixture
def project(template: Project, tmp_path: Path) -> Project:
    """A copy of the complete campaign, free to be changed."""
    return template.copy(tmp_path / "project")


@pytest.fixture
def empty_project(tmp_path: Path) -> Project:
    """The project without any results."""
    return Project.from_source(tmp_path / "project")
