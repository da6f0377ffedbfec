# SPDX-License-Identifier: MIT
"""Plants: from species, stage and seed to a mesh and its model directory."""
