# SPDX-License-Identifier: MIT
"""Plants: makes a mesh and its model directory from species, stage and seed."""
