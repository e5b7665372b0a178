# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
docs/two_machines.md: its lines typed on machines of their own, joined by a cable or by a router.

The machines are Linux namespaces (``machines.py``); where this user may make none, the tests are
not run, and ``scripts/test`` says so and why.
"""

from contextlib import contextmanager, ExitStack
import re

import pytest
from support import machines
from support.doc_pages import Page
from support.needs import need
from support.shells import CTRL_C, PROMPT, terminal

PAGE = Page('two_machines.md')
CHAPTERS = dict(re.findall(r'^## (.*?)\n(.*?)(?=^## |\Z)', PAGE.text, re.DOTALL | re.MULTILINE))
ECHO = 'ros2 topic echo'
DRIVE = 'ros2 topic pub'


@pytest.fixture(scope='module', autouse=True)
def namespaces():
    """What these tests need of the machine they run on."""
    need(not machines.missing(), f'{machines.missing()}')
    if refused := machines.refusal():
        pytest.skip(refused)  # also in CI: no package would change it


@contextmanager
def person(machine, chapter, *first):
    """One at a terminal of a machine who reads a chapter, and has typed its first lines."""
    activate = 'source scripts/activate' if first else ''
    with terminal(CHAPTERS[chapter], activate=activate, machine=machine.inside()) as shell:
        for line in first:
            shell.run(line)
        yield shell


@contextmanager
def robot(machine, chapter, line):
    """The line that brings the robot up, which goes on; everything has ended afterwards."""
    with person(machine, chapter) as shell:
        shell.start(line)
        yield shell
        shell.press(CTRL_C)
        assert 'ended what was left' not in shell.see(re.escape(PROMPT)).string


def wait_until_up(shell):
    shell.see(r'\[create-3\]: process has finished cleanly')
    shell.see(r'ready in \d+\.\d s: open the page')
    shell.see(re.escape('Ctrl-C stops all.'))


def x(shell, line=ECHO):
    """The robot's x on /odom, m, by the line of the page."""
    return float(re.search(r'^x: (\S+)$', shell.run(line), re.MULTILINE)[1])


class TestOneRobot:
    """Whom an operator at its switch drives, and another from behind a router."""

    @pytest.fixture(scope='class')
    @classmethod
    def operators(cls):
        """One at the switch, at a terminal, and the machine of the other; the robot is at 0."""
        chapter = 'In one network'
        with machines.two_networks() as (first, second), ExitStack() as stack:
            beside = stack.enter_context(machines.Machine(first))
            first.cable_to(beside, '192.168.6.1/24', '192.168.6.2/24')
            shell = stack.enter_context(robot(first, chapter, 'scripts/run '))
            operator = stack.enter_context(person(beside, chapter, 'export '))
            wait_until_up(shell)
            assert x(operator) == pytest.approx(0.0, abs=0.05)
            yield operator, second

    @pytest.mark.long
    def test_one_network(self, operators):
        operator, _ = operators
        before = x(operator)
        operator.run(DRIVE)
        assert x(operator) > before + 0.3
        operator.start('ros2 run amr_description teleop_twist_keyboard ')
        operator.see(r'currently:\s+speed 0\.5\s+turn 1\.0')
        operator.interrupt()

    def test_a_router_and_an_address(self, operators):
        _, second = operators
        exports = ('export ROS_AUTOMATIC_DISCOVERY_RANGE=', 'export ROS_STATIC_PEERS=')
        with person(second, 'Through a router', *exports) as operator:
            before = x(operator)
            operator.run(DRIVE)
            assert x(operator) > before + 0.3


def test_this_host_only_is_the_default():
    chapter = 'In one network'
    with machines.one_network() as (first, second), ExitStack() as stack:
        host = stack.enter_context(person(first, chapter, 'source '))
        host.type('ros2 run amr_description talker')
        host.see('Publishing')
        assert multicasts(first) == 0  # it has announced itself at once; then every 3 s
        assert '/topic\n' not in topics(stack.enter_context(person(second, chapter, 'export ')))
        assert '/topic\n' in topics(stack.enter_context(person(first, chapter, 'source ')))
        host.interrupt()


def multicasts(machine):
    """How many packets it has sent to groups of machines, since it was there."""
    table = machine.do('cat', '/proc/net/netstat')
    names, values = (line.split() for line in table.splitlines() if line.startswith('IpExt:'))
    return int(dict(zip(names, values, strict=True))['OutMcastPkts'])


def topics(shell):
    """What a person sees of others, who are found in less than half a second if at all."""
    shell.book = 'ros2 topic list --spin-time 1'
    return shell.run('ros2')


@pytest.mark.long
def test_a_router_and_a_discovery_server():
    chapter = 'Through a router'
    with machines.two_networks() as (first, second), ExitStack() as stack:
        server = stack.enter_context(person(first, chapter, 'source '))
        server.start('fastdds discovery ')
        server.see('Server is running')
        shell = stack.enter_context(robot(first, chapter, 'scripts/run '))
        operator = stack.enter_context(person(second, chapter, 'export ROS_DISCOVERY_SERVER='))
        wait_until_up(shell)
        assert {'/odom', '/tf', '/clock'} <= set(operator.run('ros2 topic list').split())
        operator.run(DRIVE)
        assert x(operator) > 0.3
        server.press(CTRL_C)
        server.see(re.escape(PROMPT))


@pytest.mark.long
def test_a_robot_on_each_of_two_hosts():
    chapter = 'Several robots'
    with machines.one_network() as (first, second), ExitStack() as stack:
        line = 'scripts/run simulation --discovery subnet --domain {}'
        robots = [
            stack.enter_context(robot(machine, chapter, line.format(domain)))
            for machine, domain in ((first, 11), (second, 12))
        ]
        operator = stack.enter_context(person(second, chapter, 'export '))
        for shell in robots:
            wait_until_up(shell)
        operator.run(f'ROS_DOMAIN_ID=11 {DRIVE}')
        assert x(operator, f'ROS_DOMAIN_ID=11 {ECHO}') > 0.3
        assert x(operator, f'ROS_DOMAIN_ID=12 {ECHO}') == pytest.approx(0.0, abs=0.05)
