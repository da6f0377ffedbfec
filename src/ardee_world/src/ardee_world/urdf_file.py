# SPDX-License-Identifier: MIT
"""The thesis's field file: a model, a separator line, and the plots of the variable-accuracy GPS (Listing A.22)."""

from pathlib import Path
from typing import Tuple
from xml.parsers import expat

from ardee_common.errors import GeneratorError

# Listing A.22, line 131
SEPARATOR = "123456789end123456789"
EMPTY = f"""<?xml version="1.0"?>
<sdf version="1.5">
  <model name="empty">
    <static>true</static>
    <link name="link"/>
  </model>
</sdf>
{SEPARATOR}
<?xml version="1.0" ?>
<robot xmlns:xacro="http://ros.org/wiki/xacro">
</robot>
"""
_MAX_BYTES = 4 << 30


def check_xml(text: str, path: Path, first_line: int = 1) -> None:
    """Raises GeneratorError with the line at which a text is not XML."""
    parser = expat.ParserCreate()
    try:
        parser.Parse(text.encode(), True)
    except expat.ExpatError as error:
        line = error.lineno + first_line - 1
        message = expat.ErrorString(error.code)
        raise GeneratorError(f"{path}:{line}: not valid XML: {message}") from error


def split_field(path: Path) -> Tuple[str, str]:
    """Splits a field's file; returns the texts of model.sdf and plots.xacro."""
    try:
        if path.stat().st_size > _MAX_BYTES:
            raise GeneratorError(f"{path}: found more than {_MAX_BYTES} bytes, expected fewer")
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise GeneratorError(f"{path}: cannot be read: {error}") from error
    parts = text.split(f"{SEPARATOR}\n")
    if len(parts) != 2 or not parts[0].endswith("\n"):
        raise GeneratorError(
            f"{path}: found {len(parts) - 1} lines {SEPARATOR}, expected one between model and plots"
        )
    model, plots = parts
    check_xml(model, path)
    check_xml(plots, path, model.count("\n") + 2)
    return model, plots
