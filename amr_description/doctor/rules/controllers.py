# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Rules of the section ``controllers``."""

from amr_description.doctor.findings import Rule

RULES: tuple[Rule, ...] = ()
