# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The environment of a set-up from nothing."""

from pathlib import Path

from benchmarks.environment import without_checkout


def test_nothing_of_the_checkout_is_left():
    environment = {
        'HOME': '/home/a',
        'PATH': '/w/robot/.venv/bin:/usr/bin:/w/robot/install/bin:/w/robot2/bin',
        'AMENT_PREFIX_PATH': '/w/robot/install',
        'VIRTUAL_ENV': '/w/robot/.venv',
        'PYTHONUNBUFFERED': '1',
        'ROS_DOMAIN_ID': '7',
        'AMR_ALONE': '1',
    }
    assert without_checkout(environment, Path('/w/robot')) == {
        'HOME': '/home/a',
        'PATH': '/usr/bin:/w/robot2/bin',
        'ROS_DOMAIN_ID': '7',
        'AMR_ALONE': '1',
    }
