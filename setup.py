# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Build the ament_python package `amr_description`: its modules, data files and executables."""

from pathlib import Path

from setuptools import find_packages, setup

PACKAGE = 'amr_description'
SHARED_FOLDERS = ('urdf', 'config')


def shared_files(folder: str) -> list[tuple[str, list[str]]]:
    """Return (target, files) of every directory below `folder`, as `data_files` wants them."""
    directories = [Path(folder), *(path for path in Path(folder).rglob('*') if path.is_dir())]
    found = {
        directory: sorted(str(path) for path in directory.iterdir() if path.is_file())
        for directory in sorted(directories)
    }
    return [(f'share/{PACKAGE}/{directory}', files) for directory, files in found.items() if files]


setup(
    name=PACKAGE,
    version='0.1.0',
    packages=find_packages(include=[PACKAGE, f'{PACKAGE}.*']),
    package_data={PACKAGE: ['ros/*.xml', 'viewer/static/**']},
    data_files=[
        ('share/ament_index/resource_index/packages', [f'resource/{PACKAGE}']),
        (f'share/{PACKAGE}', ['package.xml']),
        *(entry for folder in SHARED_FOLDERS for entry in shared_files(folder)),
    ],
    # ROS packages are named in package.xml only: their names on PyPI differ (ros-rclpy, ...).
    install_requires=['setuptools'],
    extras_require={'test': ['pytest']},
    zip_safe=False,
    maintainer='The amr_description authors',
    maintainer_email='maintainers@users.noreply.github.com',
    description='A four-wheel mobile robot to learn and try ROS 2 Jazzy with, physics included.',
    license='Apache-2.0',
    entry_points={
        'console_scripts': [  # by way of entry.py: quiet on Ctrl-C from the first moment
            'bringup = amr_description.entry:bringup.main.main',
            'calibrate = amr_description.entry:nodes.calibrate.main',
            'create = amr_description.entry:nodes.create.main',
            'hardware_spawner = amr_description.entry:nodes.hardware_spawner.main',
            'joint_state_publisher = amr_description.entry:nodes.joint_state_publisher.main',
            'listener = amr_description.entry:nodes.listener.main',
            'motor_board = amr_description.entry:nodes.motor_board.main',
            'mujoco_sim = amr_description.entry:nodes.mujoco_sim.main',
            'robot_state_publisher = amr_description.entry:nodes.robot_state_publisher.main',
            'ros2_control_node = amr_description.entry:nodes.ros2_control_node.main',
            'spawner = amr_description.entry:nodes.spawner.main',
            'static_transform_publisher = amr_description.entry:nodes.static_transform_publisher.main',  # noqa: E501
            'talker = amr_description.entry:nodes.talker.main',
            'teleop_twist_keyboard = amr_description.entry:nodes.teleop_twist_keyboard.main',
            'tf2_echo = amr_description.entry:nodes.tf2_echo.main',
            'tf2_monitor = amr_description.entry:nodes.tf2_monitor.main',
            'unspawner = amr_description.entry:nodes.unspawner.main',
            'viewer = amr_description.entry:nodes.viewer.main',
            'view_frames = amr_description.entry:nodes.view_frames.main',
            'xacro = amr_description.entry:xacro.main',
        ],
    },
)
