# SPDX-License-Identifier: MIT
"""Ground: from a recipe, an image, an elevation model or a mesh to its model directory."""
