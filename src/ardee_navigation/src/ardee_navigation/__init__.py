# SPDX-License-Identifier: MIT
"""Row following between crop rows, and how well it goes."""
