# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A plugin of pytest for runs where no ROS is (``scripts/test engine``), in place of ``conftest.py``.

There the same tests run with the same numbers, but for files that need something of ROS, or a
package that only the development of it has.
"""

from pathlib import Path

from hypothesis import settings
import pytest

UNIT = Path(__file__).resolve().parents[1] / 'unit'
EXCEPTIONS = {
    'base/test_ament_index.py': 'compares with ament_index_python',
    'model/test_description_file.py': 'compares with ament_index_python',
    'bag/test_bag_play_options.py': 'imports the player',
    'bag/test_bag_storage.py': 'compares with rosbags',
    'bag/test_bag_tools.py': 'compares with rosbags',
}
"""Files that do not run there, and why."""
TESTS = {
    'model/test_frames.py::test_forward_kinematics_agree_with_yourdfpy': 'yourdfpy',
    'model/test_urdf.py::test_agrees_with_yourdfpy': 'yourdfpy',
    'model/test_urdf_good.py::test_yourdfpy_finds_the_same': 'yourdfpy',
    'model/test_meshes.py::test_a_file_that_is_not_a_mesh': 'charset_normalizer, for text as STL',
    'navigation/test_navigation_parameter_files.py::test_every_parameter_is_known': 'a node',
    'navigation/test_planner.py::test_codes_are_those_of_nav2_msgs': 'nav2_msgs',
    'bag/test_bag_schemas.py::test_installed_type': 'std_msgs',
    'bag/test_bag_schemas.py::test_what_services_and_actions_send': 'std_srvs, control_msgs',
    'bag/test_run_description.py::test_hashes_are_those_of': 'std_msgs',
}
"""Likewise tests, and what they need."""

pytest_plugins = ['support.open_path']

settings.register_profile('normal', settings.get_profile('ci'), max_examples=50)
settings.load_profile('normal')


def pytest_configure(config: pytest.Config) -> None:
    config.addinivalue_line('markers', 'long: takes minutes, and runs with --long only')
    config.addinivalue_line('markers', 'in_order(reason): the tests of this file stay in order')


def pytest_ignore_collect(collection_path: Path) -> bool | None:
    known = collection_path.relative_to(UNIT).as_posix() if UNIT in collection_path.parents else ''
    return True if known in EXCEPTIONS else None


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    left_out = [item for item in items if is_left_out(item)]
    config.hook.pytest_deselected(items=left_out)
    items[:] = [item for item in items if item not in left_out]


def is_left_out(item: pytest.Item) -> bool:
    name = item.nodeid.removeprefix('test/unit/')
    return bool(item.get_closest_marker('long')) or name.startswith(tuple(TESTS))
