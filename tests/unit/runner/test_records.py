"""Snakemake's records: text passes, also where it is cut short; anything else is named with the way out."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from rubfric.errors import BrokenResult
from rubfric.runner.records import check_records


def test_text_passes_and_so_does_no_folder_at_all(tmp_path: Path) -> None:
    (tmp_path / "below").mkdir()
    (tmp_path / "below" / "a").write_text('{"rule": "scene", "rubber": "weiß"}')
    (tmp_path / "b").write_bytes(b'{"rule": "sc')
    (tmp_path / "c").write_bytes(b"")
    check_records(tmp_path)
    check_records(tmp_path / "nowhere")


def test_bytes_that_are_no_text_are_named(tmp_path: Path) -> None:
    (tmp_path / "a").write_text("{}")
    (tmp_path / "b").write_bytes(b"\xff\xfe{}")
    sentence = f"Snakemake's record {tmp_path}/b is damaged: delete all of them (rm -r {tmp_path}) and run again"
    with pytest.raises(BrokenResult, match=f"^{re.escape(sentence)}"):
        check_records(tmp_path)
