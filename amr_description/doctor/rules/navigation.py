# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What Nav2 and slam_toolbox demand of a robot, where they run."""

from collections.abc import Iterator

from amr_description.doctor.findings import Finding, Rule, warning
from amr_description.doctor.observations import Observations
from amr_description.navigation.contract.findings import CheckVerdict

_OTHERS = ('clock.', 'time.', 'cmd_vel.', 'drive.', 'tf.one_parent', 'scan.length')
"""Demands that other families of rules hold for all robots, or that take driving."""


def navigation_contract(seen: Observations) -> Iterator[Finding]:
    """
    Topics, frames, rates and stamps are as ``check_navigation`` asks.

    check_navigation lists all of them, and drives the robot if asked to (docs/nav2.md).
    """
    if seen.navigation is None:
        return
    from amr_description.navigation.contract.rules import examine, RULES as CONTRACT  # with numpy

    rules = [each for each in CONTRACT if not each.name.startswith(_OTHERS)]
    for each in examine(seen.navigation, rules):
        if each.verdict is CheckVerdict.FAILED:
            yield warning(
                'navigation_contract',
                f'{each.name}: {each.found}; asked: {each.asked}',
                f'{each.source} demands it',
                each.advice,
            )


RULES: tuple[Rule, ...] = (navigation_contract,)
