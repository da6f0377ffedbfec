# SPDX-License-Identifier: MIT
"""Row following between crop rows, and its evaluation."""
