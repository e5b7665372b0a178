# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``check_urdf`` says which part of its own robot a lidar sees, in how many rays, how near."""

import pytest

from amr_description.cli.check_urdf import main
from amr_description.model.urdf import parse
from amr_description.sim.own_views import own_views

ROBOT = """
<robot name="post_and_lidar">
  <link name="base_link">
    <visual><geometry><box size="0.6 0.6 0.1"/></geometry></visual>
    <collision><geometry><box size="0.6 0.6 0.1"/></geometry></collision>
    <inertial><mass value="5"/>
      <inertia ixx="0.2" ixy="0" ixz="0" iyy="0.2" iyz="0" izz="0.3"/></inertial>
  </link>
  <link name="lidar_link"/>
  <joint name="to_lidar" type="fixed"><parent link="base_link"/><child link="lidar_link"/>
    <origin xyz="0 0 0.2"/></joint>
  <link name="camera_link">
    <visual><geometry><box size="0.02 0.08 0.4"/></geometry></visual>
    <inertial><mass value="0.1"/>
      <inertia ixx="0.001" ixy="0" ixz="0" iyy="0.001" iyz="0" izz="0.001"/></inertial>
  </link>
  <joint name="to_camera" type="{joint}"><parent link="base_link"/><child link="camera_link"/>
    <origin xyz="0.23 0 {height}"/><axis xyz="0 0 1"/></joint>
  <gazebo reference="lidar_link">
    <sensor name="lidar" type="{kind}"><update_rate>10</update_rate>
      <{tag}><scan><horizontal><samples>360</samples>
        <min_angle>-3.14159</min_angle><max_angle>3.14159</max_angle></horizontal></scan>
        <range><min>{least}</min><max>10</max></range></{tag}>
    </sensor>
  </gazebo>
</robot>
"""
GAZEBO = {'kind': 'gpu_lidar', 'tag': 'lidar'}


def robot(joint='fixed', height=0.2, least=0.1, **kind):
    return ROBOT.format(joint=joint, height=height, least=least, **(kind or GAZEBO))


# Half the width of 8 cm, 22 cm away: 10.3 degrees to each side.
@pytest.mark.parametrize('joint', ['fixed', 'continuous'])
def test_a_lidar_sees_the_camera_before_it(joint):
    (found,) = own_views(parse(robot(joint), 'r.urdf'))
    assert found.what == (
        'lidar "lidar" on "lidar_link" sees "camera_link", a part of its own robot'
    )
    assert found.found in ('20 of 360 rays, nearest 0.22 m', '21 of 360 rays, nearest 0.22 m')
    assert ROBOT.splitlines()[found.line - 1].strip().startswith('<sensor name="lidar"')


@pytest.mark.parametrize('fields', [{'height': -0.2}, {'least': 0.3}])
def test_what_is_below_the_rays_or_nearer_than_they_begin_is_not_seen(fields):
    assert own_views(parse(robot(**fields))) == []


def test_check_urdf_warns_of_it_and_a_strict_one_refuses(tmp_path, capsys):
    file = tmp_path / 'r.urdf'
    file.write_text(robot())
    assert main([str(file)]) == 0
    assert f'warning: {file}:' in (said := capsys.readouterr().err)
    assert 'sees "camera_link", a part of its own robot: found 2' in said
    assert main([str(file), '--strict']) == 1
