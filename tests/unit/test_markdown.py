"""Tables in Markdown."""

from __future__ import annotations

from rubfric.markdown import markdown_table


def test_first_row_is_the_header() -> None:
    assert markdown_table([["a", "b"], ["c", 1], ["|d|", 2]]) == "| a | b |\n| --- | --- |\n| c | 1 |\n| \\|d\\| | 2 |"


def test_numbers_are_aligned_to_the_right() -> None:
    assert markdown_table([["a", "b", "c"]], numeric=True) == "| a | b | c |\n| --- | ---: | ---: |"
