# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The ready-made stacks, which ``bringup --help`` lists."""

STACKS = {
    'display': 'amr_description.bringup.stacks.display:display',
    'fleet': 'amr_description.bringup.stacks.fleet:fleet',
    'mock': 'amr_description.bringup.stacks.hardware:mock',
    'navigation': 'amr_description.bringup.stacks.navigation:navigation',
    'serial': 'amr_description.bringup.stacks.hardware:serial',
    'simulation': 'amr_description.bringup.stacks.simulation:simulation',
    'teleop': 'amr_description.bringup.stacks.teleop:teleop',
}
"""Name -> ``module:function``; the function's parameters are the arguments of the stack."""
