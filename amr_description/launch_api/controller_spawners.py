# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``controller_manager.launch_utils``: launch descriptions that spawn controllers.

They are made of the classes of whichever ``launch`` is imported: ours, or the original.
"""

from collections.abc import Mapping, Sequence
import importlib
from typing import Any

__all__ = [
    'generate_controllers_spawner_launch_description',
    'generate_controllers_spawner_launch_description_from_dict',
    'generate_load_controller_launch_description',
]


def generate_controllers_spawner_launch_description(
    controller_names: Sequence[Any],
    controller_params_files: Sequence[Any] | None = None,
    extra_spawner_args: Sequence[Any] = (),
) -> Any:
    """
    Return a LaunchDescription with a spawner, and the two arguments that it has.

    Args:
        controller_names: Of the controllers.
        controller_params_files: Paths; of a value in several the last counts.
        extra_spawner_args: More words, as ``--load-only``.
    """
    launch, actions, substitutions, ros_actions = (
        importlib.import_module(name)
        for name in ('launch', 'launch.actions', 'launch.substitutions', 'launch_ros.actions')
    )
    configuration = substitutions.LaunchConfiguration
    words = [*controller_names, '--controller-manager', configuration('controller_manager_name')]
    for file in filter(None, controller_params_files or ()):
        words += ['--param-file', file]
    is_unloaded = [
        '"--unload-on-kill" if "true" == "',
        configuration('unload_on_kill'),
        '" else ""',
    ]
    words += [substitutions.PythonExpression(is_unloaded), *extra_spawner_args]
    return launch.LaunchDescription(
        [
            actions.DeclareLaunchArgument(
                'controller_manager_name',
                default_value='controller_manager',
                description='Controller manager node name',
            ),
            actions.DeclareLaunchArgument(
                'unload_on_kill',
                default_value='false',
                description='Wait until the node is interrupted and then unload controller',
            ),
            ros_actions.Node(
                package='controller_manager',
                executable='spawner',
                arguments=words,
                shell=True,
                output='screen',
            ),
        ]
    )


def generate_controllers_spawner_launch_description_from_dict(
    controller_info_dict: Mapping[Any, Any], extra_spawner_args: Sequence[Any] = ()
) -> Any:
    """
    Return a LaunchDescription, as above.

    Args:
        controller_info_dict: Name of a controller → the path of its file, several, or None.
        extra_spawner_args: More words.

    Raises:
        ValueError: It is no dict, or of other values.
    """
    if not isinstance(controller_info_dict, dict):
        raise ValueError(f'Invalid controller_info_dict type parsed {controller_info_dict}')
    files: list[Any] = []
    for given in filter(None, controller_info_dict.values()):
        if not isinstance(given, str | list):
            raise ValueError(f'Invalid controller_params_file type parsed in the dict {given}')
        files += given if isinstance(given, list) else [given]
    return generate_controllers_spawner_launch_description(
        [*controller_info_dict], files, extra_spawner_args
    )


def generate_load_controller_launch_description(
    controller_name: Any,
    controller_params_file: Any = None,
    extra_spawner_args: Sequence[Any] = (),
) -> Any:
    """Return a LaunchDescription, as above, with one controller and at most one file."""
    return generate_controllers_spawner_launch_description(
        [controller_name], [controller_params_file], extra_spawner_args
    )
