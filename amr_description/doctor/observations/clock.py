# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``/clock``, ``use_sim_time``, stamps, the real-time factor."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Clock:
    """``/clock``, ``use_sim_time``, stamps, the real-time factor."""
