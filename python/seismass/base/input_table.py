"""Files of TOML or JSON as tables of keys, of which every one is known or refused with its place in the file."""

from __future__ import annotations

import hashlib
import json
import math
import re
import tomllib
from collections.abc import Callable, Collection, Iterable
from pathlib import Path
from typing import Any, Final, NamedTuple, NoReturn

from seismass.base.errors import InvalidScene, SeismassError, did_you_mean
from seismass.base.files import read_file
from seismass.base.limits import MOST_BYTES, MOST_KEY_PARTS, MOST_LETTERS, MOST_TOML
from seismass.base.values import FloatArray, as_array, as_count, as_number, brief, refusal, short

_WORD: Final = r"""(?:[\w-]++|"[^"\n]*+"|'[^'\n]*+')"""
_LONG_KEY: Final = re.compile(
    rf"(?:^|[{{\[,])[ \t]*+{_WORD}(?:[ \t]*+\.[ \t]*+{_WORD}){{{MOST_KEY_PARTS}}}", re.MULTILINE
)
"""A key can begin a line, a table's name or an entry of a table."""


def load_table(source: Path, what: str, kind: type[SeismassError]) -> Table:
    """Return a file of TOML or JSON, by its suffix, as a table of its keys. `what` names it in errors of the class
    `kind`; it is a regular file of at most `MOST_BYTES` (TOML: `MOST_TOML`).
    """
    suffix = source.suffix.lower()
    if source.is_dir():
        raise kind(f"{what} must be a file that can be read; got {source} (Is a directory)")
    if suffix not in (".toml", ".json"):
        raise refusal(kind, "suffix", f"{what} {source.name}", ".toml or .json", brief(suffix))
    try:
        content = read_file(source, MOST_TOML if suffix == ".toml" else MOST_BYTES)
        text = content.decode("utf-8-sig")
        loaded = _toml(text) if suffix == ".toml" else json.loads(text, object_pairs_hook=_without_repeats)
    except OSError as error:
        raise kind(f"{what} must be a file that can be read; got {source} ({error.strerror or error})") from error
    except (ValueError, RecursionError) as error:
        form = suffix[1:].upper()
        raise refusal(kind, "content", source.name, f"valid {form}", str(error)) from error
    except _RepeatedKey as error:
        raise refusal(kind, short(str(error)), source.name, "given once", "it twice") from None
    if not isinstance(loaded, dict):
        raise refusal(kind, "content", source.name, "a table of keys", brief(loaded))
    table = Table(loaded, "", source.name, kind)
    table.sha256 = hashlib.sha256(content).hexdigest()
    return table


def _toml(text: str) -> dict[str, Any]:
    if _LONG_KEY.search(text):
        raise ValueError(f"a key of more than {MOST_KEY_PARTS} parts between dots")
    return tomllib.loads(text)


class _RepeatedKey(Exception):
    """A key that a JSON object has twice, of which Python would keep the last."""


def _without_repeats(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    table = dict(pairs)
    if len(table) < len(pairs):
        seen = set()
        for key, _ in pairs:
            if key in seen:
                raise _RepeatedKey(key)
            seen.add(key)
    return table


class Need(NamedTuple):
    """What a number must be, in words, and whether one is."""

    requirement: str
    fits: Callable[[float], bool]


FINITE: Final = Need("a finite number", math.isfinite)
POSITIVE: Final = Need("a positive number", lambda number: 0.0 < number < math.inf)
NOT_NEGATIVE: Final = Need("finite and not negative", lambda number: 0.0 <= number < math.inf)
SHARE: Final = Need("from 0 to 1", lambda number: 0.0 <= number <= 1.0)


class Table:
    """A table of the file, with its place in it for messages. Null stands for an absent key, except for `nullable`."""

    def __init__(
        self, values: dict[str, Any], place: str, file: str, kind: type[SeismassError], nullable: Iterable[str] = ()
    ) -> None:
        allowed = set(nullable)
        self.values = {key: value for key, value in values.items() if value is not None or key in allowed}
        self._all_keys = tuple(values)
        self.sha256 = ""  # of a whole file
        self.place = place
        self.file = file
        self._kind = kind

    def key(self, key: str) -> str:
        """Where a key stands: building.damping.ratio."""
        shown = short(key)
        return f"{self.place}.{shown}" if self.place else shown

    def refuse(self, key: str, requirement: str, got: str) -> NoReturn:
        """Raise the error of the one form."""
        raise refusal(self._kind, self.key(key), self.file, requirement, got)

    def known(self, keys: tuple[str, ...], also: Collection[str] = ()) -> None:
        """Refuse every other key; those that are `also` taken are not proposed."""
        for key in self._all_keys:
            if key not in keys and key not in also:
                hint = did_you_mean(key, keys, shown=self.key)
                self.refuse(key, f"one of the keys {', '.join(keys)}{hint}", "an unknown key")

    def subset(self, *keys: str) -> dict[str, Any]:
        """Return the values of those of the keys that are there."""
        return {key: self.values[key] for key in keys if key in self.values}

    def excluded(self, key: str, *others: str) -> None:
        """Refuse a key beside others that say the same."""
        for other in others:
            if key in self.values and other in self.values:
                self.refuse(key, f"left out where {self.key(other)} is given", "both")

    def empty(self, where: str) -> None:
        """Refuse every key."""
        for key, value in self.values.items():
            self.refuse(key, f"left out where {where}", brief(value))

    def needed(self, *keys: str) -> None:
        """Refuse a table in which none of the keys is."""
        if not any(key in self.values for key in keys):
            self.refuse(keys[0], "given" + "".join(f", or {self.key(key)}" for key in keys[1:]), "nothing")

    def one_of(self, *keys: str) -> None:
        """Refuse two of the keys beside each other."""
        for number, key in enumerate(keys, start=1):
            self.excluded(key, *keys[number:])

    def left_out(self, keys: Iterable[str], where: str, got: str | None = None) -> None:
        """Refuse each of the keys; the message shows its value unless `got` is given."""
        for key, value in self.subset(*keys).items():
            self.refuse(key, f"left out where {where}", got or brief(value))

    def refuse_as(self, key: str, error: SeismassError) -> NoReturn:
        """Raise what another part of the package refused as the error of a key."""
        self.refuse(key, str(error).partition(" must be ")[2].rpartition("; got ")[0], brief(self.values.get(key)))

    def table(self, key: str, nullable: Iterable[str] = ()) -> Table:
        """Return the table under a key."""
        value = self.values[key]
        if not isinstance(value, dict):
            self.refuse(key, "a table of keys", brief(value))
        return Table(value, self.key(key), self.file, self._kind, nullable)

    def tables(self, key: str) -> list[Table]:
        """Return the tables of a list; none where the key is absent."""
        value = self.values.get(key, [])
        if not isinstance(value, list):
            self.refuse(key, "a list of tables", brief(value))
        tables = []
        for number, item in enumerate(value, start=1):
            if not isinstance(item, dict):
                self.refuse(f"{key}[{number}]", "a table of keys", brief(item))
            tables.append(Table(item, self.key(f"{key}[{number}]"), self.file, self._kind))
        return tables

    def text(self, key: str) -> str:
        """Return a text; empty where the key is absent."""
        value = self.values.get(key, "")
        if not isinstance(value, str) or "\0" in value:
            self.refuse(key, "text", brief(value))
        if len(value) > MOST_LETTERS:
            self.refuse(key, f"text of at most {MOST_LETTERS} letters", brief(value))
        return value

    def per_storey(self, key: str) -> FloatArray | None:
        """Return one number or a list of them."""
        value = self.values.get(key)
        return None if value is None else as_array(value, self.key(key), self.file, InvalidScene, or_number=True)

    def number(self, key: str, default: float = math.nan, need: Need | None = None) -> float:
        """Return a number, or the default where the key is absent; one that is not what is needed is refused."""
        number = as_number(self.values.get(key, default), self.key(key), self.file, self._kind)
        if need is not None and not need.fits(number):
            self.refuse(key, need.requirement, f"{number:g}")
        return number

    def count(self, key: str, *, least: int = 0) -> int:
        """Return a whole number."""
        return as_count(self.values[key], self.key(key), self.file, self._kind, least=least)

    def flag(self, key: str, default: bool) -> bool:
        """Return true or false, or the default where the key is absent."""
        value = self.values.get(key, default)
        if not isinstance(value, bool):
            self.refuse(key, "true or false", brief(value))
        return value

    def choice(self, key: str, names: Iterable[str], default: str | None = None, requirement: str = "") -> str:
        """Return one of some words, or the default where the key is absent."""
        value, known = self.values.get(key, default), tuple(names)
        if not isinstance(value, str) or value not in known:
            got = "nothing" if value is None else brief(value)
            self.refuse(key, requirement or f"one of {', '.join(known)}", got)
        return value


BUILDING_FILE: Final = "building file"
SCENE_FILE: Final = "scene file"
CAMPAIGN_FILE: Final = "campaign file"
TABLES: Final = {
    BUILDING_FILE: ("site", "goods", "storeys", "code"),
    CAMPAIGN_FILE: ("grid", "sample", "motions"),
    SCENE_FILE: ("blocks", "racks", "motion", "vertical_motion", "initial"),
}
"""Tables of each kind that files of the other kinds do not have."""
COMMANDS: Final = {
    BUILDING_FILE: "`seismass building`, `animate`, `slip`, `fragility` and `risk`",
    CAMPAIGN_FILE: "`seismass campaign`",
    SCENE_FILE: "`seismass run`, `animate`, `slip`, `fragility` and `risk`",
}
"""Commands that take a file of each kind."""


def kind_of(values: dict[str, Any]) -> str:
    """Return which kind of file has these tables; empty where none or several kinds have them."""
    kinds = [kind for kind, names in TABLES.items() if any(name in values for name in names)]
    return kinds[0] if len(kinds) == 1 else ""


def refuse_other_kind(top: Table, kind: str) -> None:
    """Refuse a file whose tables are those of another kind than `kind`, and name the commands that take it."""
    actual = kind_of(top.values)
    if actual and actual != kind:
        top.refuse("kind", f"a {kind}", f"a {actual}, which {COMMANDS[actual]} take{'s' * (actual == CAMPAIGN_FILE)}")
