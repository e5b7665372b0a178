# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The processes of this host that are of ROS."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Processes:
    """The processes of this host that are of ROS."""
