"""Tables by name whose errors list the known names."""

from __future__ import annotations

from typing import Any, Iterable, Mapping, NoReturn, Union

from . import _native


class Named(dict):  # type: ignore[type-arg]
    """A dictionary by names. An unknown name is an error that lists the known ones, the most similar one first."""

    def __init__(self, what: str, items: Union[Mapping[str, Any], Iterable[tuple[str, Any]]] = ()) -> None:
        super().__init__(items)
        self._what = what

    def __missing__(self, name: Any) -> NoReturn:
        unknown(self._what, name, self)

    def __reduce__(self) -> Any:
        return (Named, (self._what, dict(self)))


def unknown(what: str, name: Any, known: Iterable[str]) -> NoReturn:
    """Raises `kin.UnknownName` for a name that is none of the known ones."""
    if not isinstance(name, str):
        raise TypeError(f"a {what} is found by its name, a text, not by {name!r}")
    _native.unknown(what, name, list(known))
