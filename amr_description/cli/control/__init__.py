# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Various control related sub-commands."""

VERBS = {
    'cleanup_controller': 'amr_description.cli.control.cleanup_controller',
    'list_controller_types': 'amr_description.cli.control.list_controller_types',
    'list_controllers': 'amr_description.cli.control.list_controllers',
    'list_hardware_components': 'amr_description.cli.control.list_hardware_components',
    'list_hardware_interfaces': 'amr_description.cli.control.list_hardware_interfaces',
    'load_controller': 'amr_description.cli.control.load_controller',
    'reload_controller_libraries': 'amr_description.cli.control.reload_controller_libraries',
    'set_controller_state': 'amr_description.cli.control.set_controller_state',
    'set_hardware_component_state': 'amr_description.cli.control.set_hardware_component_state',
    'switch_controllers': 'amr_description.cli.control.switch_controllers',
    'unload_controller': 'amr_description.cli.control.unload_controller',
    'view_controller_chains': 'amr_description.cli.control.view_controller_chains',
}
