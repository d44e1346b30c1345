"""Rules: what each admits, in what form, and the sentence for what it does not."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Annotated, Any

import pytest

from rubfric.config.place import Place
from rubfric.errors import InvalidInput
from rubfric.rules import Choice, Integer, Items, Number, Rule, Word, check_fields

PRESSURE, GRID = Number("Pressure.", "MPa"), Items("Speeds.", Number(unit="mm/s"))
RATIO = Number("Ratio.", low=-1.0, high=0.5, excluded=True)
PLANE = Choice("Plane.", ("stress", "strain"))
COLUMNS = Integer("Columns.", 1, 64, step=8)
NO_WORD = "but must be a word of letters, digits, '-' and '_'"
NO_PATH = "but must be the path of a file, without braces"


@pytest.mark.parametrize(
    ("rule", "value", "canonical"),
    [
        (PRESSURE, 0.1 + 0.2, 0.3),
        (PRESSURE, 1e-30, 1e-30),
        (RATIO, 0.4999, 0.4999),
        (Number(low=0.0), 0, 0.0),
        (COLUMNS, 64.0, 64),
        (Integer(low=0), 0, 0),
        (PLANE, "strain", "strain"),
        (Word(), "zhou-2019_a", "zhou-2019_a"),
        (Place(), "läufe/run 1.csv", "läufe/run 1.csv"),
        (Place(kind="folder"), "out/put//", "out/put"),
        (Place(kind="folder"), "/", "/"),
        (Place(optional=True), None, None),
        (GRID, [1000, 0.1 + 0.2, 5], (0.3, 5.0, 1000.0)),
        (Items(each=Word(), least=0, ascending=False), ("b", "a"), ("b", "a")),
        (Items(least=0, distinct=False, ascending=False), [2, 1, 2], (2.0, 1.0, 2.0)),
        (Items(least=0), [], ()),
    ],
)
def test_value_that_is_allowed_comes_back_in_canonical_form(rule: Rule, value: Any, canonical: Any) -> None:
    checked = rule.check("key", value)
    assert checked == canonical
    assert type(checked) is type(canonical)


@pytest.mark.parametrize(
    ("rule", "value", "says"),
    [
        (PRESSURE, 0, "is 0 MPa, but must be greater than 0"),
        (PRESSURE, -1.0e-9, "is -1e-09 MPa, but must be greater than 0"),
        (PRESSURE, 1e-31, "is 1e-31 MPa, but must lie between 1e-30 and 1e+30"),
        (PRESSURE, 1e31, "is 1e+31 MPa, but must lie between 1e-30 and 1e+30"),
        (Number(unit="mm", low=0.0), -0.1, "is -0.1 mm, but must be at least 0"),
        (Number(low=0.0, high=1.0), 1.1, "is 1.1, but must be at most 1"),
        *[(RATIO, value, f"is {value:g}, but must lie between -1 and 0.5, both excluded") for value in (-1, 0.5, 0.7)],
        *[(Integer(low=4), value, f"is {value:g}, but must be a whole number of at least 4") for value in (4.5, 3, -8)],
        *[(COLUMNS, value, f"is {value}, but must be a multiple of 8") for value in (4, 12)],
        (COLUMNS, 72, "is 72, but must be at most 64"),
        (COLUMNS, 0, "is 0, but must be a whole number of at least 1"),
        (
            Choice(words=("stress", "strain")),
            "stres",
            "is 'stres', but must be one of stress, strain (did you mean stress?)",
        ),
        (PLANE, 3, "is 3, but must be one of stress, strain"),
        *[(Word(), value, f"is {value!r}, {NO_WORD}") for value in ("", "a b", "a/b", "a.b", "ü", "a\n", 3, None)],
        *[(Place(), value, f"is {value!r}, {NO_PATH}") for value in ("", " ", "a\nb", "{x}", "\ud800", 5, None)],
        (GRID, [], "is empty, but must hold at least one number"),
        *[(GRID, value, f"is {value!r}, but must be a list of numbers") for value in (5.0, "0.1", None, {"a": 1.0})],
        (Items(each=Word()), "a", "is 'a', but must be a list of names"),
        (Items(each=Place(), least=0), ["a", "b", "a"], "[2] is 'a', the same as key[0]; keep one"),
        (GRID, [0.3, 1.0, 0.1 + 0.2], "[2] is 0.3 mm/s, the same as key[0]; keep one"),
        (GRID, [1.0, 0.0], "[1] is 0 mm/s, but must be greater than 0"),
    ],
)
def test_value_that_is_not_allowed_is_refused_in_one_sentence(rule: Rule, value: Any, says: str) -> None:
    with pytest.raises(InvalidInput, match=f"^key ?{re.escape(says)}$"):
        rule.check("key", value)


@pytest.mark.parametrize(("rule", "value"), [(Word(), "x" * 101), (Place(), "x" * 300), (Place(), "x/" * 600)])
def test_what_is_too_long_for_a_path_is_refused(rule: Rule, value: str) -> None:
    with pytest.raises(InvalidInput, match=r"at most \d+"):
        rule.check("key", value)


def test_fields_of_a_dataclass_are_brought_to_canonical_form() -> None:
    @dataclass(frozen=True)
    class Block:
        columns: Annotated[int, COLUMNS]
        time: Annotated[float | None, Number(unit="s")] = None
        free: object = None

        def __post_init__(self) -> None:
            check_fields(self, "block.")

    assert Block.__annotations__["columns"] == "Annotated[int, COLUMNS]"
    block = Block(64.0)  # type: ignore[arg-type]
    assert (type(block.columns), block.time) == (int, None)
    with pytest.raises(InvalidInput, match=r"^block\.time is 0 s, but must be greater than 0$"):
        Block(64, 0.0)
