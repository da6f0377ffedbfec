# SPDX-License-Identifier: MIT
"""Reports of campaigns: pages of tables and figures, and comparisons."""
