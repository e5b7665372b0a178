# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The environment of a shell in which no checkout is active. Pure."""

from collections.abc import Mapping
import os
from pathlib import Path

_KEPT = ('ROS_DOMAIN_ID', 'ROS_AUTOMATIC_DISCOVERY_RANGE', 'AMR_ALONE', 'AMR_PYTHON')
_OF_A_CHECKOUT = ('AMENT_', 'AMR_', 'COLCON_', 'PYTHON', 'ROS_', 'VIRTUAL_ENV', '_AMR_', '_ROS_')


def without_checkout(environment: Mapping[str, str], root: Path) -> dict[str, str]:
    """Return an environment as it was before ``scripts/activate`` of the checkout ``root``."""

    def is_outside(entry: str) -> bool:
        return not Path(entry).is_relative_to(root)

    return {
        name: os.pathsep.join(filter(is_outside, value.split(os.pathsep)))
        if name.endswith('PATH')
        else value
        for name, value in environment.items()
        if name in _KEPT or not name.startswith(_OF_A_CHECKOUT)
    }
