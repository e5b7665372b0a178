# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The table of all rules: root causes stand before what they cause."""

from amr_description.doctor.findings import Finding, Rule, Severity
from amr_description.doctor.observations import Observations
from amr_description.doctor.rules import (
    clock,
    commands,
    controllers,
    description,
    environment,
    graph,
    machine,
    navigation,
    processes,
    sensors,
    transforms,
)

RULES: tuple[Rule, ...] = (
    *machine.RULES,
    *environment.RULES,
    *processes.RULES,
    *graph.RULES,
    *clock.RULES,
    *description.RULES,
    *controllers.RULES,
    *transforms.RULES,
    *commands.RULES,
    *sensors.RULES,
    *navigation.RULES,
)

_FAMILIES = {rule.__name__: rule.__module__.rpartition('.')[2] for rule in RULES}


def family(rule: str) -> str:
    """Return the family of a rule, by its name: the module of its function."""
    return _FAMILIES[rule]


def examine(seen: Observations) -> list[Finding]:
    """Return what all rules find: errors first, each in the order of the table."""
    found = [finding for rule in RULES for finding in rule(seen)]
    return sorted(found, key=lambda each: each.severity is not Severity.ERROR)
