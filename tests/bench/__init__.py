# SPDX-License-Identifier: MIT
"""Measurements of the bridge on loopback, for tests and scripts/benchmark; not installed."""
