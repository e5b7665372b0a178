# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The compiled interface packages: whole, with the hashes of the originals, over real DDS."""

from contextlib import contextmanager
from importlib import import_module
import json
from pathlib import Path
import re
import signal
import subprocess
import sys

from ament_index_python.packages import get_package_prefix, get_package_share_directory
from ament_index_python.resources import get_resource
import pytest
import rclpy
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.serialization import deserialize_message, serialize_message
from support.paths import ROOT, TESTS

INTERFACES = ROOT / 'interfaces'
FIXTURES = TESTS / 'fixtures' / 'interfaces'
# The originals' hashes: control_msgs, simulation_interfaces, TFMessage and those of other packages
# as published, the rest as built by CMake and by this build alike; pal_statistics_msgs by this
# build; example_interfaces: AddTwoInts as published, the rest by this build (see the tests below);
# rosbag2_interfaces: Play, Burst and both events as published, the rest by this build.
HASHES = json.loads((FIXTURES / 'type_hashes.json').read_text())
# Of a message or a part of a service or action: its constants, and the defaults of its fields,
# which no hash tells.
CONSTANTS = json.loads((FIXTURES / 'constants.json').read_text())
PACKAGES = sorted(path.parent.name for path in INTERFACES.glob('*/package.xml'))
SOURCES = sorted(
    f'{path.parent.parent.name}/{path.parent.name}/{path.stem}'
    for package in PACKAGES
    for kind in ('msg', 'srv', 'action')
    for path in (INTERFACES / package).glob(f'{kind}/*.{kind}')
)
# std_msgs and std_srvs have them, too; these were there first, but for AddTwoInts and WString.
SAME_AS_STANDARD = [
    name
    for name in SOURCES
    if re.match('example_interfaces/(msg|srv)/(?!AddTwoInts|WString)', name)
]
FIBONACCI = {
    '_SendGoal': 'RIHS01_d1a57fb2a4afe8c21e34fb10db206f16ce6729b28531141472df92277c55b557',
    '_GetResult': 'RIHS01_1b0de0d5d29dc955d92f546706568428632771db13ec84c15ec1c1a59f424a57',
}
PATIENCE = 30.0  # s; a bound that only a broken test reaches


def python_type(name):
    package, kind, message = name.split('/')
    return getattr(import_module(f'{package}.{kind}'), message)


def test_packages_are_whole():
    wanted = [name for name in HASHES if name.split('/')[0] in PACKAGES]
    assert wanted == SOURCES


def described(name):
    share = Path(get_package_share_directory(name.split('/')[0]))
    return json.loads((share.parent / f'{name}.json').read_text())


def installed_hash(name, part=''):
    hashes = {each['type_name']: each['hash_string'] for each in described(name)['type_hashes']}
    return hashes[name + part]


@pytest.mark.parametrize('package', PACKAGES)
def test_types_have_the_hashes_of_the_originals(package):
    names = [name for name in SOURCES if name.startswith(f'{package}/')]
    built = {name: installed_hash(name) for name in names}
    assert built == {name: HASHES[name] for name in names}


def test_types_of_the_wheels_have_the_hashes_of_jazzy():
    # A wheel that is pinned too loosely would bring a later distribution's.
    others = [name for name in HASHES if name.split('/')[0] not in PACKAGES]
    assert len(others) == 11
    assert {name: installed_hash(name) for name in others} == {n: HASHES[n] for n in others}


def test_fibonacci_has_the_published_hashes_of_its_services():
    name = 'example_interfaces/action/Fibonacci'
    assert {part: installed_hash(name, part) for part in FIBONACCI} == FIBONACCI


@pytest.mark.parametrize('name', SAME_AS_STANDARD)
def test_examples_are_the_types_that_std_msgs_and_std_srvs_have(name):
    # A hash tells the name of the package, too.
    _, kind, message = name.split('/')
    package = {'msg': 'std_msgs', 'srv': 'std_srvs'}[kind]
    assert parts_of(name) == parts_of(f'{package}/{kind}/{message}')


def parts_of(name):
    whole = described(name)['type_description_msg']
    package = name.partition('/')[0]
    parts = [whole['type_description'], *whole['referenced_type_descriptions']]
    return sorted(json.dumps(part).replace(f'{package}/', '') for part in parts)


@pytest.mark.parametrize('name', SOURCES)
def test_type_support_loads(name):
    interface = python_type(name)
    interface.__class__.__import_type_support__()
    assert interface.__class__._TYPE_SUPPORT is not None


@pytest.mark.parametrize('name', CONSTANTS)
def test_constants_and_defaults_are_those_of_the_originals(name):
    interface, _, part = name.partition('.')
    message = python_type(interface)
    message = getattr(message, part)() if part else message()
    values = CONSTANTS[name]
    assert {field: getattr(message, field) for field in values} == values


def test_index_lists_packages_and_interfaces():
    for package in PACKAGES:
        assert get_resource('packages', package)[0] == ''
        listed = get_resource('rosidl_interfaces', package)[0].split()
        names = {f'{package}/{line.rpartition(".")[0]}' for line in listed}
        assert names == {name for name in SOURCES if name.startswith(f'{package}/')}


def test_libraries_look_for_others_beside_themselves_only():
    # A run path that names the build's temporary folder could be filled by anyone.
    for package in PACKAGES:
        prefix = Path(get_package_prefix(package))
        site_packages = Path(import_module(package).__file__).parents[1]
        built = [*prefix.glob(f'lib/lib{package}__*.so'), *site_packages.glob(f'{package}/*.so')]
        assert len(built) == 8
        for path in built:
            assert b'$ORIGIN' in path.read_bytes()
            assert b'amr-interfaces-' not in path.read_bytes()


def test_messages_survive_the_wire_format():
    spawn = python_type('simulation_interfaces/msg/SpawnEntity')()
    spawn.name = 'Roboter “Über”'
    spawn.entity_resource.resource_string = '<robot/>' * 1000
    spawn.initial_pose.pose.position.z = 0.2
    features = python_type('simulation_interfaces/msg/SimulatorFeatures')
    several = features(features=[features.SPAWNING, 513], spawn_formats=['urdf', 'mjcf'])
    for message in (spawn, several):
        assert deserialize_message(serialize_message(message), type(message)) == message


@pytest.fixture
def node():
    context = Context()
    rclpy.init(context=context)
    executor = SingleThreadedExecutor(context=context)
    node = rclpy.create_node('asker', context=context)
    executor.add_node(node)
    yield node
    executor.shutdown()
    node.destroy_node()
    context.try_shutdown()


@contextmanager
def peer():
    process = subprocess.Popen([sys.executable, FIXTURES / 'peer.py'])
    try:
        yield
    finally:
        process.send_signal(signal.SIGINT)
        assert process.wait(PATIENCE) == 0


def call(node, name, kind, request):
    client = node.create_client(kind, name)
    assert client.wait_for_service(PATIENCE)
    future = client.call_async(request)
    node.executor.spin_until_future_complete(future, PATIENCE)
    return future.result()


def test_topic_and_services_between_two_processes(node):
    tf_message = python_type('tf2_msgs/msg/TFMessage')
    list_controllers = python_type('controller_manager_msgs/srv/ListControllers')
    step_simulation = python_type('simulation_interfaces/srv/StepSimulation')
    received = rclpy.Future(executor=node.executor)
    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    node.create_subscription(tf_message, 'tf', received.set_result, latched)
    with peer():
        node.executor.spin_until_future_complete(received, PATIENCE)
        first, second = received.result().transforms
        assert first == second
        assert (first.header.frame_id, first.child_frame_id) == ('odom', 'base_footprint')
        assert first.transform.translation.x == 1.5
        (publisher,) = node.get_publishers_info_by_topic('tf')
        assert str(publisher.topic_type_hash) == HASHES['tf2_msgs/msg/TFMessage']

        answer = call(node, 'list_controllers', list_controllers, list_controllers.Request())
        assert [state.name for state in answer.controller] == ['drive']
        assert answer.controller[0].claimed_interfaces == ['left/velocity', 'right/velocity']
        assert answer.controller[0].chain_connections[0].reference_interfaces == ['x']

        request = step_simulation.Request(steps=7)
        answer = call(node, 'step_simulation', step_simulation, request)
        assert (answer.result.result, answer.result.error_message) == (7, 'Grüße')
