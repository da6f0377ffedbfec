# SPDX-License-Identifier: MIT
"""Writes the parts of the C header and of docs/wire_format.md that follow from the scales and the codec's layouts."""
from pathlib import Path
from typing import Dict, List, Type

from ardee_bridge.wire import codec
from ardee_bridge.wire.c_struct import INT32
from ardee_bridge.wire.scales import SCALES

BEGIN, END = "begin generated", "end generated"


def _between_marks(text: str, body: List[str]) -> str:
    """Returns `text` with the lines between the marks BEGIN and END replaced."""
    lines = text.split("\n")
    first = next(i for i, line in enumerate(lines) if BEGIN in line)
    last = next(i for i, line in enumerate(lines) if END in line)
    return "\n".join(lines[: first + 1] + body + lines[last:])


def header_lines() -> List[str]:
    """Returns scale constants, then assertions of every size and offset."""
    constants = {row.constant: row for row in reversed(SCALES) if row.constant}
    lines = ["/* Integer on the wire / scale = physical value */"]
    for row in reversed(list(constants.values())):
        lines.append(f"#define {row.constant} {row.counts_per_unit} /* per {row.unit} */")
    lines.append("")
    for kind in codec.STRUCTS:
        lines.append(f"ARDEE_SIZE_({kind.C_NAME}, {kind.size});")
        lines.extend(_offset_lines(kind))
    return lines


def _offset_lines(kind: Type[codec.CStruct]) -> List[str]:
    """Returns assertions of the fields' offsets; none for int32 fields alone, whose size is enough."""
    if all(field_kind is INT32 for _, field_kind in kind.FIELDS):
        return []
    places = {leaf.path.split(".")[0]: leaf.offset for leaf in reversed(kind.leaves)}
    return [f"ARDEE_AT_({kind.C_NAME}, {name}, {places[name]});" for name, _ in kind.FIELDS]


def scale_table() -> List[str]:
    """Returns the table of scales in Markdown."""
    lines = ["| struct | field | counts per unit | unit | constant | meaning |", "|---" * 6 + "|"]
    for row in SCALES:
        field = f"`{row.path}`" if row.path else "all"
        scale = f"{row.counts_per_unit:,}" if row.counts_per_unit else "plain integer"
        constant = f"`{row.constant}`" if row.constant else ""
        cells = (f"`{row.struct}`", field, scale, row.unit, constant, row.meaning)
        lines.append(f"| {' | '.join(cells)} |")
    return lines


def generated(package: Path) -> Dict[Path, str]:
    """Returns file -> expected content, for the partly generated files."""
    parts = {"include/ardee_message.h": header_lines(), "docs/wire_format.md": scale_table()}
    files = {package / name: body for name, body in parts.items()}
    return {file: _between_marks(file.read_text("utf-8"), body) for file, body in files.items()}


def main(package: Path) -> int:
    """Brings the files up to date."""
    for file, text in generated(package).items():
        if file.read_text(encoding="utf-8") != text:
            file.write_text(text, encoding="utf-8")
            print(f"wrote {file}")
    return 0
