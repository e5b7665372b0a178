# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""docs/your_own_package.md: a description, and a package that cannot be built here beside it."""

import re

import pytest
from support.doc_pages import Page
from support.shells import newcomer

PAGE = Page('your_own_package.md')
# As descriptions of others are.
ROBOT = """\
<robot name="my_robot">
  <link name="base_link">
    <inertial>
      <mass value="2"/>
      <inertia ixx="0.03" ixy="0" ixz="0" iyy="0.03" iyz="0" izz="0.03"/>
    </inertial>
    <collision>
      <geometry><mesh filename="package://my_robot_description/meshes/base.stl"/></geometry>
    </collision>
  </link>
</robot>
"""
CORNERS = [(0, 0, 0), (0.4, 0, 0), (0, 0.4, 0), (0, 0, 0.4)]
FACES = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
LINES = PAGE.text.split('lead there:')[1]
OUTSIDE = 'check_urdf ~/outside.urdf'
DRIVER = 'ros2 pkg create an_old_driver --dependencies rclcpp --node-name driver'


def mesh():
    """A tetrahedron, as STL."""
    facets = ''.join(
        'facet normal 0 0 0\nouter loop\n'
        + ''.join('vertex {} {} {}\n'.format(*CORNERS[corner]) for corner in face)
        + 'endloop\nendfacet\n'
        for face in FACES
    )
    return f'solid base\n{facets}endsolid base\n'


@pytest.mark.long
def test_a_description_of_ament_cmake(tmp_path):
    source = tmp_path / 'ros2_ws/src'
    source.mkdir(parents=True)
    package = source / 'my_robot_description'
    (folders,) = PAGE.blocks('cmake')
    with newcomer(PAGE.text + DRIVER, tmp_path) as shell:
        for line in ('cd ~/ros2_ws/src', 'ros2 pkg create my_robot', 'mkdir my_robot', DRIVER):
            shell.run(line)
        for file in (package / 'urdf/my_robot.urdf', tmp_path / 'outside.urdf'):
            file.write_text(ROBOT)
        (package / 'meshes/base.stl').write_text(mesh())
        rules = (package / 'CMakeLists.txt').read_text()
        rules = rules.replace('ament_package()', f'{folders}ament_package()')
        # As many do, it asks for a library of which it uses nothing.
        rules = rules.replace('# find dependencies', 'find_package(urdf REQUIRED)')
        (package / 'CMakeLists.txt').write_text(rules)
        manifest = (package / 'package.xml').read_text()
        manifest = manifest.replace('  <test_depend', '  <depend>urdf</depend>\n  <test_depend', 1)
        (package / 'package.xml').write_text(manifest)
        shell.book = LINES
        shell.run('cd ~/ros2_ws')
        said = shell.run('colcon build', code=1)
        (line,) = re.findall('^an_old_driver needs .*', said, re.MULTILINE)
        assert line.startswith(
            "an_old_driver needs 'rclcpp' (find_package, CMakeLists.txt:10), which"
        )
        # It is built after the other one failed, which would stop colcon elsewhere.
        assert (
            'Finished <<< my_robot_description' in said.partition('Failed   <<< an_old_driver')[2]
        )
        assert said.count('--- stderr') == 1
        shell.book = OUTSIDE
        assert "'my_robot_description' is not found" in shell.run('check_urdf')
        shell.book = LINES
        shell.run('source install/setup.bash')
        assert 'robot name is: my_robot' in shell.run('check_urdf src/')
        shell.book = OUTSIDE
        assert 'warning' not in shell.run('check_urdf')
        shell.book = 'ros2 pkg prefix --share my_robot_description'
        share = tmp_path / 'ros2_ws/install/my_robot_description/share/my_robot_description'
        assert shell.run('ros2 pkg prefix') == f'{share}\n'
