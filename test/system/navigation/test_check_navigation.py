# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``check_navigation`` without a robot; of the shipped one: ``test_navigation_stack.py``."""

import signal

import pytest
from support.running_programs import Program

LONG = ('--duration', '120')
"""On a busy machine."""


def check(*options):
    return Program.module('check_navigation', *options)


def test_ctrl_c_while_it_waits():
    with check(*LONG, '--ros-args', '-r', '__ns:=/nobody') as program:
        program.expect(r'waiting for /nobody/odom \(0 of 20\), /nobody/scan \(0 of 20\)')
        assert program.end(signal.SIGINT) == 130
        assert 'Traceback' not in program.output


@pytest.mark.parametrize(
    ('words', 'text'),
    [
        (['--duration', '-1'], "'-1' is no number above 0"),
        (['--duration', 'long'], "'long' is no number above 0"),
        (['--fast'], 'unrecognized arguments: --fast'),
    ],
)
def test_wrong_options(words, text):
    with check(*words) as program:
        assert program.end() == 2
        assert text in program.output
