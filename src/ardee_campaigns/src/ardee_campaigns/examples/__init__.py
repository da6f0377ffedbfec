# SPDX-License-Identifier: MIT
"""Controllers and campaigns to begin with."""
