"""The quantities of a response, each in one row, from which properties, their docstrings and documents are made."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, Final, Generic, NamedTuple, TypedDict, TypeVar

import numpy as np

from seismass.base.errors import InvalidOption, SeismassError
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray, frozen, refusal
from seismass.motions.motion import Motion
from seismass.motions.records.intensity import integrals

T = TypeVar("T")


class Quantity(NamedTuple):
    """Unit, places that have it (empty: one number), meaning, and the name of its history in the kernel."""

    unit: str
    places: str
    meaning: str
    stored: str = ""


QUANTITIES: Final = {
    "drift": Quantity("m", "storeys", "drift of each storey"),
    "slip": Quantity("m", "blocks", "slip of each block, its displacement minus that of what carries it"),
    "floor_displacement": Quantity("m", "storeys", "displacement of each floor relative to the ground"),
    "floor_velocity": Quantity("m/s", "storeys", "velocity of each floor relative to the ground"),
    "floor_acceleration": Quantity("m/s2", "storeys", "absolute acceleration of each floor"),
    "block_velocity": Quantity("m/s", "blocks", "velocity of each block relative to the ground"),
    "storey_shear": Quantity(
        "N", "storeys", "spring force of each storey, without damping and P-Delta", "storey_force"
    ),
    "floor_force": Quantity("N", "storeys", "force of each floor, of its mass and of the friction of the goods on it"),
    "base_shear": Quantity("N", "", "shear of storey 1, with the share of a stiffness matrix"),
    "rack_drift": Quantity("m", "levels", "drift of the levels of each rack, from the level below or the floor"),
    "rack_velocity": Quantity("m/s", "levels", "velocity of the levels of each rack relative to the ground"),
    "rack_acceleration": Quantity("m/s2", "levels", "absolute acceleration of the levels of each rack"),
    "rack_shear": Quantity("N", "levels", "spring force of the levels of each rack, without damping", "rack_force"),
    "contact_force": Quantity("N", "blocks", "force of each block on its stops, zero without stops"),
    "contact_velocity": Quantity("m/s", "blocks", "relative velocity at which each block comes to its stops"),
    "slip_path": Quantity("m", "blocks", "path slipped by each block, by the chain engine also in the air"),
    "base_slip_path": Quantity("m", "", "path slipped by the slab in contact with the ground"),
    "base_slip": Quantity("m", "", "slip of the slab on the ground"),
    "base_velocity": Quantity("m/s", "", "velocity of the slab relative to the ground"),
    "base_acceleration": Quantity(
        "m/s2", "", "absolute acceleration of the slab, in peaks both one-sided limits of jumps"
    ),
    "ground_acceleration": Quantity("m/s2", "", "acceleration of the ground"),
    "ground_velocity": Quantity("m/s", "", "velocity of the ground"),
    "ground_displacement": Quantity("m", "", "displacement of the ground"),
}
"""Histories have the name of their quantity; peaks `peak_` before it, values at the end `residual_`, and the time of a
peak `_time` behind it."""


SHOWN: Final = {"m": ("mm", 1e3), "N": ("kN", 1e-3), "m/s2": ("g", 1.0 / STANDARD_GRAVITY)}
"""The unit in which figures have what is in a unit of SI, and the factor to it."""


def unit_of(column: str) -> str:
    """Return the unit of a peak, of a value at the end or of a time in tables; empty for what has none."""
    row = QUANTITIES.get(column.removeprefix("peak_").removeprefix("residual_").removesuffix("_time"))
    if column.endswith("_time"):
        return "s" if row is not None or column == "end_time" else ""
    return "" if row is None else row.unit


class Statistics(TypedDict):
    """The work that a run took, and what it could leave out; the same for any number of threads."""

    intervals: int
    """Sample intervals solved."""
    substeps: int
    """Equal parts that each of them was solved in: more than one where the building is stiff."""
    plain_steps: int
    """Steps by a propagator that were proved free of events by bounds alone."""
    series_steps: int
    """Steps for which a Taylor series was formed, plain steps inside which a peak is beaten among them."""
    guards_isolated: int
    """Guards and peaks looked at with Bernstein polynomials."""
    events: int
    """Events of all kinds."""
    regimes: int
    """Different regimes entered."""
    regime_hits: int
    """Changes into a regime that the run already knew."""
    skipped_elastic_storeys: int
    """Storeys that cannot yield."""
    skipped_bare_floors: int
    """Floors without a block."""
    skipped_head_samples: int
    """Samples at the head that are zero, with everything at rest."""
    skipped_tail_samples: int
    """Samples at the tail where no peak could be beaten."""
    instructions: str
    """Instruction set in use, as `instruction_set` names it."""


def sentence_of(name: str, shape: str = "") -> str:
    """The docstring of a property of that name: what it is, its unit and its shape."""
    plain = name.removeprefix("peak_").removeprefix("residual_").removesuffix("_time")
    quantity, unit = QUANTITIES[plain], "s" if name.endswith("_time") else QUANTITIES[plain].unit
    words = quantity.meaning
    if name.startswith("peak_"):
        words = f"largest {'' if words.startswith('absolute') else 'absolute '}{words}"
    if name.endswith("_time"):
        words = f"when the {words} was first reached"
    if name.startswith("residual_"):
        words = f"residual {words}"
    return f"{words[0].upper()}{words[1:]} ({unit}){f', shape ({shape})' if shape else ''}."


class Values(property, Generic[T]):
    """A property that reads the quantity of its name by a method of its class; its shape is axes before the places of
    the quantity, these, and axes after them.
    """

    def __init__(self, method: str, before: str = "", after: str = "") -> None:
        super().__init__(lambda response: getattr(response, method)(self.name))
        self.method, self.axes, self.name = method, (before, after), ""

    def __set_name__(self, owner: type, name: str) -> None:
        plain = name.removeprefix("peak_").removeprefix("residual_").removesuffix("_time")
        before, after = self.axes
        axes = [axis for axis in (before, QUANTITIES[plain].places, after) if axis]
        self.name, self.__doc__ = name, sentence_of(name, ", ".join(axes) + "," * (len(axes) == 1))

    if TYPE_CHECKING:

        def __get__(self, response: Any, owner: type | None = None) -> T: ...  # type: ignore[override]


def names_read_by(kind: type, method: str) -> tuple[str, ...]:
    """Names of the quantities that a class reads by a method, in the order of the class."""
    return tuple(name for name, member in vars(kind).items() if isinstance(member, Values) and member.method == method)


def events_of(response: Any) -> list[dict[str, Any]]:
    """The events of a response as its document has them, without what is null."""
    rows = response.events.iter_rows(named=True)
    return [{key: value for key, value in event.items() if value is not None} for event in rows]


class Numbers:
    """What responses in one and in two directions have alike."""

    __slots__ = ()

    def to_dict(self) -> dict[str, Any]:
        """Return the numbers of the response."""
        raise NotImplementedError

    def to_json(self) -> str:
        """Return `to_dict` as JSON."""
        return json.dumps(self.to_dict(), indent=2, allow_nan=False)


def of_chains_alone(owner: str = "simulate", got: str = "True") -> SeismassError:
    """The error of floor forces that are asked for where another engine than that of chains of storeys solves."""
    requirement = "left out with racks, stops, a stiffness matrix, a sliding base and two directions"
    return refusal(InvalidOption, "floor_force", owner, requirement, got)


def ground_motion(motion: Motion, name: str, rows: int, every: int) -> FloatArray:
    """Acceleration, velocity or displacement of the ground, from rest, at the rows of histories, shape (rows,)."""
    values = {"ground_acceleration": motion.acceleration}
    if name not in values:
        values["ground_velocity"], values["ground_displacement"] = integrals(motion.acceleration, motion.dt)
    return frozen(values[name][::every][:rows])


def floor_displacement(drift: FloatArray, base_slip: FloatArray | None) -> FloatArray:
    """Displacement of floors relative to the ground, of drifts along axis 1 and the slip of a sliding base."""
    above = np.cumsum(drift, axis=1)
    return frozen(above if base_slip is None else above + base_slip[:, None])
