"""YAML files: what is no YAML, what is given twice, and one file laid over another."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from rubfric.config.campaign import load
from rubfric.config.default import PAPER
from rubfric.config.overlay import as_typed, overlaid, read_yaml
from rubfric.errors import InvalidInput


def write(folder: Path, content: str) -> Path:
    path = folder / "mine.yaml"
    path.write_text(content, encoding="utf-8")
    return path


@pytest.mark.parametrize(
    ("content", "key", "lines"),
    [
        ("plane: stress\nplane: strain\n", "plane", "1 and 2"),
        (
            "rubbers:\n  soft:\n    bulk: elastic\n    # again\n    'bulk': proportional\n",
            "rubbers.soft.bulk",
            "3 and 5",
        ),
        ("roads:\n  mine:\n    - {amplitude: 1,\n       amplitude: 2}\n", r"roads.mine\[0\].amplitude", "3 and 4"),
        ("a: &x {b: 1}\nc:\n  <<: *x\n  d: 1\n  d: 2\n", "c.d", "4 and 5"),
    ],
)
def test_key_given_twice_is_refused_with_both_lines(tmp_path: Path, content: str, key: str, lines: str) -> None:
    with pytest.raises(InvalidInput, match=rf"mine.yaml has the key '{key}' twice, in lines {lines}; keep one$"):
        read_yaml(write(tmp_path, content))


def test_aliases_that_stand_for_more_values_than_any_config_has_are_refused(tmp_path: Path) -> None:
    kinds = ["[k, k]", "{k: 1, l: 1}"]
    for first in kinds:
        lines = [f"a0: &a0 {first}", *(f"a{n}: &a{n} [*a{n - 1}, *a{n - 1}]" for n in range(1, 40))]
        with pytest.raises(InvalidInput, match=r"mine.yaml holds more than 100000 values once its aliases"):
            read_yaml(write(tmp_path, "\n".join(lines)))
    with pytest.raises(InvalidInput, match="more than 100000 values"):
        read_yaml(write(tmp_path, "a: &x [*x]\n"))


def test_merged_and_repeated_mappings_are_no_keys_given_twice(tmp_path: Path) -> None:
    content = "a: &x {b: 1, c: 2}\nd: &y {<<: *x, b: 3}\ne: {<<: *y, c: 4}\nf: [*x, *y]\n"
    x, y = {"b": 1, "c": 2}, {"b": 3, "c": 2}
    assert read_yaml(write(tmp_path, content)) == {"a": x, "d": y, "e": {"b": 3, "c": 4}, "f": [x, y]}


def test_mappings_are_merged_and_lists_replaced(tmp_path: Path) -> None:
    below = write(tmp_path, "\ufeffa: {b: 1, c: [1, 2]}\nd: 1\n")
    above = tmp_path / "above.yaml"
    above.write_text("a: {c: [3]}\n", encoding="utf-8")
    assert overlaid([below, above], ()) == {"a": {"b": 1, "c": [3]}, "d": 1}
    with pytest.raises(InvalidInput, match=r"^no config was given"):
        overlaid([], ())


def test_mapping_takes_the_place_of_a_file_and_is_left_as_it_is(tmp_path: Path) -> None:
    below, above = write(tmp_path, "a: {b: 1, c: [1, 2]}\nd: 1\n"), {"a": {"c": (3,)}}
    assert overlaid([below, above], ()) == {"a": {"b": 1, "c": (3,)}, "d": 1}
    assert above == {"a": {"c": (3,)}}
    campaign = load()
    assert load(PAPER, {"plane": "strain"}) == replace(campaign, plane="strain")
    assert load({"plane": "strain"}) == load(PAPER, {"plane": "strain"})
    assert load(write(tmp_path, "plane: strain\n")) == load({"plane": "strain"})
    assert load(read_yaml(PAPER)) == campaign


def test_entries_of_the_command_line_are_the_numbers_they_were_written_as() -> None:
    # What Snakemake makes of --config 'a={"b": 0.5, "c": [1, 1e-3], "d": null, "e": word}' f=null
    given = {"a": {"b": "0.5", "c": ["1", "1e-3"], "d": "null", "e": "word"}, "f": "null"}
    config = {**given, "g": "0.5", "h": {"b": "0.5"}}  # g and h are of a file, where quotes were meant
    typed = as_typed(config, given)
    assert typed["a"] == {"b": 0.5, "c": [1, 1e-3], "d": None, "e": "word"}
    assert isinstance(typed["a"]["c"][0], int)
    assert typed == {"a": typed["a"], "f": None, "g": "0.5", "h": {"b": "0.5"}}
    # A config that is no longer what was given there is left alone.
    assert as_typed({"a": {"b": "0.7"}}, given) == {"a": {"b": "0.7"}}


def test_lists_nested_without_end_are_no_yaml(tmp_path: Path) -> None:
    with pytest.raises(InvalidInput, match=r"mine.yaml is not valid YAML: "):
        read_yaml(write(tmp_path, "[" * 10_000 + "]" * 10_000))
