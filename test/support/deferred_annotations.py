# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A table as a third-party module may write it: annotations are text at run time."""

from __future__ import annotations

from dataclasses import dataclass

from amr_description.parameters import parameter


@dataclass(frozen=True)
class DeferredTable:
    speed: float = parameter(1.0, 'A speed', unit='m/s')
