# SPDX-License-Identifier: MIT
"""Programs to begin with: python3 -m ardee_sim.examples.NAME."""
