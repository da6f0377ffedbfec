# SPDX-License-Identifier: MIT
"""The wire format, for targets too: the standard library alone."""
