# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The rules about machine, environment and processes: hosts with each fault, and without."""

from dataclasses import replace

import pytest
from support.doctor_hosts import (
    ETHERNET,
    found,
    GIGABYTE,
    host,
    LOOPBACK,
    MACHINE,
    PYTHON,
    SIMULATOR,
)

from amr_description.doctor.host import read_host
from amr_description.doctor.host.machine import read_machine
from amr_description.doctor.observations.graph import GraphNode, ObservedGraph
from amr_description.doctor.observations.machine import Disk
from amr_description.doctor.observations.processes import SharedMemory
from amr_description.doctor.rules.environment import domain
from amr_description.doctor.table import examine

MEGABYTE = 10**6
TUNNEL = replace(ETHERNET, name='wg0', is_tunnel=True)


def disk(**changes):
    of_logs = Disk(purpose='log files', folder='/log', free=GIGABYTE, total=GIGABYTE)
    return {'disks': (replace(of_logs, **changes),)}


def python(**changes):
    return {'python': replace(PYTHON, **changes)}


def variables(**values):
    return {'variables': values}


FAULTS = {
    'c_library': [
        {'machine': {'c_library': 'glibc 2.27'}},
        {'machine': {'c_library': ''}},
        {'machine': {'architecture': 'aarch64'}},
    ],
    'python_abi': [
        {'machine': python(rclpy_suffixes=('.cpython-310-x86_64-linux-gnu.so',))},
    ],
    'rclpy_import': [
        {'machine': python(rclpy_fault='libfastrtps.so.2.14: cannot open shared object file')},
    ],
    'disk_full': [{'machine': disk(free=0)}, {'machine': disk(free=100 * MEGABYTE)}],
    'log_folder': [{'machine': disk(is_writable=False)}],
    'memory_short': [
        {'machine': {'free_memory': 100 * MEGABYTE}},
        {'machine': {'stalled_by_memory': 0.5}},
    ],
    'overloaded': [{'machine': {'load': 9.0}}],
    'loopback_down': [{'machine': {'interfaces': (replace(LOOPBACK, is_up=False), ETHERNET)}}],
    'open_network': [
        {**variables(ROS_AUTOMATIC_DISCOVERY_RANGE='SUBNET'), 'fastdds_version': '2.14.5'},
        {**variables(ROS_STATIC_PEERS='10.0.0.2'), 'fastdds_version': '2.14.5'},
        {**variables(ROS_DISCOVERY_SERVER='10.0.0.2:11811'), 'fastdds_version': '2.14.0'},
    ],
    'multicast': [
        {'machine': {'interfaces': (LOOPBACK, TUNNEL)}},
        {'machine': {'interfaces': (LOOPBACK, replace(ETHERNET, has_multicast=False))}},
    ],
    'encoding': [{'machine': {'encoding': 'ISO-8859-1'}}],
    'other_distribution': [
        variables(AMENT_PREFIX_PATH='/opt/ros/humble:/ws/install/a'),
        variables(PYTHONPATH='/opt/ros/humble/local/lib/python3.10/dist-packages'),
        variables(ROS_DISTRO='rolling'),
    ],
    'mixed_installations': [variables(LD_LIBRARY_PATH='/opt/ros/jazzy/lib')],
    'conda': [variables(CONDA_PREFIX='/conda', LD_LIBRARY_PATH='/x:/conda/lib')],
    'python_path': [variables(PYTHONPATH='/ws/install/a/lib/python3.10/site-packages')],
    'missing_prefix': [{'missing_folders': {'AMENT_PREFIX_PATH': ('/ws/install/a',)}}],
    'security': [{'file_faults': {'ROS_SECURITY_KEYSTORE': 'is not set'}}],
    'domain': [
        variables(ROS_DOMAIN_ID='233'),
        variables(ROS_DOMAIN_ID='-1'),
        variables(ROS_DOMAIN_ID='a'),
    ],
    'rmw_implementation': [
        {
            'variables': {'RMW_IMPLEMENTATION': 'rmw_cyclonedds_cpp'},
            'rmw_implementations': frozenset({'rmw_fastrtps_cpp'}),
        }
    ],
    'discovery_range': [
        variables(ROS_AUTOMATIC_DISCOVERY_RANGE='subnet'),
        variables(ROS_AUTOMATIC_DISCOVERY_RANGE='OFF'),
    ],
    'localhost_only': [
        variables(ROS_LOCALHOST_ONLY='1'),
        variables(ROS_LOCALHOST_ONLY='1', ROS_STATIC_PEERS='10.0.0.2'),
    ],
    'static_peers': [variables(ROS_STATIC_PEERS='10.0.0.2, 10.0.0.3')],
    'silent_peers': [
        {**variables(ROS_STATIC_PEERS='10.0.0.2'), 'is_alone': True, 'machine': {'firewall': name}}
        for name in ('', 'ufw', 'firewalld')
    ],
    'discovery_server': [{'unheard_servers': ('127.0.0.1:11811',)}],
    'profiles_file': [
        {
            'variables': {'FASTRTPS_DEFAULT_PROFILES_FILE': '/a.xml'},
            'file_faults': {'FASTRTPS_DEFAULT_PROFILES_FILE': 'is not there'},
        }
    ],
    'stopped_process': [{'processes': [replace(SIMULATOR, state='T')]}],
    'undiscoverable_process': [
        {
            'processes': [
                replace(SIMULATOR, variables={'ROS_AUTOMATIC_DISCOVERY_RANGE': 'OFF'}),
            ]
        }
    ],
    'other_middleware': [
        {'processes': [replace(SIMULATOR, variables={'RMW_IMPLEMENTATION': 'rmw_zenoh_cpp'})]}
    ],
    'orphaned_process': [
        {'processes': [replace(SIMULATOR, run='a-1')], 'runs': frozenset({'b-2'})}
    ],
    'other_domain': [{'processes': [replace(SIMULATOR, domain=7)], 'is_alone': True}],
    'open_files': [{'processes': [replace(SIMULATOR, open_files=1000)]}],
    'shared_memory': [{'left_memory': SharedMemory(files=('fastrtps_0',), size=100 * MEGABYTE)}],
}
HEALTHY = {
    'simulator': {'processes': [SIMULATOR]},
    'its own run': {'processes': [replace(SIMULATOR, run='a-1')], 'runs': frozenset({'a-1'})},
    'another domain beside our own': {'processes': [SIMULATOR, replace(SIMULATOR, domain=7)]},
    'another domain, nodes of other hosts': {
        'processes': [replace(SIMULATOR, domain=7)],
        'is_alone': False,
    },
    'ending of a run that has ended just now': {
        'processes': [replace(SIMULATOR, domain=None, run='a-1')]
    },
    'stopped in another domain': {'processes': [replace(SIMULATOR, domain=7, state='T')]},
    'a VPN beside the network': {'machine': {'interfaces': (LOOPBACK, ETHERNET, TUNNEL)}},
    'a VPN, and this host only': {
        'machine': {'interfaces': (LOOPBACK, TUNNEL)},
        **variables(ROS_AUTOMATIC_DISCOVERY_RANGE='LOCALHOST'),
    },
    'a VPN, and peers': {
        'machine': {'interfaces': (LOOPBACK, TUNNEL)},
        **variables(ROS_STATIC_PEERS='10.8.0.2;10.8.0.3'),
    },
    'no network at all': {'machine': {'interfaces': (LOOPBACK,)}},
    'ARM with a ROS of its own': {
        'machine': {'architecture': 'aarch64'},
        'is_from_wheels': False,
        **variables(
            ROS_DISTRO='jazzy',
            AMENT_PREFIX_PATH='/opt/ros/jazzy',
            PYTHONPATH='/opt/ros/jazzy/lib/python3.12/site-packages',
            LD_LIBRARY_PATH='/opt/ros/jazzy/lib',
        ),
    },
    'conda that is only active': variables(CONDA_PREFIX='/conda', LD_LIBRARY_PATH='/x/lib'),
    'peers, nothing observed': variables(ROS_STATIC_PEERS='10.0.0.2'),
    'peers, of which one is there': {
        **variables(ROS_STATIC_PEERS='10.0.0.2'),
        'is_alone': False,
    },
    'itself as a peer': {**variables(ROS_STATIC_PEERS='localhost;192.0.2.2'), 'is_alone': True},
    'the highest domain': variables(ROS_DOMAIN_ID='232'),
    'a default that is named': {
        'variables': {'RMW_IMPLEMENTATION': 'rmw_fastrtps_cpp'},
        'rmw_implementations': frozenset({'rmw_fastrtps_cpp'}),
        'processes': [SIMULATOR],
    },
    'a full disk of no size, as /proc': {'machine': disk(free=0, total=0)},
}


def test_a_healthy_host_has_no_finding():
    assert found(host()) == []


@pytest.mark.parametrize('changes', HEALTHY.values(), ids=HEALTHY)
def test_what_is_usual_is_no_fault(changes):
    assert found(host(**changes)) == []


@pytest.mark.parametrize(
    ('rule', 'changes'),
    [(rule, changes) for rule, hosts in FAULTS.items() for changes in hosts],
)
def test_a_fault_is_found_alone(rule, changes):
    assert found(host(**changes)) == [rule]


def test_every_rule_of_a_host_has_a_fault():
    from amr_description.doctor.rules import environment, machine, processes

    rules = [*machine.RULES, *environment.RULES, *processes.RULES]
    # The other one is below.
    assert {rule.__name__ for rule in rules} - {'clock_unsynchronised'} == FAULTS.keys()


def test_the_severity_tells_a_full_disk_from_one_that_is_nearly_full():
    (full,) = examine(host(machine=disk(free=0)))
    (nearly,) = examine(host(machine=disk(free=100 * MEGABYTE)))
    assert (full.severity, nearly.severity) == ('error', 'warning')


def test_a_stopped_node_that_the_graph_shows_is_not_named_twice():
    seen = host(processes=[replace(SIMULATOR, state='T')])
    graph = ObservedGraph(nodes=(GraphNode(name='/mujoco_sim', process=100, is_stopped=True),))
    assert 'stopped_process' not in found(replace(seen, graph=graph))


@pytest.mark.parametrize(
    ('is_right', 'host_name', 'expected'),
    [
        (False, '10.0.0.2', ['clock_unsynchronised']),
        (False, '', []),
        (None, '10.0.0.2', []),
        (True, '10.0.0.2', []),
    ],
)
def test_a_clock_that_nobody_sets_matters_where_hosts_meet(is_right, host_name, expected):
    seen = host(machine={'is_clock_synchronised': is_right})
    graph = ObservedGraph(nodes=(GraphNode(name='/a', host=host_name),))
    names = {'clock_unsynchronised'}.intersection(found(replace(seen, graph=graph)))
    assert [*names] == expected


def test_a_fix_of_peers_can_be_pasted():
    (finding,) = examine(host(**FAULTS['static_peers'][0]))
    assert finding.fix == "export ROS_STATIC_PEERS='10.0.0.2;10.0.0.3'"


def test_the_version_of_python_is_named():
    (finding,) = examine(host(**FAULTS['python_abi'][0]))
    assert 'compiled for CPython 3.10' in finding.what


def test_unobserved_sections_are_left_out():
    seen = replace(host(), machine=MACHINE, environment=None, processes=None)
    assert found(seen) == []
    assert [*domain(seen)] == []


def test_folders_that_cannot_be_looked_at_end_no_doctor(tmp_path, monkeypatch):
    gone = tmp_path / 'gone'
    gone.mkdir()
    monkeypatch.chdir(gone)
    gone.rmdir()
    too_long = 'x' * 5000
    variables = {
        'ROS_LOG_DIR': f'/{too_long}',
        'AMENT_PREFIX_PATH': f'/{too_long}',
        'ROS_SECURITY_ENABLE': 'true',
        'ROS_SECURITY_STRATEGY': 'Enforce',
        'ROS_SECURITY_KEYSTORE': f'/{too_long}',
        'ROS_DOMAIN_ID': '9' * 5000,
    }
    seen = read_host(variables)
    assert 'the current folder' not in {each.purpose for each in seen['machine'].disks}
    assert seen['processes'].domain == 0
    monkeypatch.chdir('/')


def test_a_user_without_a_home_has_no_log_folder(monkeypatch):
    monkeypatch.setattr('os.path.expanduser', lambda path: path)
    disks = read_machine({}).disks
    assert [each.purpose for each in disks] == ['the current folder', 'shared memory']
