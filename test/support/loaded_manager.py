# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A controller manager with controllers that are loaded, and ticks of it."""

from support.control_fakes import make_manager, MS

from amr_description.errors import ControllerError

PERIOD = 10 * MS
ERRORS = [ControllerError('no, thanks'), ZeroDivisionError('no, thanks')]


def states_of(manager):
    return {c.name: c.state.label for c in manager.snapshot.controllers}


def run(manager, count, begin=0, period=PERIOD):
    for k in range(count):
        manager.tick(begin + k * period)


def loaded(*controllers, components=(), **options):
    manager = make_manager(*components, **options)
    for controller in controllers:
        manager.load(controller, 'a/Type')
    return manager
