"""What a model of the config is made of: entries with keys of their own, and entries by name."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Annotated, Any, Self

from pydantic import BaseModel, ConfigDict, ValidationError, model_validator

from rubfric.checks import known_keys, shown
from rubfric.errors import InvalidInput
from rubfric.rules import HERE, Rule, Word, rules


class Entry(BaseModel):
    """A mapping of the config with keys of its own."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    @model_validator(mode="before")
    @classmethod
    def _known(cls, given: Any) -> Any:
        if isinstance(given, cls):
            return given
        required = [name for name, field in cls.model_fields.items() if field.is_required()]
        return dict(known_keys(HERE, given, cls.model_fields, required))

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
            One sentence on the first wrong entry, in the order of the keys.
        """
        try:
            return cls.model_validate(given)
        except ValidationError as error:
            first = error.errors(include_url=False, include_input=False)[0]
            path = "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in first["loc"])
            at = f"{key}{path}".lstrip(".") or "config"
            raise InvalidInput(str(first["ctx"]["error"]).replace(HERE, at)) from None

    def given(self) -> dict[str, Any]:
        """Return the entries that were given, without the defaults of others."""
        return self.model_dump(exclude_unset=True)


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
    """The name of an entry elsewhere in the config, which is looked up when the whole config has been read."""

    def check(self, key: str, value: Any) -> Any:
        """Return ``value`` as it is."""
        return value


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
