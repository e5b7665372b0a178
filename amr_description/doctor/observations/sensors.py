# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Scans, pictures, IMUs and odometry."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Sensors:
    """Scans, pictures, IMUs and odometry."""
