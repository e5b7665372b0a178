# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A recorded drive in evo and KISS-ICP, as their users install and type them.

They are fetched, at the versions of scripts/clients.lock, and run with ``--long``; rosbags,
by which both read bags, and mcap do so in every run: test/unit/bag/test_bag_storage.py.
"""

import json
import os
import re
import subprocess
import sys
from zipfile import ZipFile

import numpy as np
import pytest
from support.needs import need
from support.paths import ROOT

from amr_description import Simulation
from amr_description.bag.reader import BagReader
from amr_description.messages.commands import plain_message

PATIENCE = 600  # s, for what fetches 80 MB
APART = 0.004
"""m that the robot drives in 10 ms, between the stamps of which evo makes a pair."""
TRUTH, ODOMETRY, CLOUDS = '/ground_truth/odom', '/odom', '/scan/points'
RINGS = """</horizontal><vertical>
    <samples>16</samples><min_angle>-0.26</min_angle><max_angle>0.26</max_angle>
</vertical>"""
pytestmark = pytest.mark.long


@pytest.fixture(scope='module')
def programs(tmp_path_factory):
    """The folder of what they are started by."""
    folder = tmp_path_factory.mktemp('clients')
    subprocess.run([sys.executable, '-m', 'venv', '--without-pip', folder], check=True)
    pip = [sys.executable, '-m', 'pip', '--python', folder / 'bin' / 'python', 'install']
    options = [
        '--no-input',
        '--no-deps',
        '--require-hashes',
        '--only-binary=:all:',
        '--quiet',
        '--no-compile',
    ]
    command = [*pip, *options, '-r', ROOT / 'scripts' / 'clients.lock']
    done = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE)
    need(done.returncode == 0, f'no evo and KISS-ICP from PyPI: {done.stderr[-300:]}')
    return folder / 'bin'


@pytest.fixture(scope='module')
def bag(tmp_path_factory):
    """A drive of an eight, 6.3 m long, by a robot with a lidar of 16 rings and no camera."""
    folder = tmp_path_factory.mktemp('drive')
    text = (ROOT / 'urdf' / 'amr_sensors.urdf.xacro').read_text()
    text = re.sub(r'<gazebo reference="camera_link">.*?</gazebo>', '', text, flags=re.DOTALL)
    text = text.replace('</horizontal>', RINGS).replace('"amr.urdf"', f'"{ROOT}/urdf/amr.urdf"')
    robot = folder / 'robot.urdf.xacro'
    robot.write_text(text)
    with Simulation(robot, world='warehouse', record=folder / 'bag') as sim:
        sim.drive(0.4, 0.8, seconds=7.85)
        sim.drive(0.4, -0.8, seconds=7.85)
    return folder / 'bag'


@pytest.fixture
def client(programs, tmp_path):
    """Run one of the programs, in an empty home; return what it prints."""

    def run(name, *words):
        variables = {
            'HOME': str(tmp_path),
            'PATH': os.defpath,
            'kiss_icp_out_dir': str(tmp_path / 'kiss'),
            'kiss_icp_data': '{"max_range": 12}',  # m, the lidar's
        }
        done = subprocess.run(
            [programs / name, *words], cwd=tmp_path, env=variables, timeout=PATIENCE,
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False,
        )  # fmt: skip
        assert done.returncode == 0, done.stdout
        return done.stdout

    return run


def positions(bag, topic):
    """Return where the robot was in each Odometry of a topic, m."""
    with BagReader(bag) as reader:
        found = [plain_message('nav_msgs/msg/Odometry', m.data) for m in reader.messages([topic])]
    return np.array([[p.x, p.y, p.z] for p in (m.pose.pose.position for m in found)])


def errors(client, tmp_path, *words):
    """Return the statistics of evo's absolute pose error, m."""
    client('evo_ape', *words, '--save_results', 'ape.zip', '--no_warnings')
    with ZipFile(tmp_path / 'ape.zip') as results:
        return json.loads(results.read('stats.json'))


def test_evo_finds_the_odometry_as_far_from_the_truth_as_it_is(bag, client, tmp_path):
    found = errors(client, tmp_path, 'bag2', bag, TRUTH, ODOMETRY)
    off = np.linalg.norm(positions(bag, ODOMETRY) - positions(bag, TRUTH), axis=1)
    assert found['rmse'] == pytest.approx(np.sqrt(np.mean(off**2)), abs=APART)
    assert found['max'] == pytest.approx(off.max(), abs=APART)
    assert 0.001 < found['rmse'] < 0.2  # of 6.3 m: the wheels slip, and nothing was hit


@pytest.mark.skipif(sys.version_info >= (3, 14), reason='KISS-ICP has no wheels for Python 3.14')
def test_kiss_icp_finds_by_the_clouds_where_the_robot_was(bag, client, tmp_path):
    client('kiss_icp_pipeline', '--topic', CLOUDS, bag)
    client('evo_traj', 'bag2', bag, TRUTH, '--save_as_tum')
    estimate = 'kiss/latest/bag_poses_tum.txt'
    with BagReader(bag) as reader:
        clouds = sum(1 for _ in reader.messages([CLOUDS]))
    assert len((tmp_path / estimate).read_text().splitlines()) == clouds > 150
    found = errors(client, tmp_path, 'tum', 'ground_truth_odom.tum', estimate, '--align')
    assert found['rmse'] < 0.03
    assert found['max'] < 0.1
