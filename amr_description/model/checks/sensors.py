# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Rules on the sensors of ``<gazebo>`` blocks."""

from collections.abc import Iterator

from amr_description.model.checks.context import CheckContext
from amr_description.model.findings import Finding
from amr_description.model.gazebo.sensors import read_sensors


def sensors_can_work(context: CheckContext) -> Iterator[Finding]:
    """
    Lidars, cameras and contact sensors have values that they can work with, and a link.

    Types are known, rays, ranges, pictures and rates possible, frames are links, and each has
    topics of its own.
    """
    controlled = {each.name for info in context.hardware for each in info.sensors}
    yield from read_sensors(context.xml, context.robot, controlled).findings
