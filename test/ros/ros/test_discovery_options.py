# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The profile that has Fast DDS listen before it announces."""

import os

from support.running_programs import Program

from amr_description.ros.discovery import PROFILE, use_quick_discovery, use_whole_graph

VARIABLES = ('FASTRTPS_DEFAULT_PROFILES_FILE', 'FASTDDS_DEFAULT_PROFILES_FILE')


def test_the_shipped_profile_is_handed_to_fast_dds(monkeypatch):
    for variable in VARIABLES:
        monkeypatch.delenv(variable, raising=False)
    use_quick_discovery()
    assert os.environ[VARIABLES[0]] == str(PROFILE)
    assert '<throughputController>' in PROFILE.read_text(encoding='utf-8')


def test_a_profile_of_the_users_stays(monkeypatch):
    for variable in VARIABLES:
        monkeypatch.delenv(variable, raising=False)
    monkeypatch.setenv(VARIABLES[1], '/their/profile.xml')
    use_quick_discovery()
    assert VARIABLES[0] not in os.environ


def test_through_a_discovery_server_all_is_seen_unless_a_user_says_otherwise(monkeypatch):
    monkeypatch.delenv('ROS_SUPER_CLIENT', raising=False)
    use_whole_graph()
    assert os.environ['ROS_SUPER_CLIENT'] == 'TRUE'
    monkeypatch.setenv('ROS_SUPER_CLIENT', 'FALSE')
    use_whole_graph()
    assert os.environ['ROS_SUPER_CLIENT'] == 'FALSE'


def test_fast_dds_has_no_complaint_about_the_profile():
    with Program.module('talker') as talker:
        talker.expect('Hello World: 0')
        assert 'XML' not in talker.output
