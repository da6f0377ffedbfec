# SPDX-License-Identifier: MIT
"""The one error the generators raise for bad input."""


class GeneratorError(Exception):
    """Bad input: says where, what was found and what was expected."""
