# SPDX-License-Identifier: BSD-2-Clause
"""Images and meshes that scenes of the strips read."""


def write_to(folder):
    """Writes all files to the folder of the scene."""
