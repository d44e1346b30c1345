"""A line that says how far something is: over itself on a terminal, and now and then elsewhere."""

from __future__ import annotations

import io

import pytest

from rubfric.streams import OneLine


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


@pytest.mark.parametrize(
    ("stream", "expected"),
    [
        (Terminal(), "\r1 of 3, slow\r2 of 3      \r3 of 3\n"),
        (io.StringIO(), "2 of 3\n3 of 3\n"),
    ],
    ids=["terminal", "file"],
)
def test_line_is_written_over_itself_or_after_a_while(stream: io.StringIO, expected: str) -> None:
    times = iter([0.0, 1.0, 6.0, 7.0])
    line = OneLine(stream, lambda: next(times))
    line.show("1 of 3, slow")
    line.show("2 of 3")
    line.show("3 of 3", last=True)
    assert stream.getvalue() == expected


def test_nothing_is_said_where_there_is_no_stream_or_it_is_gone() -> None:
    OneLine(None).show("done", last=True)
    gone = Terminal()
    line = OneLine(gone)
    gone.close()
    line.show("done", last=True)
