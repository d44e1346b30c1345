from __future__ import annotations

import re

import numpy as np
import pytest

from rubfric import checks
from rubfric.errors import InvalidInput


@pytest.mark.parametrize(("value", "canonical"), [(0.1 + 0.2, 0.3), (0.10, 1.0e-1), (3, 3.0), (-2, -2.0)])
def test_number_is_canonical(value: float, canonical: float) -> None:
    assert checks.number("key", value) == canonical


def test_number_keeps_twelve_digits_and_drops_the_thirteenth() -> None:
    assert checks.number("key", 0.123456789012) == 0.123456789012
    assert checks.number("key", 0.1234567890123) == 0.123456789012


@pytest.mark.parametrize("value", [np.float64(0.3), np.float32(0.5), np.int64(4)])
def test_number_accepts_numpy_scalars_and_returns_plain_floats(value: np.generic) -> None:
    checked = checks.number("key", value)
    assert type(checked) is float
    assert checked == float(value)


@pytest.mark.parametrize(
    ("text", "advice"),
    [("1e-3", "1.0e-3"), ("5E4", "5.0e+4"), ("25e1", "2.5e+2"), ("-3e2", "-3.0e+2"), ("-1e0", "-1.0e+0")],
)
def test_text_that_looks_like_a_number_is_refused_with_the_way_to_write_it(text: str, advice: str) -> None:
    sentence = rf"^pressure is the text '{text}', but must be a number \(YAML reads it as text; write "
    with pytest.raises(InvalidInput, match=sentence) as caught:
        checks.number("pressure", text)
    assert str(caught.value).endswith(f"write {advice})")


def test_other_text_is_refused_without_advice() -> None:
    with pytest.raises(InvalidInput, match=r"^pressure is the text 'high', but must be a number$"):
        checks.number("pressure", "high")


@pytest.mark.parametrize("value", [True, False, None, [1.0], {"a": 1}, 1j])
def test_what_is_no_number_is_refused(value: object) -> None:
    with pytest.raises(InvalidInput, match=r"^velocity is .*, but must be a number$"):
        checks.number("velocity", value)


@pytest.mark.parametrize("value", [float("nan"), float("inf"), float("-inf")])
def test_numbers_that_are_not_finite_are_refused(value: float) -> None:
    with pytest.raises(InvalidInput, match=r"^velocity is -?(nan|inf), but must be a finite number$"):
        checks.number("velocity", value)


@pytest.mark.parametrize("value", [0, 0.0, -1.0e-9])
def test_positive_refuses_zero_and_less_and_names_the_unit(value: float) -> None:
    with pytest.raises(InvalidInput, match=r"^pressure is (0|-1e-09) MPa, but must be greater than 0$"):
        checks.positive("pressure", value, "MPa")


def test_positive_numbers_are_bounded() -> None:
    assert checks.positive("pressure", 1e-30) == 1e-30
    for value in (1e-31, 1e31):
        sentence = re.escape(f"pressure is {value:g} MPa, but must lie between 1e-30 and 1e+30")
        with pytest.raises(InvalidInput, match=sentence):
            checks.positive("pressure", value, "MPa")


def test_quoted_number_is_refused_without_advice() -> None:
    with pytest.raises(InvalidInput, match=r"^pressure is the text '0.1', but must be a number$"):
        checks.number("pressure", "0.1")


def test_at_least_includes_its_bound() -> None:
    assert checks.at_least("amplitude", 0, 0.0) == 0.0
    with pytest.raises(InvalidInput, match=r"^amplitude is -0.1 mm, but must be at least 0$"):
        checks.at_least("amplitude", -0.1, 0.0, "mm")


@pytest.mark.parametrize("value", [-1.0, 0.5, 0.7])
def test_between_excludes_its_bounds(value: float) -> None:
    with pytest.raises(InvalidInput, match=r"^nu is .*, but must lie between -1 and 0.5, both excluded$"):
        checks.between("nu", value, -1.0, 0.5)


def test_between_accepts_the_inside() -> None:
    assert checks.between("nu", 0.4999, -1.0, 0.5) == 0.4999


@pytest.mark.parametrize("value", [2.5, 3, -8])
def test_whole_refuses_fractions_and_what_is_below_its_bound(value: float) -> None:
    with pytest.raises(InvalidInput, match=r"^nodes is .*, but must be a whole number of at least 4$"):
        checks.whole("nodes", value, 4)


def test_whole_returns_an_integer() -> None:
    assert checks.whole("nodes", 4.0, 4) == 4
    assert type(checks.whole("nodes", 4.0, 4)) is int


@pytest.mark.parametrize("value", [4, 12, 250])
def test_multiple_refuses_the_numbers_between(value: int) -> None:
    with pytest.raises(InvalidInput, match=rf"^columns is {value}, but must be a multiple of 8$"):
        checks.multiple("columns", value, 8)


@pytest.mark.parametrize("value", [0, -8])
def test_multiple_refuses_zero_and_less(value: int) -> None:
    with pytest.raises(InvalidInput, match=r"^columns is .*, but must be a whole number of at least 1$"):
        checks.multiple("columns", value, 8)


def test_multiple_accepts_multiples() -> None:
    assert checks.multiple("columns", 256.0, 8) == 256


def test_one_of_lists_what_is_allowed_and_suggests_the_nearest() -> None:
    assert checks.one_of("plane", "strain", ("stress", "strain")) == "strain"
    with pytest.raises(
        InvalidInput, match=r"^plane is 'stres', but must be one of stress, strain \(did you mean stress\?\)$"
    ):
        checks.one_of("plane", "stres", ("stress", "strain"))


def test_one_of_suggests_nothing_where_nothing_is_near() -> None:
    with pytest.raises(InvalidInput, match=r"^plane is 3, but must be one of stress, strain$"):
        checks.one_of("plane", 3, ("stress", "strain"))


def test_unknown_key_is_named_with_a_suggestion() -> None:
    with pytest.raises(InvalidInput, match=r"^load has the unknown key 'presure'; .*\(did you mean pressure\?\)$"):
        checks.known_keys("load", {"presure": 1.0}, ("pressure", "velocity"))


def test_missing_key_is_named() -> None:
    with pytest.raises(InvalidInput, match=r"^load lacks the key 'velocity'$"):
        checks.known_keys("load", {"pressure": 1.0}, ("pressure", "velocity"), ("pressure", "velocity"))


@pytest.mark.parametrize("given", [None, 3.0, ["pressure"], "pressure"])
def test_what_is_no_mapping_is_refused(given: object) -> None:
    with pytest.raises(InvalidInput, match=r"^load is .*, but must hold the keys pressure, velocity$"):
        checks.known_keys("load", given, ("pressure", "velocity"))


def test_known_keys_returns_what_it_was_given() -> None:
    given = {"pressure": 5.0}
    assert checks.known_keys("load", given, ("pressure", "velocity"), ("pressure",)) is given


def test_grid_is_canonical_and_ascending() -> None:
    assert checks.grid("velocities", [1000, 0.1 + 0.2, 5]) == (0.3, 5.0, 1000.0)


@pytest.mark.parametrize("values", [[], ()])
def test_empty_grid_is_refused(values: object) -> None:
    with pytest.raises(InvalidInput, match=r"^velocities is empty, but must hold at least one number$"):
        checks.grid("velocities", values)


@pytest.mark.parametrize("values", [5.0, "0.1", None, {"a": 1.0}])
def test_grid_that_is_no_list_is_refused(values: object) -> None:
    with pytest.raises(InvalidInput, match=r"^velocities is .*, but must be a list of numbers$"):
        checks.grid("velocities", values)


@pytest.mark.parametrize("values", [[0.1, 5.0, 0.10], [0.3, 1.0, 0.1 + 0.2], [10, 2, 1.0e1]])
def test_duplicates_in_a_grid_are_refused_however_they_are_written(values: list[float]) -> None:
    sentence = r"^velocities\[2\] is \S+ mm/s, the same as velocities\[0\]; each may stand once$"
    with pytest.raises(InvalidInput, match=sentence):
        checks.grid("velocities", values, "mm/s")


def test_bad_entry_of_a_grid_is_named_by_its_place() -> None:
    with pytest.raises(InvalidInput, match=r"^velocities\[1\] is 0 mm/s, but must be greater than 0$"):
        checks.grid("velocities", [1.0, 0.0], "mm/s")


@pytest.mark.parametrize("value", ["", "a b", "a/b", "../x", "a.b", 3, None])
def test_text_unfit_for_a_file_name_is_refused(value: object) -> None:
    with pytest.raises(InvalidInput, match=r"^name is .*, but must be a word of letters, digits, '-' and '_'$"):
        checks.text("name", value)


def test_text_fit_for_a_file_name_is_returned() -> None:
    assert checks.text("name", "zhou-2019_a") == "zhou-2019_a"


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0.1, "0.1"),
        (0.1 + 0.2, "0.3"),
        (10000, "10000"),
        (1e4, "10000"),
        (1e-9, "1e-9"),
        (2.5e-9, "2.5e-9"),
        (1e-5, "0.00001"),
        (123456789.0, "123456789"),
        (1e9, "1e9"),
        (3.25e12, "3.25e12"),
        (-0.75, "-0.75"),
        (0.0, "0"),
    ],
)
def test_numbers_are_written_in_their_shortest_form(value: float, text: str) -> None:
    assert checks.written(value) == text


def test_what_is_written_is_read_back(rng: np.random.Generator) -> None:
    for exponent in range(-30, 30):
        value = float(rng.uniform(1.0, 10.0) * 10.0**exponent)
        assert float(checks.written(value)) == checks.number("value", value)


@pytest.mark.parametrize("text", ["nan", "inf", "-inf", "1e400"])
def test_text_of_no_finite_number_is_refused_without_advice(text: str) -> None:
    with pytest.raises(InvalidInput, match=rf"^pressure is the text '{text}', but must be a number$"):
        checks.number("pressure", text)


@pytest.mark.parametrize("value", [np.True_, np.array([1.0, 2.0]), np.complex128(1j), 10**400])
def test_what_only_looks_like_a_number_is_refused(value: object) -> None:
    with pytest.raises(InvalidInput, match=r"^velocity is .*, but must be a (finite )?number$"):
        checks.number("velocity", value)


def test_minus_zero_is_zero() -> None:
    assert str(checks.number("amplitude", -0.0)) == "0.0"
