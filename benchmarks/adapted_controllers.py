# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The shipped parameter file of the controllers, as a measurement needs it. Pure."""

from amr_description.errors import BringupError


def adapted(controllers: str, update_rate: int) -> str:
    """Return a file of controllers with another update rate (Hz), and commands that last."""
    for shipped, other in (
        ('    update_rate: 100\n', f'    update_rate: {update_rate}\n'),
        ('    publish_rate: 50.0\n', '    publish_rate: 50.0\n    cmd_vel_timeout: 0.0\n'),
    ):
        if controllers.count(shipped) != 1:
            raise BringupError(f'config/controllers.yaml has no line "{shipped.strip()}"')
        controllers = controllers.replace(shipped, other)
    return controllers
