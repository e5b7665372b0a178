# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A package of CMake with messages, and a Python module of the same name."""

import os
import subprocess
import sys

from support.needs import need_compiler
from support.running_programs import PATIENCE

FILES = {
    'CMakeLists.txt': """cmake_minimum_required(VERSION 3.8)
project(both_pkg)
find_package(ament_cmake REQUIRED)
find_package(ament_cmake_python REQUIRED)
find_package(rosidl_default_generators REQUIRED)
rosidl_generate_interfaces(${PROJECT_NAME} "msg/Wish.msg")
ament_python_install_package(${PROJECT_NAME})
ament_package()
""",
    'package.xml': """<package format="3"><name>both_pkg</name><version>0.0.0</version>
<description>d</description><maintainer email="a@example.com">a</maintainer><license>MIT</license>
<buildtool_depend>ament_cmake</buildtool_depend>
<buildtool_depend>rosidl_default_generators</buildtool_depend>
<member_of_group>rosidl_interface_packages</member_of_group>
<export><build_type>ament_cmake</build_type></export></package>
""",
    'msg/Wish.msg': 'float64 t\n',
    'both_pkg/__init__.py': '',
    'both_pkg/tools.py': 'X = 5\n',
}


def test_messages_and_a_module_of_one_name_are_built_together(tmp_path):
    need_compiler()
    for name, text in FILES.items():
        path = tmp_path / 'src/both_pkg' / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    variables = {**os.environ, 'COLCON_HOME': str(tmp_path)}
    options = {'capture_output': True, 'text': True, 'timeout': 4 * PATIENCE, 'env': variables}
    built = subprocess.run([sys.executable, '-m', 'colcon', 'build'], cwd=tmp_path, **options)
    assert built.returncode == 0, built.stdout + built.stderr
    program = (
        'from both_pkg.msg import Wish; from both_pkg.tools import X; print(X, Wish(t=1.0).t)'
    )
    used = subprocess.run(
        ['bash', '-c', f'source {tmp_path}/install/setup.bash && python -c "{program}"'], **options
    )
    assert used.stdout == '5 1.0\n', used.stderr
