# SPDX-License-Identifier: MIT
"""Real scans beside simulated ones, as a controller that only looks perceives them."""
