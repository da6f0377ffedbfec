# SPDX-License-Identifier: MIT
"""Writers: a Layout to files."""
