# SPDX-License-Identifier: MIT
"""Training of the network that finds crop rows in pictures, on data sets of ardee_datasets alone; needs torch."""
