# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What there is to choose from, for tab completion: a function per kind of word.

Each takes what of the command line is already read, and the beginning of the word, and returns
words that may stand there. What does not begin so is left out later.

============ ===================================================================================
installed.py packages, executables, stacks, interfaces: at once
graph.py     nodes, topics, services and so on, once discovery has come to rest
manager.py   controllers and hardware components, asked of the controller manager
============ ===================================================================================
"""

COMPLETERS = {
    'action_name': 'graph:actions',
    'action_type': 'graph:action_types',
    'activate': 'manager:inactive_controllers',
    'controller_manager': 'graph:controller_managers',
    'controller_name': 'manager:controllers',
    'deactivate': 'manager:active_controllers',
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
    'launch package_name': 'installed:launch_packages',
    'run package_name': 'installed:run_packages',
    'service call values': 'installed:request',
    'service find service_type': 'graph:used_service_types',
    'topic pub values': 'installed:message',
}
"""The name of an argument, perhaps behind those of command and verb -> ``module:function``."""
