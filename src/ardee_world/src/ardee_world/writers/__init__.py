# SPDX-License-Identifier: MIT
"""Writers of the files of a Layout."""
