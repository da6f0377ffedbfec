# SPDX-License-Identifier: MIT
"""Meshes that a user brings, made into crop models: read, split into stalks, write."""
