# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Controller managers, controllers, hardware components."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Controllers:
    """Controller managers, controllers, hardware components."""
