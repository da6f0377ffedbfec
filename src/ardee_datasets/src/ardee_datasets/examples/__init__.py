# SPDX-License-Identifier: MIT
"""Recipes that come with the package."""
