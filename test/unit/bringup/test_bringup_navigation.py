# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The stack ``navigation``: what it brings up, in what order, with which arguments."""

import pathlib

import pytest
from support.paths import ROOT

from amr_description.bringup.arguments import declared, resolve
from amr_description.bringup.scheduler import Scheduler
from amr_description.bringup.stacks.navigation import navigation
from amr_description.bringup.stacks.simulation import simulation
from amr_description.errors import AmrError, UsageError

ROVER = {
    'urdf': str(ROOT / 'examples/rover/urdf/rover.urdf.xacro'),
    'controllers': str(ROOT / 'examples/rover/config/rover.yaml'),
}


def stack(**given):
    return navigation(**resolve(declared(navigation), given))


def node(made, executable):
    [found] = [each for each in made.nodes if each.executable == executable]
    return found


def test_amr_has_its_sensors_and_is_in_the_warehouse():
    made = stack()
    assert node(made, 'mujoco_sim').parameters[0]['world'] == 'warehouse'
    description = node(made, 'robot_state_publisher').parameters[0]['robot_description']
    assert 'type="gpu_lidar"' in description
    without = stack(sensors='false', world='empty')
    assert node(without, 'mujoco_sim').parameters[0]['world'] == 'empty'
    description = node(without, 'robot_state_publisher').parameters[0]['robot_description']
    assert '<sensor' not in description


def test_a_robot_without_a_lidar_is_warned_of():
    def warnings(made):
        return [text for level, text in made.notes if level == 'WARNING']

    assert warnings(stack()) == []
    [line] = warnings(stack(**ROVER))
    assert line.endswith('no <sensor> is a lidar: without /scan nothing drives to goals or maps')


def test_it_takes_what_the_simulation_takes():
    names = [each.name for each in declared(simulation)]
    assert {*names} < {each.name for each in declared(navigation)}


def test_only_what_the_robot_stands_on_ends_it():
    made = stack(ekf='true', localization='scan')
    stands_on = [each.executable for each in made.nodes if each.required is True]
    assert stands_on == [
        'mujoco_sim',
        'robot_state_publisher',
        'create',
        'spawner',
        'spawner',
        'twist_mux',
    ]
    anew = [each.executable for each in made.nodes if each.respawn]
    assert anew == [
        'ekf_node', 'viewer', 'map_of_world', 'scan_localizer', 'map_of_world', 'navigator',
    ]  # fmt: skip
    assert {each.executable for each in made.nodes} == {*stands_on, *anew}


def test_commands_go_through_the_mux_to_the_wheels():
    mux = node(stack(), 'twist_mux')
    file, own = mux.parameters
    assert file.endswith('config/twist_mux.yaml')
    assert own == {'use_stamped': True, 'use_sim_time': True}
    assert mux.remappings == [('cmd_vel_out', '/diff_drive_controller/cmd_vel')]
    with_file = stack(twist_mux=str(ROOT / 'config/controllers.yaml'))
    assert node(with_file, 'twist_mux').parameters[0] == str(ROOT / 'config/controllers.yaml')


def test_parameters_of_a_users_file_come_after_those_of_the_navigator():
    mine = str(ROOT / 'config/ekf.yaml')
    first, second, _ = node(stack(navigator_params=mine), 'navigator').parameters
    assert first.endswith('config/navigator.yaml')
    assert second == mine


def test_the_map_is_that_of_the_world_seen_from_the_start():
    maps = node(stack(world='walls', x='1.5', y='-0.5', navigator='false'), 'map_of_world')
    assert maps.arguments == ['walls', '--publish', '--start', '1.5', '-0.5']
    made = stack(world='walls', x='-1e-05', navigator='false')
    assert node(made, 'map_of_world').arguments[-2:] == ['-0.00001', '0.0']
    assert '-1e-05' not in node(made, 'create').arguments, 'argparse takes it for a flag'
    assert 'map_of_world' not in executables(stack(map='none'))


def test_the_navigator_plans_on_a_map_of_what_the_lidar_does_not_see(tmp_path):
    made = stack(world='walls', x='1.5')
    assert node(made, 'navigator').remappings == [
        ('cmd_vel_teleop', 'cmd_vel_assisted'),
        ('map', 'obstacle_map'),
    ]
    seen, whole = [each for each in made.nodes if each.executable == 'map_of_world']
    assert (seen.name, whole.name) == (None, 'obstacle_map')
    start = ['walls', '--publish', '--start', '1.5', '0.0']
    assert whole.arguments == [*start, '--height', '0.02', '--top', '0.4']
    file = tmp_path / 'hall.yaml'
    file.touch()
    served = node(stack(map=str(file)), 'navigator').remappings
    assert served == [('cmd_vel_teleop', 'cmd_vel_assisted')]


def test_a_saved_map_is_served(tmp_path):
    file = tmp_path / 'hall.yaml'
    file.touch()
    made = stack(map=str(file), localization='scan')
    assert node(made, 'map_server').parameters == [
        {'yaml_filename': str(file), 'autostart_node': True, 'use_sim_time': True}
    ]
    assert 'map_of_world' not in executables(made)


def test_one_localizes():
    assert {'truth_localizer'} == localizers(stack())
    assert {'scan_localizer'} == localizers(stack(localization='scan'))
    assert localizers(stack(localization='none', map='none')) == set()
    assert localizers(stack(map='none')) == {'truth_localizer'}
    made = stack(localization='scan', x='1.0', y='0.5', yaw='0.25')
    assert node(made, 'scan_localizer').parameters == [
        {
            'use_sim_time': True,
            'set_initial_pose': True,
            'initial_pose.x': 1.0,
            'initial_pose.y': 0.5,
            'initial_pose.yaw': 0.25,
        }
    ]
    assert node(made, 'scan_localizer').start_when == made.ready_when


def test_the_navigator_drives_unless_another_does():
    file, own = node(stack(), 'navigator').parameters
    assert file.endswith('config/navigator.yaml')
    assert own == {'use_sim_time': True, 'enable_stamped_cmd_vel': False}
    assert 'navigator' not in executables(stack(navigator='false'))
    [own] = node(stack(**ROVER), 'navigator').parameters
    assert own.keys() >= {'robot_radius', 'robot_base_frame'}
    assert own['robot_base_frame'] == 'base_footprint'
    assert 0.1 < own['robot_radius'] < 1.0


def test_the_next_steps_are_those_of_who_drives():
    assert 'press "Goal" there' in stack().next_steps
    assert '/goal_pose' in stack(viewer='false').next_steps
    without = stack(viewer='false', navigator='false').next_steps
    assert without.startswith('drive with, in another shell,')
    assert '/goal_pose' not in without


def localizers(made):
    return {'truth_localizer', 'scan_localizer'} & executables(made)


def executables(made):
    return {each.executable for each in made.nodes}


def test_another_robot_has_the_sensors_and_the_topic_of_its_own():
    mux = node(stack(**ROVER), 'twist_mux')
    assert mux.remappings == [('cmd_vel_out', '/diff_drive_controller/cmd_vel')]
    [parameters] = node(stack(**ROVER), 'truth_localizer').parameters
    assert parameters == {'use_sim_time': True}


def test_of_a_robot_without_base_footprint_the_root_is_localized(tmp_path):
    text = pathlib.Path(ROVER['urdf']).read_text(encoding='utf-8')
    file = tmp_path / 'rover.urdf.xacro'
    file.write_text(text.replace('base_footprint', 'chassis'), encoding='utf-8')
    [parameters] = node(stack(**ROVER | {'urdf': str(file)}), 'truth_localizer').parameters
    assert parameters == {'use_sim_time': True, 'base_frame_id': 'chassis'}


def test_everything_starts_before_it_is_ready():
    scheduler = Scheduler(stack(viewer='false'))
    started = []
    while wave := scheduler.startable():
        for each in wave:
            scheduler.on_start(each)
            started.append(each.executable)
        scheduler.on_exit(wave[-1], 0) if wave[-1].executable in ('create', 'spawner') else None
        create = [each for each in wave if each.executable == 'create']
        for each in create:
            scheduler.on_exit(each, 0)
    assert {'mujoco_sim', 'robot_state_publisher', 'create', 'twist_mux'} < {*started}


@pytest.mark.parametrize(
    ('given', 'line'),
    [
        (
            {'urdf': str(ROOT / 'test/fixtures/sim/arm.urdf')},
            r'^urdf:=\S+arm\.urdf: no controller of the robot takes a velocity, so nothing can '
            r'navigate it; the stack simulation brings it up$',
        ),
        (
            {'map': 'hall.png'},
            '^map:=hall.png: it is world, none, or the .yaml file of a map$',
        ),
        ({'map': 'hall.yaml'}, 'hall.yaml'),
        ({'localization': 'amcl'}, '^localization:=amcl: it is truth, scan or none$'),
        (
            {'localization': 'scan', 'map': 'none'},
            '^localization:=scan matches scans against a map, and map:=none$',
        ),
        ({'twist_mux': 'absent.yaml'}, 'absent.yaml'),
        ({'navigator_params': 'absent.yaml'}, 'absent.yaml'),
        ({'rtf': '-1'}, '^rtf:=-1.0: a real-time factor is 0'),
    ],
)
def test_what_cannot_be_gets_one_line(given, line):
    with pytest.raises((AmrError, UsageError), match=line):
        stack(**given)
