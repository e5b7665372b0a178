# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What Nav2 and slam_toolbox demand of a robot, where they run."""

from amr_description.doctor.findings import Rule

RULES: tuple[Rule, ...] = ()
