# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The ready-made stacks; ``bringup`` without arguments lists them."""

STACKS = {
    'simulation': 'amr_description.bringup.stacks.simulation:simulation',
}
"""Name -> ``module:function``; the function's parameters are the arguments of the stack."""
