# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The programs of tf2: their words, their texts, and they themselves over real DDS."""

import math
import os
import signal
import subprocess
import sys

import pytest
import rclpy
from rclpy.node import Node
from rclpy.time import Time
from support.paths import EXECUTABLES
from support.running_programs import Program

from amr_description.cli.run import STAND_INS
from amr_description.clock import NANOSECONDS
from amr_description.errors import UsageError
from amr_description.model.frames import quaternion_from_rpy, Transform
from amr_description.nodes import static_transform_publisher, tf2_echo, view_frames
from amr_description.nodes.tf2_echo import EchoRequest
from amr_description.ros.runtime import spinning
from amr_description.ros.service_calls import wait_until
from amr_description.tf2_ros.broadcaster import TransformBroadcaster
from amr_description.tf2_ros.buffer import Buffer, transform_message
from amr_description.tf2_ros.listener import TransformListener
from amr_description.tf2_ros.time_cache import StampedTransform

# tf2_echo


@pytest.mark.parametrize(
    ('words', 'request_'),
    [
        ('a b', EchoRequest('a', 'b')),
        ('a b 10', EchoRequest('a', 'b', rate=10.0)),
        ('a b -r 0.5 -p 6 --once', EchoRequest('a', 'b', rate=0.5, precision=6, once=True)),
        ('-t 1630223704.616726054 a b', EchoRequest('a', 'b', time=1_630_223_704_616_726_054)),
        ('a', None),
        ('', None),
    ],
)
def test_echo_reads_its_words(words, request_):
    assert tf2_echo.parse(words.split()) == request_


@pytest.mark.parametrize(
    ('words', 'code', 'said'),
    [
        ('a b fast', 2, "Failed to convert rate argument 'fast' to a floating-point number"),
        ('a b -r 1x', 2, "Failed to convert rate argument '1x' to a floating-point number"),
        ('a b -r nan', 2, "Failed to convert rate argument 'nan' to"),
        ('a b 0', 2, "Rate must be positive, not '0'"),
        ('a b -t now', 3, "Failed to convert time argument 'now' to a floating-point number"),
        ('a b -t -1', 3, "Time must be non-negative, not '-1'"),
        ('a b -p 1.5', 4, "Failed to convert precision argument '1.5' to an integer"),
        ('a b -p -1', 4, "Precision must be non-negative, not '-1'"),
        ('a b -p 99', 4, 'Precision must be at most 17'),
        ('a b 1 c', 5, 'Unknown argument: c: see'),
        ('a b --fast', 5, 'Unknown argument: --fast: see'),
        ('a b -r', 5, '-r needs a value'),
    ],
)
def test_echo_reports_what_it_cannot_read(words, code, said):
    with pytest.raises(UsageError, match=f'^{said}') as error:
        tf2_echo.parse(words.split())
    assert error.value.exit_code == code


def test_echo_writes_as_the_original():
    """The example of tf2's manual: static_transform_publisher 1 2 3 0.5 0.1 -1.0 foo bar."""
    transform = Transform((1.0, 2.0, 3.0), quaternion_from_rpy(-1.0, 0.1, 0.5))
    assert tf2_echo.text_of(StampedTransform('foo', 'bar', 0, transform)).splitlines() == [
        'At time 0.0',
        '- Translation: [1.000, 2.000, 3.000]',
        '- Rotation: in Quaternion (xyzw) [-0.475, -0.076, 0.240, 0.843]',
        '- Rotation: in RPY (radian) [-1.000, 0.100, 0.500]',
        '- Rotation: in RPY (degree) [-57.296, 5.730, 28.648]',
        '- Matrix:',
        '  0.873 -0.333 -0.356  1.000',
        '  0.477  0.434  0.764  2.000',
        ' -0.100 -0.837  0.538  3.000',
        '  0.000  0.000  0.000  1.000',
    ]


def test_echo_writes_stamps_with_their_zeros_and_no_negative_zero():
    tiny = Transform((-1e-9, 0.0, 0.0))
    lines = tf2_echo.text_of(StampedTransform('a', 'b', 5_000_000_003, tiny), 1).splitlines()
    assert lines[:2] == ['At time 5.000000003', '- Translation: [0.0, 0.0, 0.0]']
    assert '-0.0' not in '\n'.join(lines)


# static_transform_publisher


def placed(*place, turn=(0.0, 0.0, 0.0, 1.0)):
    return static_transform_publisher.StaticTransform('foo', 'bar', Transform(place, turn))


FRAMES = ['--frame-id', 'foo', '--child-frame-id', 'bar']


@pytest.mark.parametrize(
    ('words', 'request_'),
    [
        ('', placed(0.0, 0.0, 0.0)),
        ('--x 1 --y -2 --z 3e-1', placed(1.0, -2.0, 0.3)),
        (
            '--roll 1 --yaw 3',
            placed(0.0, 0.0, 0.0, turn=quaternion_from_rpy(1.0, 0.0, 3.0)),
        ),
        ('--qz 1 --qw 0', placed(0.0, 0.0, 0.0, turn=(0.0, 0.0, 1.0, 0.0))),
    ],
)
def test_the_publisher_reads_flags(words, request_):
    assert static_transform_publisher.parse([*words.split(), *FRAMES]) == request_


@pytest.mark.parametrize(
    ('words', 'request_'),
    [
        (
            '1 2 3 0.5 0.1 -1.0 foo bar',
            placed(1.0, 2.0, 3.0, turn=quaternion_from_rpy(-1.0, 0.1, 0.5)),
        ),
        ('1 2 3 0 0 1 0 foo bar', placed(1.0, 2.0, 3.0, turn=(0.0, 0.0, 1.0, 0.0))),
    ],
)
def test_the_publisher_reads_the_old_form_with_a_warning(words, request_):
    warnings = []
    assert static_transform_publisher.parse(words.split(), warnings.append) == request_
    assert warnings == ['Old-style arguments are deprecated; see --help for new-style arguments']


@pytest.mark.parametrize(
    ('words', 'said'),
    [
        ('--x', 'Not enough arguments for --x'),
        ('--x 1m --frame-id a', "Failed to parse --x argument as float: '1m'"),
        ('--x nan --frame-id a', "Failed to parse --x argument as float: 'nan'"),
        ('--child-frame-id a', 'Frame id must not be empty'),
        ('--frame-id a', 'Child frame id must not be empty'),
        ('1 2 3', 'Extra unparsed arguments on command-line: 1 2 3'),
        ('--X 3 --frame-id a', 'Extra unparsed arguments on command-line: --X 3'),
        ('--qx 1 --yaw 1 --frame-id a', 'Cannot specify both quaternion and Euler rotations'),
        ('0 0 0 0 0 0 a b --x 1', 'Cannot specify both new-style'),
        ('--frame-id a --child-frame-id /a', "cannot publish static transform from 'a' to '/a'"),
        (
            '--qz 0.7 --qw 0.7 --frame-id a --child-frame-id b',
            r'The quaternion \(0.0, 0.0, 0.7, 0.7\) .* length 0.989949 instead of 1, '
            r'.*; of length 1 is \(0.0, 0.0, 0.707',
        ),
        ('0 0 0 0 0 0 0 a b', 'The quaternion .* the length 0 instead of 1, .* transform$'),
    ],
)
def test_the_publisher_reports_what_it_cannot_read(words, said):
    with pytest.raises(
        static_transform_publisher.TransformArgumentsError, match=f'^{said}'
    ) as error:
        static_transform_publisher.parse(words.split())
    assert error.value.exit_code == 1


# All of them over DDS


class Turntable(Node):
    """Moves ``base`` in ``odom``, half a turn a second, at 20 Hz."""

    def __init__(self):
        super().__init__('turntable')
        self._broadcaster = TransformBroadcaster(self)
        self._timer = self.create_timer(0.05, self._send)

    def _send(self):
        now = self.get_clock().now().nanoseconds
        turn = quaternion_from_rpy(0.0, 0.0, math.pi * now / NANOSECONDS)
        pose = Transform((1.0, 0.0, 0.0), turn)
        self._broadcaster.sendTransform(
            transform_message(StampedTransform('odom', 'base', now, pose))
        )


@pytest.fixture(scope='module')
def frames():
    """odom -> base from this process, base -> laser from a static_transform_publisher."""
    words = [
        '--z',
        '0.3',
        '--yaw',
        '1.57079632679',
        '--frame-id',
        'base',
        '--child-frame-id',
        'laser',
    ]
    rclpy.init(args=[])
    with (
        Program.module('static_transform_publisher', *words) as publisher,
        spinning(Turntable()),
    ):
        publisher.expect(r'Spinning until stopped - publishing transform\n')
        yield publisher
        assert publisher.end(signal.SIGINT) == 0
    rclpy.try_shutdown()


def test_the_publisher_logs_what_it_publishes_and_all_receive_it(frames):
    frames.expect(
        r'\[static_transform_publisher_\w{16}\]: Spinning until stopped - publishing transform\n'
        r"translation: \('0\.000000', '0\.000000', '0\.300000'\)\n"
        r"rotation: \('0\.000000', '0\.000000', '0\.707107', '0\.707107'\)\n"
        r"from 'base' to 'laser'\n"
    )
    node, buffer = Node('hearer'), Buffer()
    listener = TransformListener(buffer, node)
    ready = wait_until(
        node, lambda: buffer.can_transform('odom', 'laser', Time()) or None, timeout=20.0
    )
    assert ready
    found = buffer.lookup_transform('odom', 'laser', Time()).transform.translation
    assert (found.x, found.y, found.z) == (1.0, 0.0, 0.3)
    listener.unregister()
    node.destroy_node()


def test_echo_waits_and_then_prints_until_ctrl_c(frames):
    with Program.module('tf2_echo', 'base', 'laser', '50') as echo:
        block = (
            r'At time 0\.0\n'
            r'- Translation: \[0\.000, 0\.000, 0\.300\]\n'
            r'- Rotation: in Quaternion \(xyzw\) \[0\.000, 0\.000, 0\.707, 0\.707\]\n'
            r'- Rotation: in RPY \(radian\) \[0\.000, 0\.000, 1\.571\]\n'
            r'- Rotation: in RPY \(degree\) \[0\.000, 0\.000, 90\.000\]\n'
            r'- Matrix:\n'
            r'  0\.000 -1\.000  0\.000  0\.000\n'
        )
        first = echo.expect(block)
        echo.expect(block, since=first.end())
        assert echo.end(signal.SIGINT) == 0
        assert 'Traceback' not in echo.output


def test_echo_prints_once_what_moves(frames):
    with Program.module('tf2_echo', 'odom', 'laser', '--once') as echo:
        assert echo.end() == 0
        assert echo.output.count('At time ') == 1
        echo.expect(r'At time \d{10}\.\d{9}\n- Translation: \[1\.000, 0\.000, 0\.300\]')


def test_echo_prints_what_it_waits_for(frames):
    with Program.module('tf2_echo', 'base', 'lazer') as echo:
        echo.expect(
            r'\[tf2_echo\]: Waiting for transform base ->  lazer: Invalid frame ID "lazer" passed '
            r"to canTransform argument source_frame - frame does not exist. Did you mean 'laser'\?"
        )
        assert echo.end(signal.SIGINT) == 0
        assert 'At time' not in echo.output


def test_monitor_prints_what_it_gathers_and_ends_cleanly(frames):
    with Program.module('tf2_monitor', 'odom', 'laser') as monitor:
        monitor.expect(r'Gathering data on odom -> laser for 10 seconds\.\.\.\n')
        assert monitor.end(signal.SIGINT) == 0
        assert 'Traceback' not in monitor.output


def test_view_frames_writes_three_files(frames, tmp_path):
    with Program.module('view_frames', '-t', '4', '-o', 'robot', cwd=tmp_path) as view:
        assert view.end() == 0
        view.expect(r'\[view_frames\]: Listening to tf data for 4\.0 seconds\.\.\.\n')
        view.expect(r'\[view_frames\]: Exporting graph in robot\.pdf file\.\.\.\n')
        view.expect(
            r'\nodom\n└── base: [\d.]+ Hz, /turntable\n'
            r'    └── laser: static, /static_transform_publisher_\w{16}\n'
        )
    assert {path.name for path in tmp_path.iterdir()} == {'robot.gv', 'robot.pdf', 'robot.svg'}
    assert (
        '"odom" -> "base"[label=" Broadcaster: /turntable\\n'
        in (tmp_path / 'robot.gv').read_text()
    )
    assert '>laser</text>' in (tmp_path / 'robot.svg').read_text()


def test_view_frames_does_not_listen_for_what_it_may_not_write(monkeypatch, tmp_path):
    monkeypatch.setattr(os, 'access', lambda path, mode: False)  # root may write everywhere
    with pytest.raises(UsageError, match=f"no permission to write into '{tmp_path}'"):
        view_frames.view(['-o', str(tmp_path / 'robot')])


def test_names_that_the_terminal_cannot_show_are_spelt_out():
    code = (
        'from amr_description.tf2_ros.tools import print_now, run_tool\n'
        'raise SystemExit(run_tool(lambda: print_now("las\\xe9r")))'
    )
    done = subprocess.run(
        (sys.executable, '-c', code),
        env={**os.environ, 'PYTHONPATH': os.pathsep.join(sys.path), 'PYTHONIOENCODING': 'ascii'},
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert (done.returncode, done.stdout) == (0, 'las\\xe9r\n'), done.stderr


@pytest.mark.parametrize(
    ('program', 'words', 'code', 'said'),
    [
        ('tf2_echo', ['a'], 1, 'Usage: tf2_echo source_frame target_frame'),
        ('tf2_echo', ['a', 'b', '-r', 'x'], 2, 'Failed to convert rate argument'),
        ('tf2_monitor', ['a'], 1, 'TF_Monitor: usage: tf2_monitor'),
        ('view_frames', ['-t', 'x'], 2, "argument --wait-time/-t: 'x' is no time in s"),
        ('view_frames', ['-o', '/nowhere/a'], 2, "there is no folder '/nowhere'"),
        ('static_transform_publisher', ['--x'], 1, 'error parsing command line arguments: Not'),
        ('static_transform_publisher', ['--help'], 0, 'usage: static_transform_publisher'),
    ],
)
def test_malformed_arguments_are_reported(program, words, code, said):
    with Program.module(program, *words) as running:
        assert running.end() == code
        assert said in running.output
        assert 'Traceback' not in running.output


def test_the_programs_stand_in_for_those_of_tf2():
    ours = {
        name: STAND_INS['tf2_ros', name]
        for name in ('tf2_echo', 'tf2_monitor', 'static_transform_publisher')
    } | {'view_frames': STAND_INS['tf2_tools', 'view_frames']}
    for name, stand_in in ours.items():
        assert EXECUTABLES[stand_in] == f'amr_description.entry:nodes.{name}.main'
