"""What the tools that write pages of docs share: the text between two marks of a page, and the code of a page.

A tool loads it with `runpy.run_path`, as tests load the tools.
"""

from __future__ import annotations

import re
from typing import Any


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


def with_block(page: str, key: str, lines: list[str]) -> str:
    """Return the page with other lines in the block of plain text between the marks of a key."""
    return with_text(page, key, "\n".join(["```text", *lines, "```"]))


def example(page: str) -> dict[str, Any]:
    """Run the one block of Python of a page, without what it prints and writes, and return what it defines."""
    (block,) = re.findall(r"^```python\n(.*?)^```", page, re.MULTILINE | re.DOTALL)
    names: dict[str, Any] = {}
    lines = [line for line in block.splitlines() if not line.startswith(("print(", "answer.write("))]
    exec(compile("\n".join(lines), "code of the page", "exec"), names)
    return names
