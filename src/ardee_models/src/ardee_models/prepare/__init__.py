# SPDX-License-Identifier: MIT
"""Makes crop models of a user's meshes: reads them, splits them into stalks, writes the models."""
