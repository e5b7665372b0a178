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
    unexamined,
)
from amr_description.text import one_line

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
    *unexamined.RULES,
)

_FAMILIES = {rule.__name__: rule.__module__.rpartition('.')[2] for rule in RULES}


def family(rule: str) -> str:
    """Return the family of a rule, by its name: the module of its function."""
    return _FAMILIES[rule]


def examine(seen: Observations) -> list[Finding]:
    """
    Return what all rules find: errors first, each in the order of the table.

    A rule that raises takes no other one with it, whatever a robot of others has sent.
    """
    found: list[Finding] = []
    faults: dict[str, str] = {}
    for rule in RULES:
        try:
            found += rule(seen)
        except Exception as error:
            faults[f'the rule {rule.__name__}'] = one_line(f'{type(error).__name__}: {error}')
    found += unexamined.unexamined(Observations(faults=faults))
    return sorted(found, key=lambda each: each.severity is not Severity.ERROR)
