"""One digest of inputs: the SHA-256 of the bytes of all that numbers depend on, formed from the fields of values."""

from __future__ import annotations

import dataclasses
import hashlib
import struct
from collections.abc import Iterable, Iterator, Mapping
from typing import Any, Final

import numpy as np

from seismass import _kernel
from seismass.base.values import Value

LABELS: Final = frozenset({"file_sha256", "name", "note", "path", "project", "sources", "units"})
"""Fields that no number depends on: what something is called, which file and keys state it, and how it is shown."""


def inputs_digest(*inputs: Any) -> str:
    """Return the SHA-256 of values: numbers by all their bits, objects by all their fields but labels. 0.0 and -0.0 are
    equal. An object that has no fields is a TypeError.
    """
    digest = hashlib.sha256()
    for part in _parts(inputs):
        digest.update(part)
    return digest.hexdigest()


def motion_contents(motions: Iterable[Any]) -> list[tuple[Any, ...]]:
    """Return what numbers depend on of records or motions: time step and samples, the vertical ones too."""
    return [(motion.dt, motion.acceleration, motion.vertical) for motion in motions]


def fields_of(value: Any) -> dict[str, Any] | None:
    """Return the fields of an object of the package, except labels and what a `Value` derives; None of others."""
    if isinstance(value, type):
        return None
    if dataclasses.is_dataclass(value):
        names = [field.name for field in dataclasses.fields(value)]
    elif type(value).__module__.startswith("seismass."):
        names = [name for kind in type(value).__mro__ for name in getattr(kind, "__slots__", ())]
    else:
        return None
    if isinstance(value, Value):
        names = [name for name in names if name[0] != "_"]
    return {name: getattr(value, name) for name in names if name not in LABELS}


def _parts(value: Any) -> Iterator[bytes]:
    """Yield the bytes of a value behind its kind and size, so that no two different values give the same bytes."""
    if isinstance(value, bool | np.bool_):
        yield b"b1" if value else b"b0"
    elif value is None:
        yield b"none"
    elif isinstance(value, int | np.integer):
        yield f"i{int(value)};".encode()
    elif isinstance(value, float | np.floating):
        yield b"f" + struct.pack("<d", float(value) + 0.0)
    elif isinstance(value, str | bytes):
        content = value.encode("utf-8", "surrogatepass") if isinstance(value, str) else value
        yield f"{type(value).__name__}{len(content)};".encode() + content
    elif isinstance(value, np.ndarray):
        array = value + 0.0 if value.dtype.kind == "f" else value
        array = np.ascontiguousarray(array, dtype=value.dtype.newbyteorder("<"))
        yield f"a{array.dtype.str}{value.shape};".encode() + array.tobytes()
    elif isinstance(value, Mapping):
        yield f"m{len(value)};".encode()
        for name in sorted(value):
            yield from _parts(name)
            yield from _parts(value[name])
    elif (fields := fields_of(value)) is not None:
        yield f"{type(value).__name__};".encode()
        yield from _parts(fields)
    elif isinstance(value, Iterable):
        items = list(value)
        yield f"l{len(items)};".encode()
        for item in items:
            yield from _parts(item)
    else:
        raise TypeError(f"no digest of a {type(value).__name__}")


def metadata_head(schema: int, *inputs: Any) -> dict[str, Any]:
    """What the metadata of a result begins with: versions, the instruction set, and the digest of inputs if any."""
    head = {"schema_version": schema, "package_version": _kernel.VERSION, "instructions": _kernel.instruction_set()}
    return head | ({"inputs_sha256": inputs_digest(*inputs)} if inputs else {})
