# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Velocity commands, and who listens to them."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Commands:
    """Velocity commands, and who listens to them."""
