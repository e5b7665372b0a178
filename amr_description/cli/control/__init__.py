# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Various control related sub-commands."""

_CHANGES, _LISTING = f'{__name__}.changes', f'{__name__}.listing'
VERBS = {
    'cleanup_controller': f'{_CHANGES}:CLEANUP_CONTROLLER',
    'list_controller_types': f'{_LISTING}:ListControllerTypesVerb',
    'list_controllers': f'{_LISTING}:ListControllersVerb',
    'list_hardware_components': f'{_LISTING}:ListHardwareComponentsVerb',
    'list_hardware_interfaces': f'{_LISTING}:ListHardwareInterfacesVerb',
    'load_controller': f'{_CHANGES}:LoadControllerVerb',
    'reload_controller_libraries': f'{_CHANGES}:ReloadControllerLibrariesVerb',
    'set_controller_state': f'{_CHANGES}:SetControllerStateVerb',
    'set_hardware_component_state': f'{_CHANGES}:SetHardwareComponentStateVerb',
    'switch_controllers': f'{_CHANGES}:SwitchControllersVerb',
    'unload_controller': f'{_CHANGES}:UNLOAD_CONTROLLER',
    'view_controller_chains': f'{_LISTING}:ViewControllerChainsVerb',
}
