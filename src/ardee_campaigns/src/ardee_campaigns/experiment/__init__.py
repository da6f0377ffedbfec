# SPDX-License-Identifier: MIT
"""Experiments: a campaign of the row follower in one scenario, with a report of its own, and comparisons of two."""
