# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Each demand of Nav2 and slam_toolbox holds for a good robot, and fails for a broken one."""

from dataclasses import replace
import json

import pytest
from support.contract_robots import (
    CLOCK,
    GEOMETRY,
    good_robot,
    moving,
    MS,
    odometry,
    phase,
    scans,
    START,
    STATIC,
    static,
    ticks,
    topic,
    WALL,
)

from amr_description.clock import NANOSECONDS
from amr_description.navigation.contract.findings import CheckVerdict
from amr_description.navigation.contract.observations import (
    Body,
    ContractEndpoint,
    ContractTopic,
    GRID_TYPE,
    MapSeen,
    ODOMETRY_TYPE,
    RangeCounts,
    SCAN_TYPE,
    STAMPED_TWIST_TYPE,
    Tick,
    TWIST_TYPE,
)
from amr_description.navigation.contract.report import as_json, as_text, silent_topics
from amr_description.navigation.contract.rules import examine, RULES

GOOD = good_robot()
NAMES = [rule.name for rule in RULES]
OTHER_TYPE = 'std_msgs/msg/String'


def finding(name, seen):
    (found,) = examine(seen, [rule for rule in RULES if rule.name == name])
    return found


def both(*publishers, name='/odom', subscriptions=()):
    return ContractTopic(name, tuple(publishers), tuple(subscriptions))


def test_all_demands_hold_for_a_good_robot():
    wrong = [found for found in examine(GOOD) if found.verdict is not CheckVerdict.PASSED]
    assert wrong == []


def test_names_are_unique_and_every_rule_says_whose_demand_it_is():
    assert len(set(NAMES)) == len(NAMES)
    assert all(rule.asked and rule.source for rule in RULES)


def test_who_takes_stamps_needs_simulated_time_or_follows_the_clock_itself():
    clock = replace(GOOD.clock, subscriptions=(ContractEndpoint('/drive', CLOCK),))
    times = {'/drive': False, '/page': False, '/robot_state_publisher': True}
    found = finding('time.use_sim_time', replace(GOOD, use_sim_time=times, clock=clock))
    assert found.verdict is CheckVerdict.PASSED
    said = 'true in all 1 nodes; not in /drive, /page, which no stamp can harm'
    assert said in found.found
    found = finding('time.use_sim_time', replace(GOOD, use_sim_time=times))
    assert (found.verdict, found.found) == (CheckVerdict.FAILED, 'use_sim_time is false in /drive')


def in_order(*transforms):
    return tuple(sorted(transforms, key=lambda each: each.received))


def shifted(milliseconds):
    return tuple(replace(scan, stamp=scan.stamp + milliseconds * MS) for scan in GOOD.scans)


TWO = (ContractEndpoint('/sim', CLOCK), ContractEndpoint('/bag', CLOCK))
BACK = (*ticks(), Tick(START, WALL + 3 * NANOSECONDS))
STILL = tuple(replace(tick, time=START) for tick in ticks())
BEYOND = RangeCounts(hits=300, beyond=60)
ZEROS = RangeCounts(hits=300, nearer=60)
NONE = RangeCounts(hits=0, invalid=360)
LATE = tuple(replace(scan, wait=250 * MS) for scan in GOOD.scans)
NEVER = tuple(replace(scan, wait=None, error='Lookup would …') for scan in GOOD.scans)
VARYING = (*GOOD.scans, replace(GOOD.scans[-1], geometry=replace(GEOMETRY, count=359)))
TWICE = (*GOOD.odometry, GOOD.odometry[-1])
REPEATED = (*moving(), replace(moving()[-1], received=WALL + 3 * NANOSECONDS))
INTERLEAVED = in_order(*moving(sequence=1), *moving(period=30 * MS, sequence=5000))
IN_WORLD = tuple(replace(each, linear=(0.5 * 0.5403, 0.5 * 0.8415)) for each in GOOD.odometry)
BROKEN = [
    ('clock.publishers', {'clock': both(*TWO, name='/clock')}, '2 publishers: /sim, /bag'),
    ('clock.publishers', {'clock': ContractTopic('/clock')}, 'they stay at 0'),
    ('clock.rate', {'ticks': ticks(20 * MS)}, '50.0 Hz by /sim'),
    ('clock.rate', {'ticks': STILL}, 'time stands still at 100.000 s'),
    ('clock.rate', {'ticks': ticks()[:1]}, '1 messages in 2 s of /sim'),
    ('clock.order', {'ticks': BACK}, 'first from 102.040 s to 100.000 s'),
    ('time.use_sim_time', {'use_sim_time': {'/a': True, '/drive': False}}, 'false in /drive'),
    ('time.real_time_factor', {'ticks': ticks(factor=5.0)}, '5.00 over'),
    ('time.real_time_factor', {'ticks': ticks(factor=0.5)}, '0.50 over'),
    ('tf.frames', {'transforms': moving()}, 'no base_link; there are'),
    ('tf.frames', {'transforms': ()}, 'no frames at all'),
    ('tf.frames', {'transforms': moving('a/odom', 'a/base_footprint')}, 'there are a/'),
    ('tf.frames', {'transforms': (*STATIC[1:], *moving())}, 'base_link is not below odom'),
    ('tf.odometry', {'transforms': STATIC}, 'no way from odom'),
    ('tf.odometry', {'transforms': (static('odom', 'base_footprint'), *STATIC)}, 'is static'),
    (
        'tf.one_parent',
        {'transforms': in_order(*STATIC, *moving(), *moving('odom', 'base_link'))},
        'base_link is published static in base_footprint and dynamic in odom; published by /drive',
    ),
    ('tf.one_parent', {'transforms': (*STATIC, *INTERLEAVED)}, 'in odom by two nodes'),
    (
        'tf.one_parent',
        {'transforms': (*STATIC, static('base_link', 'lidar_link', 0.2))},
        'lidar_link has two static poses',
    ),
    (
        'tf.others',
        {'transforms': in_order(*STATIC[:1], *moving(), *moving('base_link', 'lidar_link'))},
        'lidar_link move without a joint',
    ),
    ('tf.rate', {'transforms': (*STATIC, *moving(period=50 * MS))}, '20.0 Hz of 40'),
    ('tf.rate', {'transforms': (*STATIC, *moving()[:1])}, '1 transforms odom → base_footprint'),
    ('tf.order', {'transforms': (*STATIC, *REPEATED)}, '1 of 101 not later'),
    ('tf.at_scans', {'scans': LATE}, 'at 20 of 20 stamps: up to 0.250 s late'),
    ('tf.at_scans', {'scans': NEVER}, 'at 20 of 20 stamps: Lookup would …'),
    ('odom.qos', {'odom': topic('/odom', ODOMETRY_TYPE, '/drive', is_reliable=False)}, 'best'),
    ('odom.qos', {'odom': topic('/odom', OTHER_TYPE, '/drive')}, f'publishes {OTHER_TYPE}'),
    ('odom.qos', {'odom': ContractTopic('/odom')}, 'nobody publishes /odom'),
    ('odom.rate', {'odometry': odometry(100 * MS)}, '10.0 Hz of 20 messages by /drive'),
    ('odom.qos', {'odometry': ()}, 'no message on /odom in 2 s, of /drive'),
    ('odom.rate', {'odometry': GOOD.odometry[:1]}, '1 messages'),
    ('odom.order', {'odometry': TWICE}, '1 of 101 not later'),
    ('odom.frames', {'odometry': odometry(child_frame='wheel')}, "'odom' → 'wheel'"),
    ('odom.frames', {'odometry': odometry(frame='map')}, "'map' → 'base_footprint'"),
    ('odom.twist', {'odometry': IN_WORLD}, 'by twists +0.53 m and +0.83 m'),
    ('odom.covariance', {'odometry': odometry(variances=(1, 1, 0, 1, 1))}, 'above 0: yaw'),
    ('scan.published', {'scan': topic('/scan', OTHER_TYPE, '/sim')}, f'publishes {OTHER_TYPE}'),
    ('scan.published', {'scan': ContractTopic('/scan'), 'scans': ()}, 'nobody publishes /scan'),
    ('scan.published', {'scans': ()}, 'no message on /scan in 2 s, of /sim'),
    ('scan.rate', {'scans': scans(25 * MS)}, '40.0 Hz'),
    ('scan.rate', {'scans': scans(500 * MS)}, '2.0 Hz'),
    ('scan.rate', {'scans': GOOD.scans[:2]}, '2 scans in 2 s'),
    ('scan.order', {'scans': (*GOOD.scans, GOOD.scans[-1])}, '1 times; published by /sim'),
    ('scan.frame', {'scans': scans(frame='laser')}, "'laser' is not below"),
    (
        'scan.frame',
        {'transforms': (*STATIC[:1], *moving(), *moving('base_link', 'lidar_link'))},
        "'lidar_link' moves against the robot, by lidar_link",
    ),
    (
        'scan.length',
        {'scans': scans(geometry=replace(GEOMETRY, count=361))},
        '361 ranges from -3.14159 to 3.12414 by 0.017453 rad, of which slam_toolbox computes 360',
    ),
    ('scan.length', {'scans': scans(geometry=replace(GEOMETRY, angle_increment=0.0))}, 'None'),
    ('scan.ranges', {'scans': scans(counts=BEYOND)}, '1200 are finite and above range_max 12 m'),
    ('scan.ranges', {'scans': scans(counts=ZEROS)}, '1200 are finite and below range_min 0.1 m'),
    ('scan.ranges', {'scans': scans(counts=NONE)}, 'none is a range or +inf'),
    ('scan.geometry', {'scans': VARYING}, "count of 'lidar_link' is 360 and 359"),
    ('scan.age', {'scans': shifted(-400)}, '400 ms at most when received'),
    ('scan.age', {'scans': shifted(30)}, 'up to 0.020 s later than the present'),
    (
        'scan.range_max',
        {'scans': scans(geometry=replace(GEOMETRY, range_max=2.5))},
        'range_max 2.5 m',
    ),
    (
        'slam.max_laser_range',
        {'parameters': {'/slam_toolbox': {'max_laser_range': 20.0}}},
        'max_laser_range 20 m in /slam_toolbox, range_max 12 m',
    ),
    ('cmd_vel.listener', {'cmd_vel': ContractTopic('/cmd_vel')}, 'nobody subscribes to /cmd_vel'),
    ('cmd_vel.listener', {'cmd_vel': topic('/cmd_vel', OTHER_TYPE, '', '/x')}, '/x subscribes'),
    (
        'cmd_vel.type',
        {'cmd_vel': topic('/cmd_vel', STAMPED_TWIST_TYPE, '', '/drive')},
        f'/drive subscribes to {STAMPED_TWIST_TYPE}',
    ),
    ('cmd_vel.type', {'is_stamped': True}, f'/drive subscribes to {TWIST_TYPE}'),
    (
        'cmd_vel.type',
        {
            'cmd_vel': both(
                ContractEndpoint('/smoother', STAMPED_TWIST_TYPE),
                name='/cmd_vel',
                subscriptions=[ContractEndpoint('/drive', TWIST_TYPE)],
            )
        },
        f'/smoother publishes {STAMPED_TWIST_TYPE} on /cmd_vel, but /drive subscribes to',
    ),
    ('drive.linear', {'drive': (phase(0.5, 0.0, top=0.3), phase(0.0, 2.0))}, '0.30 m/s'),
    ('drive.angular', {'drive': (phase(0.5, 0.0), phase(0.0, 2.0, top=1.0))}, '1.00 rad/s'),
    ('drive.braking', {'drive': (phase(0.5, 0.0, brakes=1.5),)}, '1.500 s at most'),
    ('drive.braking', {'drive': (phase(0.5, 0.0, brakes=99.0),)}, 'it still has 0.50 m/s'),
    ('drive.progress', {'drive': (phase(0.5, 0.0, top=0.01),)}, 'm while 0.5 m/s was commanded'),
    (
        'costmap.footprint',
        {'parameters': {'/c': {'robot_radius': 0.22, 'footprint': '[[0.1, 0.1], [-0.2, 0.0]]'}}},
        'are outside of that of /c',
    ),
    (
        'costmap.footprint',
        {'parameters': {'/c': {'robot_radius': 0.22, 'footprint': 'round'}}},
        '/c has a footprint that is none: round',
    ),
    (
        'costmap.footprint',
        {'body': Body(frozenset({'wheel'}), 0.3, ((0.3, 0.0), (-0.3, 0.1), (-0.3, -0.1)))},
        'reach 0.300 m from base_link; /local_costmap/local_costmap has robot_radius 0.22',
    ),
    ('map.published', {'map': topic('/map', OTHER_TYPE, '/x')}, f'/x publishes {OTHER_TYPE}'),
    ('map.published', {'map': topic('/map', GRID_TYPE, '/x')}, 'does not publish it reliable and'),
    ('map.published', {'map_seen': None}, '/map_server has published no map'),
    ('map.published', {'map_seen': MapSeen('map', 3, 2, 0.05, 5)}, 'with 5 values'),
    ('map.published', {'map_seen': MapSeen('odom', 3, 2, 0.05, 6)}, "in 'odom'"),
    ('map.initial_pose', {'initial_pose': topic('/p', OTHER_TYPE, '', '/x')}, '/x subscribes to'),
    (
        'map.to_odom',
        {'transforms': in_order(*STATIC, *moving(), *moving('world', 'odom'))},
        'odom is below world, and map is not above it',
    ),
]  # fmt: skip


@pytest.mark.parametrize(
    ('name', 'changes', 'text'), BROKEN, ids=[f'{row[0]}-{i}' for i, row in enumerate(BROKEN)]
)
def test_a_demand_fails_on_a_robot_that_breaks_it(name, changes, text):
    found = finding(name, good_robot(**changes))
    assert (found.verdict, text in found.found) == (CheckVerdict.FAILED, True), found
    assert found.advice, 'a failure says what would do'


def test_each_demand_is_shown_to_fail():
    assert {row[0] for row in BROKEN} == {*NAMES}


def test_a_scan_may_come_before_the_tick_of_its_instant():
    early = tuple(replace(scan, received=scan.received - 2 * MS) for scan in GOOD.scans)
    assert finding('scan.age', good_robot(scans=early)).verdict is CheckVerdict.PASSED


def real_robot(lag, **changes):
    """A robot without a simulation: stamps are of the system clock."""
    ours = tuple(replace(scan, stamp=scan.received - lag) for scan in GOOD.scans)
    nodes = {'/drive': False}
    return good_robot(
        clock=ContractTopic('/clock'), ticks=(), use_sim_time=nodes, scans=ours, **changes
    )


def test_a_real_robot_needs_no_clock():
    verdicts = {found.name: found.verdict for found in examine(real_robot(50 * MS))}
    assert CheckVerdict.FAILED not in verdicts.values()
    unknown = {name for name, verdict in verdicts.items() if verdict is CheckVerdict.NOT_CHECKED}
    assert unknown == {'clock.publishers', 'clock.rate', 'clock.order', 'time.real_time_factor'}


@pytest.mark.parametrize('lag', [500 * MS, -50 * MS])
def test_the_clocks_of_a_real_robot_and_its_scans(lag):
    assert finding('scan.age', real_robot(lag)).verdict is CheckVerdict.FAILED


def test_nodes_with_simulated_time_on_a_real_robot():
    seen = replace(real_robot(0), use_sim_time={'/drive': False, '/rviz': True})
    assert 'true in /rviz' in finding('time.use_sim_time', seen).found


@pytest.mark.parametrize(
    ('name', 'changes', 'text'),
    [
        ('map.published', {'map': ContractTopic('/map')}, 'slam_toolbox or map_server publishes'),
        ('map.initial_pose', {'initial_pose': ContractTopic('/initialpose')}, 'amcl'),
        ('map.to_odom', {'transforms': (*STATIC, *moving())}, 'amcl, slam_toolbox'),
        ('slam.max_laser_range', {'parameters': {}}, 'slam_toolbox is not there'),
        ('costmap.footprint', {'parameters': {}}, 'reach 0.200 m from base_link'),
        ('costmap.footprint', {'body': None}, 'no robot_description'),
        ('costmap.footprint', {'body': Body(frozenset(), fault='no mesh')}, 'no mesh'),
        ('drive.linear', {'drive': ()}, 'give --drive'),
        ('drive.braking', {'drive': ()}, 'give --drive'),
        ('drive.progress', {'drive': ()}, 'give --drive'),
        ('odom.twist', {'odometry': odometry(speed=0.0)}, 'the robot moved 0.00 m'),
        ('tf.at_scans', {'scans': ()}, 'no scan came on /scan'),
        ('tf.others', {'body': None}, 'wheel move, and no robot_description came'),
        ('time.use_sim_time', {'use_sim_time': {}}, 'no node has said'),
        ('odom.rate', {
            'odom': topic('/odom', ODOMETRY_TYPE, '/drive', is_reliable=False),
            'odometry': (),
        }, 'no message came on /odom'),
    ],
)  # fmt: skip
def test_what_cannot_be_known_is_no_failure(name, changes, text):
    found = finding(name, good_robot(**changes))
    assert (found.verdict, text in found.found) == (CheckVerdict.NOT_CHECKED, True), found


def test_a_footprint_of_a_costmap_is_its_own():
    seen = good_robot(
        body=Body(frozenset(), 0.3, ((0.3, 0.0), (-0.3, 0.1), (-0.3, -0.1))),
        parameters={
            '/c/local_costmap': {
                'robot_radius': 0.22,
                'footprint': '[[0.3, 0.1], [-0.3, 0.1], [-0.3, -0.1], [0.3, -0.1]]',
            }
        },
    )
    assert finding('costmap.footprint', seen).verdict is CheckVerdict.PASSED


def test_scans_from_before_the_first_transform_and_after_the_last_are_not_judged():
    first, last = replace(GOOD.scans[0], wait=None), replace(GOOD.scans[-1], wait=None)
    seen = good_robot(
        scans=(first, *GOOD.scans[1:-1], last), ended=GOOD.scans[-1].received + 100 * MS
    )
    assert finding('tf.at_scans', seen).found.startswith('known at all 18 stamps')
    later = replace(seen, ended=GOOD.scans[-1].received + 300 * MS)
    assert finding('tf.at_scans', later).verdict is CheckVerdict.FAILED


def test_misses_get_a_hint_on_inf_is_valid():
    assert 'inf_is_valid' in finding('scan.range_max', GOOD).advice
    full = scans(counts=RangeCounts(hits=360))
    assert not finding('scan.range_max', good_robot(scans=full)).advice


def test_commands_elsewhere_are_named():
    elsewhere = topic('/drive/cmd_vel', STAMPED_TWIST_TYPE, '', '/drive')
    seen = good_robot(cmd_vel=ContractTopic('/cmd_vel'), other_command_topics=(elsewhere,))
    found = finding('cmd_vel.listener', seen)
    assert '/drive on /drive/cmd_vel' in found.found
    assert '-r cmd_vel:=/drive/cmd_vel' in found.advice


def test_frames_with_a_prefix_are_named():
    seen = good_robot(transforms=moving('r/odom', 'r/base_footprint'))
    assert 'r/base_footprint and r/odom would be given by' in finding('tf.frames', seen).advice


def test_the_report_has_a_line_each_and_what_never_came():
    seen = good_robot(scans=(), scan=topic('/scan', SCAN_TYPE, '/sim'))
    findings = examine(seen)
    *lines, last = as_text(findings, seen).split('\n')
    assert len(lines) == len(RULES)
    assert lines[NAMES.index('clock.rate')] == (
        'passed       clock.rate             100 Hz of simulated time or more: 100.0 Hz by /sim'
    )
    assert lines[NAMES.index('scan.published')].startswith('FAILED       scan.published ')
    assert last.endswith('nothing came on /scan')
    assert silent_topics(GOOD) == []


def test_json_says_the_same():
    seen = good_robot(odom=topic('/odom', ODOMETRY_TYPE, '/drive', is_reliable=False))
    data = json.loads(as_json(examine(seen), seen))
    assert data['holds'] is False
    assert data['counts'] == {'passed': len(RULES) - 1, 'failed': 1, 'not checked': 0}
    assert data['silent_topics'] == []
    assert [each['name'] for each in data['findings']] == NAMES
    (wrong,) = [each for each in data['findings'] if each['verdict'] == 'failed']
    assert wrong == {
        'name': 'odom.qos',
        'verdict': 'failed',
        'asked': 'nav_msgs/msg/Odometry, reliable',
        'found': '/drive publishes by best effort',
        'advice': 'publish with the default QoS: reliable, volatile',
        'source': 'OdomSmoother',
    }


def test_nodes_that_do_not_answer_are_named():
    found = finding('time.use_sim_time', good_robot(silent_nodes=('/rviz',)))
    assert found.verdict is CheckVerdict.PASSED
    assert found.found == 'use_sim_time is true in all 2 nodes; no answer of /rviz'


def test_a_topic_that_lacks_is_one_failure_and_is_looked_for_elsewhere():
    there = topic('/diff_cont/odom', ODOMETRY_TYPE, '/diff_cont')
    seen = good_robot(
        odom=ContractTopic('/odom'), odometry=(), elsewhere={ODOMETRY_TYPE: (there,)}, drive=()
    )
    (wrong,) = [found for found in examine(seen) if found.verdict is CheckVerdict.FAILED]
    assert wrong.name == 'odom.qos'
    assert wrong.found == 'nobody publishes /odom; /diff_cont on /diff_cont/odom'
    assert wrong.advice.endswith('-r odom:=/diff_cont/odom')
