# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The environment variables of this process."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Environment:
    """The environment variables of this process."""
