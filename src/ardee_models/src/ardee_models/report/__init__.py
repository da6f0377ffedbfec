# SPDX-License-Identifier: MIT
"""Pictures of crop models, and their metrics beside the literature."""
