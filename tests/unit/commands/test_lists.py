"""Lists of numbers are given in one way to all commands."""

from __future__ import annotations

import argparse

import pytest

from rubfric.commands.lists import Numbers, take_negative_lists
from rubfric.errors import InvalidInput


def parsed(*words: str, **form: str) -> list[float]:
    parser = argparse.ArgumentParser()
    parser.add_argument("--temperature", action=Numbers, **form)
    parser.add_argument("-j")
    take_negative_lists(parser)
    found: list[float] = parser.parse_args(["--temperature", *words]).temperature
    return found


@pytest.mark.parametrize("words", [["-10,2e1,.5"], ["-10,", "20", "0.5"], ["-10", "20,0.5"]])
def test_commas_or_blanks_part_numbers_that_may_be_negative(words: list[str]) -> None:
    assert parsed(*words, nargs="+") == [-10.0, 20.0, 0.5]


@pytest.mark.parametrize("word", ["1;2", "1,,2", "", "fast"])
def test_anything_else_is_refused_in_a_sentence(word: str) -> None:
    with pytest.raises(InvalidInput, match=r"^--temperature is .* but must be numbers with commas between"):
        parsed(word)
