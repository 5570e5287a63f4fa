"""How a value shows itself: declared on its class, made by a function of a higher layer, found in one table.

A class declares a view with its signature, types and docstring::

    @view
    def plot(self, codes: Mapping[str, float] | None = None) -> Figure:
        '''Return the figure.'''
        raise NotImplementedError

The module that `made_in` names has a table `VIEWS`, from "Class.plot" to "module:function". The function takes the
value and the same arguments, and its module is imported when the view is first asked for. Nothing hangs on an instance,
so that pickles, slots and equality are those of the class. Views show; numbers are never made by one.
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
def maker_of(name: str) -> Callable[..., Any]:
    """Return the function that makes a view, by the name of its declaration, as "EffectiveMass.plot"."""
    views: Mapping[str, str] = importlib.import_module(_tables[0]).VIEWS
    module, _, function = views[name].partition(":")
    maker: Callable[..., Any] = getattr(importlib.import_module(module), function)
    return maker


def view(declaration: Callable[P, T]) -> Callable[P, T]:
    """Declare a method that a function of a higher layer makes; the body of the declaration is never run."""
    name = declaration.__qualname__

    @wraps(declaration)
    def shown(*args: P.args, **kwargs: P.kwargs) -> T:
        value = args[0]
        presented = value._shown if isinstance(value, Views) else value
        made: T = maker_of(name)(presented, *args[1:], **kwargs)
        return made

    shown.__dict__["declares_view"] = name
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
