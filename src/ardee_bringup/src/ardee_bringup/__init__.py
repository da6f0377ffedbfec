# SPDX-License-Identifier: MIT
"""The demo: a field, a world, a robot that drives down a row, a picture and a bag of the drive."""
