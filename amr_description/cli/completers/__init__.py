# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Tab completion: a function for each kind of argument.

It takes the parsed part of the command line and the prefix of the word, and returns the possible
words. Words without the prefix are removed later.

============ ===================================================================================
installed.py packages, executables, stacks, interfaces: at once
graph.py     nodes, topics, services and so on, after discovery
manager.py   controllers and hardware components of the controller manager
============ ===================================================================================
"""

COMPLETERS = {
    'action_name': 'graph:actions',
    'action_type': 'graph:action_types',
    'activate': 'manager:inactive_controllers',
    'controller_manager': 'graph:controller_managers',
    'controller_name': 'manager:controllers',
    'deactivate': 'manager:active_controllers',
    'dependencies': 'installed:packages',
    'destination_directory': 'installed:folders',
    'executable_name': 'installed:executables',
    'hardware_component_name': 'manager:hardware_components',
    'launch_arguments': 'installed:launch_arguments',
    'launch_file_name': 'installed:launch_files',
    'message_type': 'graph:message_types',
    'node_name': 'graph:nodes',
    'package_name': 'installed:packages',
    'param_file': 'installed:files',
    'parameter_file': 'installed:files',
    'parameter_name': 'graph:parameters',
    'parameter_names': 'graph:parameters',
    'service_name': 'graph:services',
    'service_type': 'graph:service_types',
    'topic': 'graph:topics',
    'topic_name': 'graph:topics',
    'topic_type': 'graph:used_message_types',
    'type': 'installed:interfaces',
    # where a name means something else
    'control load_controller controller_name': 'manager:loadable_controllers',
    'interface package package_name': 'installed:interface_packages',
    'pkg create license': 'installed:licenses',
    'pkg create package_name': 'installed:nothing',
    'launch package_name': 'installed:launch_packages',
    'run package_name': 'installed:run_packages',
    'service call values': 'installed:request',
    'service find service_type': 'graph:used_service_types',
    'topic pub values': 'installed:message',
}
"""Name of an argument, also after those of command and verb -> ``module:function``."""
