# SPDX-License-Identifier: MIT
"""Campaigns: many runs of robots, controllers and fields, and what was measured in them."""
