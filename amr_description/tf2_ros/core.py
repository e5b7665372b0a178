# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``tf2_py``: the buffer without a node, and the exceptions, as the original has them in C++."""

from amr_description.errors import (
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TimeoutException,
    TransformException,
)
from amr_description.tf2_ros.buffer import Buffer as BufferCore

__all__ = [
    'BufferCore',
    'ConnectivityException',
    'ExtrapolationException',
    'InvalidArgumentException',
    'LookupException',
    'TimeoutException',
    'TransformException',
]
