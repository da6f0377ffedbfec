# SPDX-License-Identifier: MIT
"""model.config, the file by which Gazebo recognises a model directory."""

from xml.sax.saxutils import escape

_CONFIG = """<?xml version="1.0"?>
<model>
  <name>{name}</name>
  <version>1.0</version>
  <sdf version="1.5">model.sdf</sdf>
  <author>
    <name>ARDEE developers</name>
    <email>ardee@users.noreply.github.com</email>
  </author>
  <description>{description}</description>
</model>
"""


def model_config(name: str, description: str) -> str:
    """Text of model.config."""
    return _CONFIG.format(name=escape(name), description=escape(description))
