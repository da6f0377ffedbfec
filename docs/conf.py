# SPDX-License-Identifier: MIT
"""Sphinx's settings for the documentation site. scripts/docs builds it; pages are docs/ and what is generated."""
import re
from typing import Any, List

project = "ARDEE"
author = "the authors of ARDEE"
html_title = "ARDEE"
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx_copybutton"]
html_theme = "furo"
html_show_sphinx = False
html_show_copyright = False
html_static_path = ["static"]
html_css_files = ["wide.css"]
copybutton_prompt_text = "$ "  # a block's commands are copied, not what they print
copybutton_line_continuation_character = "\\"
html_copy_source = False
html_last_updated_fmt = None
myst_enable_extensions = ["deflist"]
myst_heading_anchors = 4
autodoc_member_order = "bysource"
autodoc_typehints = "description"
autodoc_typehints_description_target = "documented"
autodoc_preserve_defaults = True
autodoc_mock_imports = ["stable_baselines3", "torch"]  # of an example; its user installs them


def _as_restructured_text(
    _app: Any, _what: str, _name: str, _object: Any, _options: Any, lines: List[str]
) -> None:
    """Keeps the plain text of a docstring what it is: `name` is code, and *, | and _ mean nothing."""
    for number, line in enumerate(lines):
        parts = re.split(r"(`+[^`]+`+)", line)
        for place, part in enumerate(parts):
            code = re.fullmatch(r"`+([^`]+)`+", part)
            parts[place] = (
                f"``{code[1]}``" if code else re.sub(r"([\\*|`]|_(?=\W|$))", r"\\\1", part)
            )
        lines[number] = "".join(parts)


def setup(app: Any) -> None:
    """Called by Sphinx."""
    app.connect("autodoc-process-docstring", _as_restructured_text)
