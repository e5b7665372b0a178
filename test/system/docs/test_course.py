# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""examples/course: what its grader says of no answer, of the reference, of typical wrong ones."""

import json
import os
import re
import shutil
import sys

import pytest
from support import preloaded
from support.doc_pages import Page
from support.paths import ROOT

PAGE = Page('course.md')
COURSE = ROOT / 'examples' / 'course'
REFERENCE = COURSE / 'teacher' / 'reference'
FILES = {
    '1_talker_listener': 'talker_listener.py',
    '2_robot': 'robot.urdf',
    '3_odometry': 'odometry.py',
    '4_speed_controller': 'speed_controller.py',
    '5_frames': 'frames.py',
    '6_planner': 'planner.py',
    '7_localiser': 'localiser.py',
    '8_tests': 'test_robot.py',
}
# What stands in the reference, what a student writes in its place, and what helps. One of each
# exercise is graded at a time.
WRONG = {
    '1_talker_listener': [
        ("(String, 'chatter', 10)", "(String, 'chat', 10)", 'talker publishes on /chat; /chatter'),
        ('self._count += 1', 'self._count = 1', '"Hello 1" came twice: who counts?'),
        ('create_timer(0.5', 'create_timer(2.0', 'a period of 2 s; every 0.5 s'),
    ],
    '2_robot': [
        ('izz="0.0016"', 'izz="0.16"', 'link "left_wheel": no body has this inertia'),
        ('-0.15 0" rpy="-1.5708', '-0.15 0" rpy="1.5708', 'found the axle along -y of the root'),
        (
            '<child link="right_wheel"/>',
            '<child link="right_weel"/>',
            'found "right_weel", expected',
        ),
    ],
    '3_odometry': [
        ('= wheel_radius,', '= 2.0 * wheel_radius,', 'is that the radius, or the diameter?'),
        (
            '(rolled_right - rolled_left)',
            '(rolled_left - rolled_right)',
            'to the left is positive',
        ),
        ('self._left, self._right = left, right', 'pass', 'not since the last call'),
    ],
    '4_speed_controller': [
        ('max(-most, min(change, most))', 'change', 'changes by 50 rad/s²; 2 rad/s² are allowed'),
        ('self._wanted = 0.0\n        most', 'pass\n        most', 'after 0.5 s it is to brake'),
        (
            '        self._speed.value = 0.0\n\n\n',
            '        pass\n\n\n',
            'switched off it leaves 0.50 rad/s',
        ),
    ],
    '5_frames': [
        (
            '(frame, lidar, stamp)',
            '(lidar, frame, stamp)',
            'lookup_transform(target, source, time): yours are swapped',
        ),
        ('lidar, stamp)', 'lidar, Time())', 'it takes the newest transform; the scan has a stamp'),
        ('    yaw = 2.0 *', '    yaw = 0.0 *', 'not how it is turned: the lidar looks backwards'),
    ],
    '6_planner': [
        (
            '>= TOUCHED:\n                c',
            '> 255:\n                c',
            'your way touches a wall at',
        ),
        ('grid.center_of(*each)', 'grid.center_of(*each[::-1])', 'your way ends at (0.98, 2.48)'),
        ('while waiting', 'while True', 'planner.py:21: IndexError: '),
    ],
    '7_localiser': [
        ('rad and m."""', 'rad and m."""; return', 'saw() changes nothing'),
        ('cos, sin = np.cos(yaw), np.sin(yaw)', 'cos, sin = 1.0, 0.0', 'after ten seconds your'),
        ('np.cos(yaw + angles[met])', 'np.cos(angles[met])', 'after ten seconds your'),
    ],
    '8_tests': [
        ('abs=0.0', 'abs=0.9', 'drives 0.91 m'),
        ('abs=0.05', 'abs=0.5', 'turns by 0.7 rad'),
        ('abs=0.03', 'abs=1e-9', 'fails on a robot that is sound: '),
    ],
}


def grade(tmp_path_factory, work, *options):
    """Grade a folder as the page says; return the program, and its results."""
    file = tmp_path_factory.mktemp('graded') / 'results.json'
    command = [sys.executable, '-m', 'pytest', '-q', '-p', 'no:cacheprovider', 'teacher']
    done = preloaded.run(
        [*command, '--work', str(work), '--results', str(file), *options],
        cwd=COURSE,
        env=os.environ | {'PYTEST_ADDOPTS': ''},  # those of the run that this test is of
        timeout=120.0,
    )
    return done, json.loads(file.read_text())


def points_of(results, exercise):
    return sum(test['score'] for test in results['tests'] if test['name'].startswith(exercise))


@pytest.fixture(scope='module')
def skeleton(tmp_path_factory):
    return grade(tmp_path_factory, COURSE / 'student', '-k', 'not drive')


@pytest.fixture(scope='module')
def reference(tmp_path_factory):
    return grade(tmp_path_factory, REFERENCE)


@pytest.fixture(scope='module', params=range(3))
def wrong(request, tmp_path_factory):
    """A wrong answer in each file; what is said of it, and what helps."""
    work = tmp_path_factory.mktemp('wrong') / 'work'
    shutil.copytree(REFERENCE, work)
    helps = {}
    for exercise, edits in WRONG.items():
        old, new, helps[exercise] = edits[request.param]
        text = (work / FILES[exercise]).read_text()
        assert old in text, (exercise, old)
        (work / FILES[exercise]).write_text(text.replace(old, new))
    # Its planners need not drive, too: that is two seconds each.
    return grade(tmp_path_factory, work, '-k', 'not drive')[1], helps


def test_the_reference_reaches_all_points(reference):
    done, results = reference
    assert results['score'] == 100 == sum(test['max_score'] for test in results['tests'])
    assert done.returncode == 0, done.stdout


@pytest.mark.parametrize('exercise', FILES)
def test_the_skeleton_reaches_few(skeleton, reference, exercise):
    assert points_of(skeleton[1], exercise) <= points_of(reference[1], exercise) / 3
    assert skeleton[0].returncode == 1


@pytest.mark.parametrize('exercise', FILES)
def test_a_wrong_answer_gets_what_helps(wrong, reference, exercise):
    results, helps = wrong
    assert points_of(results, exercise) < points_of(reference[1], exercise)
    said = [test['output'] for test in results['tests'] if test['name'].startswith(exercise)]
    assert any(helps[exercise] in line for line in said), said


def test_the_points_are_those_that_students_and_teachers_read(reference):
    rows = [line.split('|') for line in PAGE.text.splitlines() if re.match(r'\| \d ', line)]
    told = (COURSE / 'student' / 'README.md').read_text()
    for number, _exercise, points, *_ in (row[1:] for row in rows):
        assert points_of(reference[1], f'{number.strip()}_') == int(points)
        assert re.search(rf'^\| {number.strip()} \| .* \| {points.strip()} \|', told, re.MULTILINE)
    assert len(rows) == len(FILES)


def test_both_have_the_same_parameter_file():
    """What the students have is what they are graded with."""
    given = (COURSE / 'student' / 'robot.yaml').read_text()
    assert (COURSE / 'teacher' / 'robot.yaml').read_text() == given


def test_the_page_grades_as_the_test_does(skeleton):
    assert PAGE.blocks('bash') == [
        'cd examples/course\npython -m pytest -q teacher --work student --results results.json\n'
    ]
    assert '-- points --' in re.sub('-+', '--', re.sub('=+', '--', skeleton[0].stdout))
    assert '7_localiser            0 of  15' in skeleton[0].stdout
