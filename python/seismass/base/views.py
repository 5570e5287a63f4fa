"""How a value shows itself: declared on its class, made by a function of a higher layer, found in one table.

A class declares a view with its signature, types and docstring::

    @view
    def plot(self, codes: Mapping[str, float] | None = None) -> Figure:
        '''Return the figure.'''
        raise NotImplementedError

The module that `made_in` names has a table `VIEWS`, from "Class.plot" to "module:function"; a class that is not in it
has the view of its base. The function takes the value and the same arguments, and its module is imported when the view
is first asked for. Nothing hangs on an instance, so that pickles, slots and equality are those of the class. Views
show; numbers are never made by one.
"""

from __future__ import annotations

import importlib
from collections.abc import Callable, Mapping
from functools import cache, wraps
from typing import Any, ParamSpec, TypeVar

P = ParamSpec("P")
T = TypeVar("T")

_tables: list[str] = []


def made_in(module: str) -> None:
    """State the module whose table `VIEWS` says what makes each view."""
    _tables[:] = [module]


@cache
def maker_of(kind: Any, name: str) -> Callable[..., Any]:
    """Return the function that makes a view of a class, as `plot` of `EffectiveMass`: its own, or that of the first of
    its bases that has one.
    """
    views: Mapping[str, str] = importlib.import_module(_tables[0]).VIEWS
    place = next(views[key] for base in kind.__mro__ if (key := f"{base.__name__}.{name}") in views)
    module, _, function = place.partition(":")
    maker: Callable[..., Any] = getattr(importlib.import_module(module), function)
    return maker


def view(declaration: Callable[P, T]) -> Callable[P, T]:
    """Declare a method that a function of a higher layer makes; the body of the declaration is never run."""
    name = declaration.__name__

    @wraps(declaration)
    def shown(*args: P.args, **kwargs: P.kwargs) -> T:
        value: Any = args[0]
        presented = value._shown if isinstance(value, Views) else value
        kind: Any = type(value)
        made: T = maker_of(kind, name)(presented, *args[1:], **kwargs)
        return made

    shown.__dict__["declares_view"] = True
    return shown


class Card:
    """A value that has a card in notebooks, made of its text, its table or its numbers."""

    __slots__ = ()

    @view
    def _repr_html_(self) -> str:
        raise NotImplementedError


class Views:
    """Several views of one value under one name, as `response.plot.drift()`; a subclass declares them."""

    __slots__ = ("_shown",)

    def __init__(self, shown: Any) -> None:
        self._shown = shown

    def __repr__(self) -> str:
        return f"<views of {self._shown!r}>"
