# SPDX-License-Identifier: MIT
"""Pieces of Markdown for pages that are made."""
from typing import Any, Iterable


def table(head: Iterable[str], rows: Iterable[Iterable[str]]) -> str:
    """Returns a table."""
    lines = [list(head), *(list(row) for row in rows)]
    lines.insert(1, ["---"] * len(lines[0]))
    cells = ([cell.replace("|", "\\|").replace("\n", " ") for cell in row] for row in lines)
    return "".join(f"| {' | '.join(row)} |\n" for row in cells)


def code(text: Any) -> str:
    """Returns a text as code within a line, or nothing."""
    return f"`{text}`" if str(text) else ""
