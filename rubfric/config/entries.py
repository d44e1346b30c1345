"""What a model of the config is made of: entries with keys of their own, and entries by name."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from types import MappingProxyType
from typing import Annotated, Any, Self

from pydantic import BaseModel, ConfigDict, TypeAdapter, ValidationError, model_validator

from rubfric.checks import known_keys, shown, unknown_key
from rubfric.errors import InvalidInput
from rubfric.rules import HERE, Items, Number, Rule, Word, rules


class Entry(BaseModel):
    """A mapping of the config with keys of its own."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    @model_validator(mode="before")
    @classmethod
    def _known(cls, given: Any) -> Any:
        """Let pydantic find every unknown key; what to say of it takes the place of its value."""
        if not isinstance(given, Mapping):
            return given if isinstance(given, cls) else known_keys(HERE, given, cls.model_fields)
        known = {name: value for name, value in given.items() if name in cls.model_fields}
        others = [name for name in given if name not in known]
        return known | {f"{HERE}{place}": _Unknown(cls.unknown(name)) for place, name in enumerate(others)}

    @classmethod
    def unknown(cls, name: Any) -> str:
        """Return what to say of a key that there is not."""
        return unknown_key(HERE, name, cls.model_fields)

    @classmethod
    def read(cls, key: str, given: Any) -> Self:
        """Check a mapping and read it.

        Parameters
        ----------
        key : str
            Where the mapping is in the config, for the messages; nothing for the whole config.
        given : mapping

        Raises
        ------
        InvalidInput
            One sentence on every wrong entry, in the order of the keys.
        """
        try:
            return cls.model_validate(given)
        except ValidationError as error:
            raise InvalidInput(*faults(key, error)) from None

    @classmethod
    def sound_sections(cls, given: Any) -> dict[str, Any]:
        """Return those entries of a mapping that are right by themselves, read."""
        sections = {}
        for name in cls.model_fields if isinstance(given, Mapping) else ():
            if name in given:
                with contextlib.suppress(ValidationError):
                    sections[name] = _adapter(cls, name).validate_python(given[name])
        return sections

    def given(self) -> dict[str, Any]:
        """Return the entries that were given, without the defaults of others."""
        return self.model_dump(exclude_unset=True)


@dataclass(frozen=True)
class _Unknown:
    """What to say of an unknown key."""

    says: str


@cache
def _adapter(model: type[BaseModel], name: str) -> TypeAdapter[Any]:
    """Return what reads one entry of a model."""
    field = model.model_fields[name]
    read: Any = Annotated[field.annotation, *field.metadata] if field.metadata else field.annotation
    return TypeAdapter(read)


def faults(key: str, error: ValidationError) -> list[str]:
    """Return a sentence for each error that pydantic found.

    Parameters
    ----------
    key : str
        Where the mapping is in the config; nothing for the whole config.
    error : pydantic.ValidationError
    """
    found = []
    for one in error.errors(include_url=False):
        *way, last = one["loc"] or ("",)
        if one["type"] == "missing":
            found.append(f"{_place(key, way)} lacks the key {last!r}")
        elif one["type"] == "extra_forbidden":
            found.append(one["input"].says.replace(HERE, _place(key, way)))
        else:
            found += [fault.replace(HERE, _place(key, one["loc"])) for fault in one["ctx"]["error"].faults]
    return found


def _place(key: str, way: Iterable[Any]) -> str:
    named = [part for part in way if not str(part).startswith(HERE)]  # without the kinds of an entry
    path = "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in named)
    return f"{key}{path}".lstrip(".") or "config"


@dataclass(frozen=True)
class Catalogue(Rule):
    """A mapping of entries whose names are free.

    Parameters
    ----------
    least : int
        Fewest entries, 0 or 1.
    reserved : str
        A name that no entry may have.
    """

    least: int = 1
    reserved: str = ""

    def check(self, key: str, value: Any) -> dict[str, Any]:
        """Return a mapping by words; its entries are left to their own model."""
        if not isinstance(value, Mapping) or len(value) < self.least:
            wanted = "at least one entry by name" if self.least else "entries by name, or {} for none"
            raise InvalidInput(f"{key} is {shown(value)}, but must hold {wanted}")
        for name in value:
            if Word().check(f"name in {key}", name) == self.reserved:
                raise InvalidInput(f"{key} has {name!r}, which names the campaign itself; give another name")
        return dict(value)

    def _schema(self) -> dict[str, Any]:
        return ({"minProperties": self.least} if self.least else {}) | {"propertyNames": Word().schema()}

    def __get_pydantic_core_schema__(self, source: Any, handler: Any) -> Any:
        from pydantic_core import core_schema

        return core_schema.no_info_before_validator_function(lambda value: self.check(HERE, value), handler(source))

    def __get_pydantic_json_schema__(self, core: Any, handler: Any) -> dict[str, Any]:
        return self.schema() | handler(core)


@dataclass(frozen=True)
class Scales(Catalogue):
    """A list of at least one scale of a road."""

    def check(self, key: str, value: Any) -> Any:
        """Return the list; its entries are left to their own model."""
        if not isinstance(value, (list, tuple)) or not value:
            raise InvalidInput(f"{key} is {shown(value)}, but must be a list of at least one scale")
        return value

    def _schema(self) -> dict[str, Any]:
        return {"minItems": 1}


@dataclass(frozen=True)
class Named(Word):
    """The name of an entry elsewhere in the config, which is looked up when the whole config has been read.

    Parameters
    ----------
    several : bool
        Whether a list of names will do as well.
    """

    several: bool = False

    def check(self, key: str, value: Any) -> Any:
        """Return ``value`` as it is; a list as a tuple."""
        listed = self.several and isinstance(value, (list, tuple))
        return Items("", Word(), ascending=False).check(key, value) if listed else value

    def _schema(self) -> dict[str, Any]:
        word = super()._schema()
        listed = {"type": "array", "minItems": 1, "uniqueItems": True, "items": word}
        return {"anyOf": [word, listed]} if self.several else word


def gathered(read: Callable[[Any], Any], given: Iterable[Any]) -> list[Any]:
    """Return what is read of each of some values.

    Parameters
    ----------
    read : callable
    given : iterable

    Raises
    ------
    InvalidInput
        The faults of all, each once.
    """
    found: list[Any] = []
    faulty: list[str] = []
    for one in given:
        try:
            found.append(read(one))
        except InvalidInput as error:
            faulty += error.faults
    if faulty:
        raise InvalidInput(*dict.fromkeys(faulty))
    return found


def names(value: Any) -> tuple[Any, ...]:
    """Return the names of a key that may have one or a list of them."""
    return tuple(value) if isinstance(value, (list, tuple)) else (value,)


def keys(source: type, names: Iterable[str], defaults: Mapping[str, Any] = MappingProxyType({})) -> dict[str, Any]:
    """Return keys with the rules of a dataclass, for ``pydantic.create_model``.

    Parameters
    ----------
    source : type
        The dataclass.
    names : iterable of str
        The fields to take.
    defaults : mapping
        Defaults of keys that may be left out, by name; the others are required.
    """
    return {name: (Annotated[Any, rules(source)[name]], defaults.get(name, ...)) for name in names}


def grid_values(about: str, unit: str = "") -> Items:
    """Return the rule of a list of positive numbers, no two alike.

    Parameters
    ----------
    about : str
        What the key means.
    unit : str
        Nothing for dimensionless numbers.
    """
    return Items(about, Number(unit=unit))
