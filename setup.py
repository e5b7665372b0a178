# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Build the ament_python package `amr_description`: its modules, data files and executables."""

import os
from pathlib import Path

from setuptools import find_packages, setup
from setuptools.command.develop import develop
from setuptools.command.install_scripts import install_scripts

PACKAGE = 'amr_description'
EXECUTABLE = """\
{interpreter}
# Written by setup.py. Whatever PYTHONPATH says, the modules are those that were installed with it:
# a workspace may have a package of the same name.
import sys

sys.path.insert(0, {folder!r})
from {module} import {name}

sys.exit({name}{attributes}())
"""
SHARED_FOLDERS = ('urdf', 'config')


def shared_files(folder: str) -> list[tuple[str, list[str]]]:
    """Return (target, files) of every directory below `folder`, as `data_files` wants them."""
    directories = [Path(folder), *(path for path in Path(folder).rglob('*') if path.is_dir())]
    found = {
        directory: sorted(str(path) for path in directory.iterdir() if path.is_file())
        for directory in sorted(directories)
    }
    return [(f'share/{PACKAGE}/{directory}', files) for directory, files in found.items() if files]


class OwnExecutables:
    """
    Write executables that need no metadata of the package, as those of setuptools do.

    To find the metadata takes 15 ms, of 150 to 250 ms that a node needs to start.
    """

    def write_script(self, script_name: str, contents: str, *options: object) -> None:
        """As in setuptools; of the contents only the first line is taken over."""
        entry_points = dict(
            map(str.strip, line.split('='))
            for line in self.distribution.entry_points['console_scripts']
        )
        module, _, path = entry_points[script_name].partition(':')
        name, dot, attributes = path.partition('.')
        text = EXECUTABLE.format(
            interpreter=contents.partition('\n')[0],
            folder=self.folder_of_modules(),
            module=module,
            name=name,
            attributes=dot + attributes,
        )
        super().write_script(script_name, text, *options)


class Develop(OwnExecutables, develop):
    """``colcon build --symlink-install``."""

    def folder_of_modules(self) -> str:
        """Return the folder that links to the sources."""
        return os.path.abspath(self.egg_base)


class InstallScripts(OwnExecutables, install_scripts):
    """``colcon build``."""

    def folder_of_modules(self) -> str:
        """Return the folder that the modules are copied to."""
        return os.path.abspath(self.get_finalized_command('install').install_lib)


setup(
    name=PACKAGE,
    cmdclass={'develop': Develop, 'install_scripts': InstallScripts},
    version='0.1.0',
    packages=find_packages(include=[PACKAGE, f'{PACKAGE}.*']),
    package_data={
        PACKAGE: ['cli/pkg/licenses/*.txt', 'messages/*.txt', 'ros/*.xml', 'viewer/static/**']
    },
    data_files=[
        ('share/ament_index/resource_index/packages', [f'resource/{PACKAGE}']),
        (f'share/{PACKAGE}', ['package.xml']),
        *(entry for folder in SHARED_FOLDERS for entry in shared_files(folder)),
    ],
    # ROS packages are named in package.xml only: their names on PyPI differ (ros-rclpy, ...).
    install_requires=['setuptools'],
    extras_require={'test': ['pytest']},
    python_requires='>=3.11,<3.15',  # those that scripts/requirements.lock is for
    zip_safe=False,
    maintainer='The amr_description authors',
    maintainer_email='maintainers@users.noreply.github.com',
    description='A four-wheel mobile robot to learn and try ROS 2 Jazzy with, physics included.',
    license='Apache-2.0',
    entry_points={
        'console_scripts': [  # by way of entry.py: quiet on Ctrl-C from the first moment
            'bringup = amr_description.entry:bringup.main.main',
            'build_interfaces = amr_description.entry:nodes.build_interfaces.main',
            'calibrate = amr_description.entry:nodes.calibrate.main',
            'check_navigation = amr_description.entry:nodes.check_navigation.main',
            'create = amr_description.entry:nodes.create.main',
            'demo_listener = amr_description.entry:nodes.demo_listener.main',
            'demo_talker = amr_description.entry:nodes.demo_talker.main',
            'description_watcher = amr_description.entry:nodes.description_watcher.main',
            'ekf_node = amr_description.entry:nodes.ekf_node.main',
            'hardware_spawner = amr_description.entry:nodes.hardware_spawner.main',
            'joint_state_publisher = amr_description.entry:nodes.joint_state_publisher.main',
            'listener = amr_description.entry:nodes.listener.main',
            'map_of_world = amr_description.entry:nodes.map_of_world.main',
            'map_saver_cli = amr_description.entry:nodes.map_saver_cli.main',
            'map_server = amr_description.entry:nodes.map_server.main',
            'motor_board = amr_description.entry:nodes.motor_board.main',
            'mujoco_sim = amr_description.entry:nodes.mujoco_sim.main',
            'navigator = amr_description.entry:nodes.navigator.main',
            'replay = amr_description.entry:testing.replay.main',
            'robot_state_publisher = amr_description.entry:nodes.robot_state_publisher.main',
            'ros2_control_node = amr_description.entry:nodes.ros2_control_node.main',
            'scan_localizer = amr_description.entry:nodes.scan_localizer.main',
            'spawner = amr_description.entry:nodes.spawner.main',
            'static_transform_publisher = amr_description.entry:nodes.static_transform_publisher.main',  # noqa: E501
            'talker = amr_description.entry:nodes.talker.main',
            'teleop_twist_keyboard = amr_description.entry:nodes.teleop_twist_keyboard.main',
            'tf2_echo = amr_description.entry:nodes.tf2_echo.main',
            'tf2_monitor = amr_description.entry:nodes.tf2_monitor.main',
            'truth_localizer = amr_description.entry:nodes.truth_localizer.main',
            'twist_mux = amr_description.entry:nodes.twist_mux.main',
            'unspawner = amr_description.entry:nodes.unspawner.main',
            'viewer = amr_description.entry:nodes.viewer.main',
            'view_frames = amr_description.entry:nodes.view_frames.main',
            'xacro = amr_description.entry:xacro.main',
        ],
    },
)
