# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``robot_description``, as published and as simulated."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Description:
    """``robot_description``, as published and as simulated."""
