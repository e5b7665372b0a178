# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Where ``launch`` and ``launch_ros`` themselves are installed, launch files are given to them."""

from collections.abc import Sequence
import importlib
import importlib.util
from pathlib import Path

from amr_description.bringup.arguments import parse
from amr_description.launch_api.modules import is_installed


def launch_by_the_original(path: Path, words: Sequence[str], *, show: bool = False) -> int | None:
    """
    Run a launch file by the original launch.

    Args:
        path: the file.
        words: its arguments, ``name:=value``.
        show: whether to print its arguments only, if ``ros2launch`` is installed.

    Returns:
        Its exit code; None: it is not installed.

    Raises:
        UsageError: an argument is malformed.
    """
    if not is_installed():
        return None
    pairs = list(parse(words).items())
    if show and importlib.util.find_spec('ros2launch') is not None:
        api = importlib.import_module('ros2launch.api')
        api.print_arguments_of_launch_file(launch_file_path=str(path))
        return 0
    launch = importlib.import_module('launch')
    sources = importlib.import_module('launch.launch_description_sources')
    actions = importlib.import_module('launch.actions')
    include = actions.IncludeLaunchDescription(
        sources.AnyLaunchDescriptionSource(str(path)), launch_arguments=pairs
    )
    service = launch.LaunchService(argv=list(words))
    service.include_launch_description(launch.LaunchDescription([include]))
    return int(service.run())
