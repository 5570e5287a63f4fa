"""`SceneProduct`: scenes of any kind over axes of your own, such as the period of a rack or the clearance of stops."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any, Final, overload

import numpy as np
import polars as pl

from seismass.base.errors import InvalidOption, InvalidScene
from seismass.base.values import as_list, brief, refusal, short
from seismass.base.views import Card
from seismass.model.scene import Scene

MOST_SCENES: Final = 10**6
"""Most scenes of a product; each is an object, which a `Grid` does without."""


class SceneProduct(Card, Sequence[Scene]):
    """Every combination of the values of axes, each made a scene by a function.

    It is a sequence of scenes, so that `simulate_many`, `stream_many` and `write_many` take it. A `Grid` holds columns
    alone and is for shear buildings with goods on their floors; here a function makes whatever a scene may have: racks,
    walls, stops, a base.

    Parameters
    ----------
    make : callable
        Takes a value of every axis by its name and returns a Scene.
    **axes : iterable
        Values of each axis; the last axis changes fastest.

    Attributes
    ----------
    axes : dict of str to tuple
        As given.

    Raises
    ------
    InvalidOption
        There is no axis, an axis has no values, `make` cannot be called, or there are more than a million scenes.
    InvalidScene
        `make` does not return a Scene; the error names the scene, from 1, and its values.

    Examples
    --------
    >>> import seismass as sm
    >>> building = sm.Building.uniform(2, 0.4, mass=1e5, yield_shear_over_weight=[0.3, 0.2])
    >>> def racked(period, levels):
    ...     goods = [sm.RackBlock(level, mass=2e4, mu=0.37) for level in range(1, levels + 1)]
    ...     return sm.Scene(building, racks=[sm.Rack(1, levels, period=period, level_mass=1e3, blocks=goods)])
    >>> scenes = sm.runs.SceneProduct(racked, period=[0.3, 0.6, 1.2], levels=[2, 3])
    >>> len(scenes)
    6
    >>> scenes.table().rows()[:3]
    [(1, 0.3, 2), (2, 0.3, 3), (3, 0.6, 2)]
    """

    def __init__(self, make: Callable[..., Scene], **axes: Iterable[Any]) -> None:
        if not callable(make):
            raise refusal(InvalidOption, "make", "scene product", "a callable that returns a Scene", brief(make))
        if not axes:
            raise refusal(InvalidOption, "axes", "scene product", "given by name, at least one", "none")
        self.axes: dict[str, tuple[Any, ...]] = {}
        for name, values in axes.items():
            listed = as_list(values, f"axis {name}", "scene product", InvalidOption, "a list of values")
            self.axes[name] = tuple(value.item() if isinstance(value, np.generic) else value for value in listed)
            if not self.axes[name]:
                raise refusal(InvalidOption, f"axis {name}", "scene product", "at least one value", "none")
        self._shape = tuple(len(values) for values in self.axes.values())
        total = int(np.prod([float(length) for length in self._shape]))
        if total > MOST_SCENES:
            raise refusal(InvalidOption, "scenes", "scene product", f"at most {MOST_SCENES}", f"{total}")
        self._make = make
        self._scenes: dict[int, Scene] = {}

    def __repr__(self) -> str:
        listed = ", ".join(f"{len(values)} of {name}" for name, values in self.axes.items())
        return f"SceneProduct({len(self)} scenes: {listed})"

    def __len__(self) -> int:
        return int(np.prod(self._shape))

    def values_of(self, number: int) -> dict[str, Any]:
        """Return the values of the axes of a scene, by its number from 1."""
        places = np.unravel_index(number - 1, self._shape)
        return {name: values[int(place)] for (name, values), place in zip(self.axes.items(), places, strict=True)}

    @overload
    def __getitem__(self, index: int) -> Scene: ...
    @overload
    def __getitem__(self, index: slice) -> list[Scene]: ...
    def __getitem__(self, index: int | slice) -> Scene | list[Scene]:
        if isinstance(index, slice):
            return [self._scene(place) for place in range(*index.indices(len(self)))]
        place = index + len(self) if index < 0 else index
        if not 0 <= place < len(self):
            raise IndexError("scene product index out of range")
        return self._scene(place)

    def __iter__(self) -> Iterator[Scene]:
        return (self._scene(place) for place in range(len(self)))

    def _scene(self, place: int) -> Scene:
        if place not in self._scenes:
            values = self.values_of(place + 1)
            made: Any = self._make(**values)
            if not isinstance(made, Scene):
                words = short(", ".join(f"{name} = {value!r}" for name, value in values.items()))
                requirement = "a Scene, as the function has to return it"
                raise refusal(InvalidScene, f"scene {place + 1} ({words})", "scene product", requirement, brief(made))
            self._scenes[place] = made
        return self._scenes[place]

    def table(self) -> pl.DataFrame:
        """Return one row per scene: `scene`, from 1, and the value of every axis; it joins to the rows of a batch.

        Values that are neither numbers, text nor truth values stand as their text.
        """
        rows = np.stack(np.unravel_index(np.arange(len(self)), self._shape), axis=1)
        columns: dict[str, Any] = {"scene": np.arange(1, len(self) + 1, dtype=np.uint64)}
        for axis, (name, values) in enumerate(self.axes.items()):
            plain = all(isinstance(value, bool | int | float | str) for value in values)
            shown = values if plain else tuple(repr(value) for value in values)
            columns[name] = [shown[place] for place in rows[:, axis].tolist()]
        return pl.DataFrame(columns, strict=False)
