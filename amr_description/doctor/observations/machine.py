# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The machine: system, Python, memory, disks, network."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Machine:
    """The machine: system, Python, memory, disks, network."""
