# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``/tf`` and ``/tf_static``."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Transforms:
    """``/tf`` and ``/tf_static``."""
