# SPDX-License-Identifier: MIT
"""Experiments: runs of a row follower in simulated fields, and measures of its performance."""
