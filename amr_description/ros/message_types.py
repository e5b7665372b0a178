# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""ROS message classes by their names."""

from typing import Any

from amr_description.errors import ControllerError
from amr_description.registry import resolve


def message_type(name: str) -> Any:
    """Return the class of ``package/msg/Name``. Raises ControllerError."""
    try:
        package, kind, message = name.split('/')
        return resolve(f'{package}.{kind}:{message}')
    except (ValueError, ImportError, AttributeError) as cause:
        raise ControllerError(
            f"the message type '{name}' of a port cannot be found ({cause}); it is written as "
            'package/msg/Name, and its package must be installed'
        ) from cause
