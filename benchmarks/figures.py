# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What a part of ``scripts/bench`` returns. Pure."""

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True)
class Figures:
    """The figures of a part."""

    values: Mapping[str, float]
    """By key of :data:`benchmarks.goals.GOALS`, in its unit."""
    text: str = ''
    """More than the goals, to be read."""
