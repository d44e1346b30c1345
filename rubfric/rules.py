"""What a value may be, defined once: a rule checks it, describes it, and gives its JSON schema.

A rule is written at the field that it governs, ``velocity: Annotated[float, Number("Sliding speed.", "mm/s")]``, in the
dataclasses of a scene as in the models of the config.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache
from typing import Any, ClassVar, get_type_hints

from rubfric.checks import number, shown, suggestion, with_unit
from rubfric.errors import InvalidInput

# Bounds on every quantity that must be positive: their products stay far from overflow and underflow.
SMALLEST, LARGEST = 1e-30, 1e30
# Words become part of file names.
LONGEST_WORD = 100
_LETTERS = "[A-Za-z0-9_-]+"
# Faults of one list that are named.
_MOST_FAULTS = 5
# Where a rule does not know its key, which pydantic knows: see ``rubfric.config.entries``.
HERE = "\0"


@dataclass(frozen=True)
class Rule:
    """What the value of a key may be; subclasses say how it is checked and described.

    Parameters
    ----------
    about : str
        What the key means, in a sentence.
    """

    about: str = ""
    # What a list of such values is of.
    kind_of_item: ClassVar[str] = "number"

    def check(self, key: str, value: Any) -> Any:
        """Return ``value`` in canonical form.

        Parameters
        ----------
        key : str
            Where the value is, as a sentence names it.
        value : object

        Raises
        ------
        InvalidInput
            One sentence that names the key, the value, and what is allowed.
        """
        raise NotImplementedError

    def schema(self) -> dict[str, Any]:
        """Return the JSON schema of the values allowed; the unit of numbers is a keyword of its own."""
        return ({"description": self.about} if self.about else {}) | self._schema()

    def _schema(self) -> dict[str, Any]:
        raise NotImplementedError

    def __get_pydantic_core_schema__(self, source: Any, handler: Any) -> Any:
        from pydantic_core import core_schema  # scenes check themselves without pydantic

        return core_schema.no_info_plain_validator_function(lambda value: self.check(HERE, value))

    def __get_pydantic_json_schema__(self, core: Any, handler: Any) -> dict[str, Any]:
        return self.schema()


@dataclass(frozen=True)
class Number(Rule):
    """A number from ``low`` to ``high``, by default any positive one.

    Parameters
    ----------
    unit : str
        Nothing for a dimensionless number.
    low, high : float
        Bounds, in that unit.
    excluded : bool
        Whether the bounds themselves are excluded.
    """

    unit: str = ""
    low: float = SMALLEST
    high: float = LARGEST
    excluded: bool = False

    def check(self, key: str, value: Any) -> float:
        """Return a canonical float within the bounds."""
        checked = number(key, value)
        if self.excluded:
            allowed = self.low < checked < self.high
            wanted = f"lie between {self.low:g} and {self.high:g}, both excluded"
        else:
            allowed = self.low <= checked <= self.high
            wanted = f"be at least {self.low:g}" if checked < self.low else f"be at most {self.high:g}"
            if self.low == SMALLEST and checked <= 0.0:
                wanted = "be greater than 0"
            elif (self.low, self.high) == (SMALLEST, LARGEST):
                wanted = f"lie between {SMALLEST:g} and {LARGEST:g}"
        if not allowed:
            raise InvalidInput(f"{key} is {with_unit(checked, self.unit)}, but must {wanted}")
        return checked

    def _schema(self) -> dict[str, Any]:
        low, high = ("exclusiveMinimum", "exclusiveMaximum") if self.excluded else ("minimum", "maximum")
        return {"type": "number", low: self.low, high: self.high, "unit": self.unit or "dimensionless"}


@dataclass(frozen=True)
class Integer(Rule):
    """A whole number from ``low`` to ``high`` that is a multiple of ``step``.

    Parameters
    ----------
    low, high, step : int
    """

    low: int = 1
    high: int | None = None
    step: int = 1

    def check(self, key: str, value: Any) -> int:
        """Return an int within the bounds."""
        checked = number(key, value)
        if checked != int(checked) or checked < self.low:
            raise InvalidInput(f"{key} is {checked:g}, but must be a whole number of at least {self.low}")
        if self.high is not None and checked > self.high:
            raise InvalidInput(f"{key} is {checked:g}, but must be at most {self.high}")
        if checked % self.step:
            raise InvalidInput(f"{key} is {checked:g}, but must be a multiple of {self.step}")
        return int(checked)

    def _schema(self) -> dict[str, Any]:
        bounds: dict[str, Any] = {
            "type": "integer",
            "minimum": max(self.low, self.step) if self.low else 0,
        }
        bounds |= {} if self.high is None else {"maximum": self.high}
        return bounds if self.step == 1 else bounds | {"multipleOf": self.step}


@dataclass(frozen=True)
class Choice(Rule):
    """One of some words.

    Parameters
    ----------
    words : iterable of str
    """

    words: Iterable[str] = ()

    def check(self, key: str, value: Any) -> str:
        """Return ``value`` if it is one of the words."""
        words = list(self.words)
        if value not in words:
            raise InvalidInput(
                f"{key} is {shown(value)}, but must be one of {', '.join(words)}{suggestion(value, words)}"
            )
        return str(value)

    def _schema(self) -> dict[str, Any]:
        return {"enum": list(self.words)}


@dataclass(frozen=True)
class Word(Rule):
    """A word that can be part of a file name."""

    kind_of_item: ClassVar[str] = "name"

    def check(self, key: str, value: Any) -> str:
        """Return ``value`` if it is such a word."""
        if (
            not isinstance(value, str)
            or not value
            or not all(c.isascii() and (c.isalnum() or c in "-_") for c in value)
        ):
            raise InvalidInput(f"{key} is {shown(value)}, but must be a word of letters, digits, '-' and '_'")
        if len(value) > LONGEST_WORD:
            raise InvalidInput(
                f"{key} is {shown(value)}, {len(value)} letters long, but must have at most {LONGEST_WORD}"
            )
        return value

    def _schema(self) -> dict[str, Any]:
        return {"type": "string", "pattern": f"^{_LETTERS}$", "maxLength": LONGEST_WORD}


@dataclass(frozen=True)
class Items(Rule):
    """A list whose items all obey one rule.

    Parameters
    ----------
    each : Rule
    least : int
        Fewest items, 0 or 1.
    distinct : bool
        Whether no two items may be alike.
    ascending : bool
        Whether they are brought into ascending order.
    """

    each: Rule = Number()
    least: int = 1
    distinct: bool = True
    ascending: bool = True

    def check(self, key: str, value: Any) -> tuple[Any, ...]:
        """Return the items as a tuple, each in canonical form; a bad one is named by its place."""
        of = self.each.kind_of_item
        if not isinstance(value, (list, tuple)):
            raise InvalidInput(f"{key} is {shown(value)}, but must be a list of {of}s")
        if len(value) < self.least:
            raise InvalidInput(f"{key} is empty, but must hold at least one {of}")
        items: list[Any] = []
        faults: list[str] = []
        for place, item in enumerate(value):
            try:
                items.append(self.each.check(f"{key}[{place}]", item))
            except InvalidInput as error:
                faults += error.faults
        if faults:
            raise InvalidInput(*faults[:_MOST_FAULTS])
        if self.distinct and len(set(items)) < len(items):
            again = next(place for place, item in enumerate(items) if item in items[:place])
            what = with_unit(items[again], getattr(self.each, "unit", ""))
            raise InvalidInput(f"{key}[{again}] is {what}, the same as {key}[{items.index(items[again])}]; keep one")
        return tuple(sorted(items) if self.ascending else items)

    def _schema(self) -> dict[str, Any]:
        bounds = ({"minItems": self.least} if self.least else {}) | ({"uniqueItems": True} if self.distinct else {})
        return {"type": "array", **bounds, "items": self.each.schema()}


def check_fields(instance: object, at: str = "") -> None:
    """Bring every field of a frozen dataclass that has a rule to its canonical value.

    Parameters
    ----------
    instance : dataclass instance
        Fields that are None by default may be None.
    at : str
        What comes before a field's name in a sentence, ``"numerics."`` for one.
    """
    kind: Any = type(instance)
    for name, rule in rules(kind).items():
        value = getattr(instance, name)
        if value is not None or getattr(kind, name, ...) is not None:
            object.__setattr__(instance, name, rule.check(at + name, value))


@cache
def rules(kind: Any) -> dict[str, Rule]:
    """Return the rules of a dataclass's fields, by name."""
    hints = get_type_hints(kind, include_extras=True)
    marks = ((name, mark) for name, hint in hints.items() for mark in getattr(hint, "__metadata__", ()))
    return {name: mark for name, mark in marks if isinstance(mark, Rule)}
