# SPDX-License-Identifier: MIT
"""A page of headings, text, tables and pictures: as HTML in one file, which needs no network, and as Markdown."""
import base64
import html
from pathlib import Path
from typing import List, Sequence

_STYLE = """body { font: 15px/1.5 system-ui, sans-serif; color: #1c2733; background: #fff }
body { margin: 2em auto; max-width: 72em; padding: 0 1em }
h1, h2, h3 { line-height: 1.2; margin: 1.6em 0 0.5em } h1 { margin-top: 0 }
div.wide { overflow-x: auto } table { border-collapse: collapse; font-size: 14px; margin: 0.5em 0 }
th, td { padding: 0.25em 0.8em; text-align: right; border-bottom: 1px solid #d8dee4; white-space: nowrap }
th:first-child, td:first-child { text-align: left } th { border-bottom: 2px solid #8896a5; vertical-align: bottom }
td.long { white-space: normal; text-align: left } img { max-width: 100%; height: auto }
figure { margin: 1em 0 } figcaption { color: #52606d; font-size: 14px }
pre { background: #f2f5f7; padding: 0.6em 0.9em; overflow-x: auto }"""
_LONG = 60  # letters of a cell that may be broken


def _cell(text: str) -> str:
    kind = ' class="long"' if len(text) > _LONG else ""
    return f"<td{kind}>{html.escape(text)}</td>"


def _marked(text: str) -> str:
    """Returns text for Markdown, without tags of HTML."""
    return text.replace("<", "\\<")


def _piped(cells: Sequence[str]) -> str:
    return "| " + " | ".join(_marked(cell).replace("|", "\\|") for cell in cells) + " |\n"


class Page:
    """A page, from top to bottom, whose Markdown lies in a folder."""

    def __init__(self, title: str, folder: Path) -> None:
        self._title, self._folder = title, folder
        self._html: List[str] = []
        self._markdown: List[str] = [f"# {title}\n"]

    def heading(self, text: str, level: int = 2) -> None:
        """Adds a heading."""
        self._html.append(f"<h{level}>{html.escape(text)}</h{level}>")
        self._markdown.append(f"{'#' * level} {text}\n")

    def text(self, text: str) -> None:
        """Adds a paragraph."""
        self._html.append(f"<p>{html.escape(text)}</p>")
        self._markdown.append(f"{_marked(text)}\n")

    def command(self, text: str) -> None:
        """Adds a command line to be copied."""
        self._html.append(f"<pre>{html.escape(text)}</pre>")
        self._markdown.append(f"```sh\n{text}\n```\n")

    def table(self, heads: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
        """Adds a table."""
        head = "".join(f"<th>{html.escape(cell)}</th>" for cell in heads)
        body = "".join(f"<tr>{''.join(map(_cell, row))}</tr>\n" for row in rows)
        table = f"<table><thead><tr>{head}</tr></thead><tbody>\n{body}</tbody></table>"
        self._html.append(f'<div class="wide">{table}</div>')
        rule = "|" + "---|" * len(heads) + "\n"
        self._markdown.append(_piped(heads) + rule + "".join(map(_piped, rows)))

    def picture(self, path: Path, caption: str) -> None:
        """Adds a PNG file below the folder."""
        data = base64.b64encode(path.read_bytes()).decode()
        words = html.escape(caption)
        source = f"data:image/png;base64,{data}"
        image = f'<img src="{source}" alt="{words}">'
        self._html.append(f"<figure>{image}<figcaption>{words}</figcaption></figure>")
        self._markdown.append(f"![{_marked(caption)}]({path.relative_to(self._folder)})\n")

    def html(self) -> str:
        """Returns the page as HTML."""
        title = html.escape(self._title)
        return (
            f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>{title}</title>\n'
            f'<link rel="icon" href="data:,">\n<style>{_STYLE}</style></head>\n'
            f"<body><h1>{title}</h1>\n" + "\n".join(self._html) + "\n</body></html>\n"
        )

    def markdown(self) -> str:
        """Returns the page as Markdown."""
        return "\n".join(self._markdown)


def number(value: float, digits: int) -> str:
    """Returns a number as it is shown, a dash if there is none."""
    return f"{value:.{digits}f}" if value == value else "-"
