"""Numbers in canonical form, keys that are known, and values as messages show them."""

from __future__ import annotations

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


def test_quoted_number_is_refused_without_advice() -> None:
    with pytest.raises(InvalidInput, match=r"^pressure is the text '0.1', but must be a number$"):
        checks.number("pressure", "0.1")


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


def test_key_that_has_an_allowed_one_as_a_part_suggests_that_one() -> None:
    with pytest.raises(InvalidInput, match=r"\(did you mean bulk\?\)$"):
        checks.known_keys("rubber", {"bulk_fractions": 1}, ("shear_fractions", "bulk"))


def test_value_nested_without_end_is_shown_at_once_and_in_short() -> None:
    value: list[object] = ["lol"]
    for _ in range(60):
        value = [value] * 9
    assert len(checks.shown(value)) < 100
    assert checks.shown(10**5000) == "a int too long to show"


@pytest.mark.parametrize(
    ("value", "digits", "places"), [(0.0123, 2, 3), (0.0996, 2, 2), (1000.0, 2, -2), (1000.0, 4, 0), (0.5, 1, 1)]
)
def test_decimals_are_those_of_the_rounded_number(value: float, digits: int, places: int) -> None:
    assert checks.decimals(value, digits) == places
