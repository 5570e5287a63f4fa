"""What pages share: the words of a page stay in docs, and numbers, tables, blocks and figures are put into it.

A module of this folder is a page of docs with the same name. Its `fill` puts in what the page says; what it returns is
for tests. `Page`, `with_text` and `table` serve benchmarks that write a part of a page too.
"""

from __future__ import annotations

import os
import re
from collections import Counter
from collections.abc import Callable, Iterable
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import Any, Final

from matplotlib.figure import Figure

from seismass.base.files import write_file
from seismass.media.svg import figure_content

ROOT: Final = Path(__file__).parents[2]
FIGURES: Final = ROOT / "docs" / "figures"
FIELD: Final = r"((?:(?!\n\n).)+?)"
"""What stands in a page for {}: some text of one paragraph."""


class NoRecordings(LookupError):
    """A page needs recordings that are not part of this project."""


def names() -> list[str]:
    """Return the names of all pages."""
    return sorted(file.stem for file in Path(__file__).parent.glob("*.py") if file.stem not in ("__main__", "parts"))


def made(name: str, *parts: str) -> tuple[Page, Any]:
    """Make a page, with those of its parts that take minutes and are named, and what its module returns.

    Raises
    ------
    SystemExit
        The page has no such part, or no place for what is made.
    NoRecordings
        It needs recordings.
    """
    module = import_module(f"pages.{name}")
    page = Page(ROOT / getattr(module, "FILE", f"docs/{name}.md"), parts)
    found = module.fill(page)
    page.finish()
    return page, found


def table(header: str | list[str], rows: Iterable[Iterable[object]], left: int | None = None) -> str:
    """Return a table in Markdown; `left` columns are of words and the others of numbers, by default all of words."""
    heads = header.split(" | ") if isinstance(header, str) else header
    rules = ["---" if left is None or place < left else "---:" for place in range(len(heads))]
    return "\n".join(f"| {' | '.join(map(str, cells))} |" for cells in (heads, rules, *rows))


def with_text(page: str, key: str, text: str) -> str:
    """Return the page with another text between the marks of a key.

    Raises
    ------
    SystemExit
        The page does not have both marks.
    """
    first, last = f"<!-- {key} -->", f"<!-- end of {key} -->"
    before, begun, rest = page.partition(first)
    _, ended, after = rest.partition(last)
    if not begun or not ended:
        raise SystemExit(f"the page has no marks {first} and {last}")
    return f"{before}{first}\n{text}\n{last}{after}"


def with_block(page: str, key: str, lines: Iterable[str]) -> str:
    """Return the page with other lines in the block of plain text between the marks of a key."""
    return with_text(page, key, fenced(lines))


def fenced(lines: Iterable[str]) -> str:
    """Return a block of plain text."""
    return "\n".join(["```text", *lines, "```"])


class Page:
    """A page of docs, into which numbers, tables, blocks and figures are put."""

    def __init__(self, file: Path, parts: Iterable[str] = ()) -> None:
        self.file, self.text = file, file.read_text(encoding="utf-8")
        self.asked, self.parts = frozenset(parts), []
        self._figures: dict[str, Callable[[], Figure]] = {}
        self._tables: Counter[str] = Counter()

    @property
    def shared(self) -> Path | None:
        """The folder that SEISMASS_SHARED names, with recordings that are not part of this project."""
        folder = os.environ.get("SEISMASS_SHARED")
        return Path(folder) if folder else None

    @property
    def records(self) -> Path:
        """The recordings, without which the page cannot be made."""
        if self.shared is None:
            raise NoRecordings(f"{self.file.name} needs recordings: SEISMASS_SHARED must name their folder; got none")
        return self.shared / "records"

    def wants(self, part: str) -> bool:
        """Whether a part that takes minutes was asked for by name."""
        self.parts.append(part)
        return part in self.asked

    def words(self, said: str, *values: object) -> None:
        """Put numbers into a sentence, which stands in the page once with words before and after each {}."""
        pieces = [re.sub(r"(?:\\ )+", r"\\s+", re.escape(piece)) for piece in said.split("{}")]
        found = list(re.finditer(FIELD.join(pieces) + r"(?!\d)", self.text, re.DOTALL)) if all(pieces) else []
        if len(found) != 1:
            raise SystemExit(f"{self.file.name} must say once, with words around {{}}: {said}; got {len(found)} times")
        spans = [found[0].span(place) for place in range(1, len(pieces))]
        for (first, last), value in reversed(list(zip(spans, map(str, values), strict=True))):
            if self.text[first:last].split() != value.split():
                self.text = self.text[:first] + value + self.text[last:]

    def tables(self, *tables: str) -> None:
        """Put tables in place of those with the same heads, the first of the same heads first."""
        for new in tables:
            head = new.partition("\n")[0]
            found = list(re.finditer(rf"^{re.escape(head)}(?:\n\|.*)*", self.text, re.MULTILINE))
            self._tables[head] += 1
            if len(found) < self._tables[head]:
                raise SystemExit(f"{self.file.name} must have {self._tables[head]} tables {head}; got {len(found)}")
            first, last = found[self._tables[head] - 1].span()
            self.text = self.text[:first] + new + self.text[last:]

    def after(self, words: str, text: str) -> None:
        """Put a text in place of the paragraph, list or block below the paragraph that begins with some words."""
        before, begun, rest = self.text.partition(f"\n\n{words}")
        if not begun:
            raise SystemExit(f"{self.file.name} must have a paragraph that begins: {words}; got none")
        end = "\n\n"
        paragraph, gap, below = rest.partition(end)
        self.text = f"{before}{begun}{paragraph}{gap}{text}{''.join(below.partition(end)[1:])}"

    def section(self, heading: str, text: str) -> None:
        """Put a text in place of all that stands below a heading, up to the next of its level."""
        before, begun, rest = self.text.partition(f"\n{heading}\n")
        if not begun:
            raise SystemExit(f"{self.file.name} must have a heading: {heading}; got none")
        _, following, below = rest.partition("\n\n## ")
        self.text = f"{before}{begun}\n{text}{following or chr(10)}{below}"

    def marked(self, key: str, text: str) -> None:
        """Put a text between the marks of a key."""
        self.text = with_text(self.text, key, text)

    def block(self, key: str, lines: Iterable[str]) -> None:
        """Put lines into the block of plain text between the marks of a key."""
        self.text = with_block(self.text, key, lines)

    def example(self, blocks: int | None = None) -> dict[str, Any]:
        """Run the first blocks of Python, or all, without what they print and write, and return what they define."""
        names: dict[str, Any] = {}
        for block in re.findall(r"^```python\n(.*?)^```", self.text, re.MULTILINE | re.DOTALL)[:blocks]:
            lines = [line for line in block.splitlines() if not line.startswith(("print(", "answer.write("))]
            exec(compile("\n".join(lines), "code of the page", "exec"), names)
        return names

    def figure(self, name: str, draw: Callable[..., Figure], *given: Any) -> None:
        """Name a figure of docs/figures, which is drawn where the page is written."""
        self._figures[name] = partial(draw, *given)

    def finish(self) -> None:
        """Check that all parts that were asked for are there, and that no table was left as it was."""
        if unknown := self.asked.difference(self.parts):
            raise SystemExit(f"{self.file.name} has no part {', '.join(sorted(unknown))}; it has {self.parts}")
        for head, count in self._tables.items():
            if (there := len(re.findall(rf"^{re.escape(head)}$", self.text, re.MULTILINE))) != count:
                raise SystemExit(f"{self.file.name} must have {count} tables {head}; got {there}")

    def faults(self) -> list[str]:
        """Return what is not as it is made today: the page, or figures that are missing."""
        missing = [f"figures/{name}.png" for name in self._figures if not (FIGURES / f"{name}.png").is_file()]
        same = self.text == self.file.read_text(encoding="utf-8")
        return [*missing, *([] if same else [self.file.relative_to(ROOT).as_posix()])]

    def write(self) -> None:
        """Write the page and its figures."""
        self.file.write_text(self.text, encoding="utf-8")
        for name, draw in self._figures.items():
            write_file(FIGURES / f"{name}.png", figure_content(draw(), "png"))
