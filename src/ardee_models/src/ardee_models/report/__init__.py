# SPDX-License-Identifier: MIT
"""What crop models look like, and their metrics beside the literature."""
