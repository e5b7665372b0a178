# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The graph itself for the page: topics, TF, the log, parameters and what pages publish."""

import asyncio
import math
import time

from geometry_msgs.msg import TransformStamped, Twist, TwistStamped
import pytest
from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor, SetParametersResult
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import Float64
from support import waiting
from support.ros_processes import PATIENCE
from support.serving import serving
from tf2_msgs.msg import TFMessage

from amr_description.errors import AmrError
from amr_description.launch_log import LAUNCH_LOG
from amr_description.ros.qos import TF_STATIC
from amr_description.viewer.requests import (
    Definition,
    ListParameters,
    Publish,
    SetParameter,
)
from amr_description.viewer.ros import health
from amr_description.viewer.ros.forms import define
from amr_description.viewer.ros.introspection import Introspection
from amr_description.viewer.ros.parameters import ParameterClients
from amr_description.viewer.ros.publications import Publications
from amr_description.viewer.ros.service_clients import ServiceClients


@pytest.fixture(scope='module')
def ros():
    """The node of the viewer, and another one with parameters, in one executor."""
    rclpy.init(args=[])
    viewer, other = Node('viewer'), Node('other', namespace='/robot1')
    described = ParameterDescriptor(
        description='how fast',
        floating_point_range=[FloatingPointRange(from_value=0.0, to_value=2.0, step=0.5)],
    )
    other.declare_parameter('speed', 1.0, described)
    other.declare_parameter('names', ['a', 'b'])
    other.declare_parameter('fixed', 7, ParameterDescriptor(read_only=True))
    other.declare_parameter('nothing', descriptor=ParameterDescriptor(dynamic_typing=True))
    other.add_on_set_parameters_callback(
        lambda parameters: SetParametersResult(
            successful=all(each.value != ['no'] for each in parameters), reason='not\nthat name'
        )
    )
    executor = SingleThreadedExecutor()
    executor.add_node(viewer)
    executor.add_node(other)
    with serving(executor):
        yield viewer, other, executor
    viewer.destroy_node()
    other.destroy_node()
    rclpy.try_shutdown()


@pytest.fixture
def shown(ros):
    """What an Introspection tells, and it."""
    told = []
    introspection = Introspection(ros[0], lambda part, message: told.append((part, message)))
    introspection.open()
    yield introspection, told
    introspection.close()


def until(introspection, told, condition):
    """Poll until a message of those told makes a condition true; return that."""

    def found():
        introspection.poll()
        return next(filter(None, (condition(message) for _, message in reversed(told))), None)

    return waiting.until(found, shown=lambda: told[-1:])


def test_topics_are_listed_by_nodes_with_qos_and_rates(ros, shown):
    viewer, other, _ = ros
    introspection, told = shown
    publisher = other.create_publisher(Float64, '/speed', 10)
    hearer = viewer.create_subscription(Float64, '/speed', lambda _: None, 10)
    introspection.watch({'topics', 'rates'}, ())

    def speed(message):
        publisher.publish(Float64())
        found = {each.name: each for each in message.topics}.get('/speed')
        return found if found and found.rate else None

    found = until(introspection, told, speed)
    assert found.kinds == ('std_msgs/msg/Float64',)
    assert [(each.node, each.qos) for each in found.publishers] == [
        ('/robot1/other', 'reliable, volatile')
    ]
    assert found.subscriptions == (), 'what the viewer itself has is left out'
    assert '/robot1/other' in told[-1][1].nodes
    assert introspection.latest('topics') == told[-1][1]
    viewer.destroy_subscription(hearer)
    other.destroy_publisher(publisher)


def test_there_is_a_rate_of_several_publishers_that_keep_their_last_message(ros, shown):
    _, other, _ = ros
    introspection, told = shown
    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    publishers = [other.create_publisher(Float64, '/speed', latched) for _ in range(2)]
    introspection.watch({'topics', 'rates'}, ())

    def speed(message):
        for publisher in publishers:
            publisher.publish(Float64())
        found = {each.name: each for each in message.topics}.get('/speed')
        return found if found and found.rate else None

    assert len(until(introspection, told, speed).publishers) == 2
    for publisher in publishers:
        other.destroy_publisher(publisher)


def test_frames_are_listed_with_two_parents_marked(ros, shown):
    _, other, _ = ros
    introspection, told = shown
    publisher = other.create_publisher(TFMessage, '/tf', 100)

    def send(parent):
        transform = TransformStamped(child_frame_id='base')
        transform.header.frame_id = parent
        publisher.publish(TFMessage(transforms=[transform]))

    introspection.watch({'transforms'}, ())

    def base(message):
        send('odom')
        send('map')
        found = {each.name: each for each in message.frames}.get('base')
        return found if found and found.rate and len(found.parents) > 1 else None

    found = until(introspection, told, base)
    assert {*found.parents} == {'odom', 'map'}
    assert (found.is_static, found.topics) == (False, ('/tf',))
    assert 0.0 <= found.age < PATIENCE
    assert '/robot1/other' in told[-1][1].publishers['/tf']
    other.destroy_publisher(publisher)


@pytest.mark.parametrize('static_is_first', [True, False])
def test_a_static_parent_beside_a_moving_one_is_marked(ros, shown, static_is_first):
    _, other, _ = ros
    introspection, told = shown
    static = other.create_publisher(TFMessage, '/tf_static', TF_STATIC)
    moving = other.create_publisher(TFMessage, '/tf', 100)

    def send(publisher, parent):
        transform = TransformStamped(child_frame_id='base')
        transform.header.frame_id = parent
        publisher.publish(TFMessage(transforms=[transform]))

    def base(message):
        if not static_is_first and len(seen) == 1:
            send(static, 'footprint')
        send(moving, 'odom')
        found = {each.name: each for each in message.frames}.get('base')
        if found is not None:
            seen.add(found.parents)
        return found if found and len(found.parents) > 1 else None

    seen = set()
    if static_is_first:
        send(static, 'footprint')
    introspection.watch({'transforms'}, ())
    found = until(introspection, told, base)
    assert (found.parent, found.parents) == ('odom', ('odom', 'footprint'))
    assert (found.is_static, found.topics) == (False, ('/tf', '/tf_static'))
    other.destroy_publisher(static)
    other.destroy_publisher(moving)


def test_warnings_are_kept_and_all_lines_are_told_to_who_looks(ros, shown):
    _, other, _ = ros
    introspection, told = shown
    other.get_logger().info('all is well')
    other.get_logger().warning('<b>the wheel</b> slips')

    def slips():  # the log may have warnings of other tests, too
        introspection.poll()
        return [each for each in introspection.latest('log').lines if 'slips' in each.text]

    (kept,) = waiting.until(slips)
    assert told == []
    assert (kept.level, kept.node) == ('warning', 'robot1.other')
    assert kept.text == '<b>the wheel</b> slips'
    introspection.watch({'log'}, ())
    other.get_logger().info('once more')
    lines = until(introspection, told, lambda log: [x for x in log.lines if x.text == 'once more'])
    assert lines[0].number > kept.number


@pytest.fixture
def parameters(ros):
    viewer, _, executor = ros
    services = ServiceClients(viewer)
    yield ParameterClients(services, executor)
    executor.create_task(services.set_more, {})


def test_what_the_bring_up_warned_of_before_is_there(ros, tmp_path, monkeypatch):
    log = tmp_path / 'launch.log'
    log.write_text('1795411302.5 [WARNING] [launch]: look\n1795411302.6 [INFO] [launch]: no\n')
    monkeypatch.setenv(LAUNCH_LOG, str(log))
    introspection = Introspection(ros[0], lambda part, message: None)
    introspection.open()
    (line, *_) = introspection.latest('log').lines
    introspection.close()
    assert (line.stamp, line.level, line.node, line.text) == (
        1795411302.5, 'warning', 'launch', 'look'
    )  # fmt: skip


def test_parameters_are_listed_with_bounds_and_set(parameters):
    async def use():
        node = '/robot1/other'
        listed = await parameters.list_all(ListParameters(1, node), 'page 1')
        request = SetParameter(2, node, 'speed', 'double', 1.5)
        return listed, await parameters.set(request, 'page 1')

    answer, taken = asyncio.run(use())
    assert answer.message == f'/robot1/other has {len(answer.data)} parameters'
    assert taken.message == '/robot1/other has taken speed'
    listed, speed = {each.name: each for each in answer.data}, taken.data
    before = listed['speed']
    assert (before.value, before.lower, before.upper, before.step) == (1.0, 0.0, 2.0, 0.5)
    assert (before.kind, before.description) == ('double', 'how fast')
    assert (listed['names'].kind, listed['names'].value) == ('string_array', ['a', 'b'])
    assert (listed['fixed'].read_only, listed['fixed'].kind) == (True, 'integer')
    assert (listed['nothing'].kind, listed['nothing'].value) == ('not set', None)
    assert speed.value == 1.5


def test_pages_may_ask_two_nodes_at_once(parameters):
    async def use():
        nodes = ('/robot1/other', '/viewer')
        requests = [ListParameters(1, each) for each in nodes]
        return await asyncio.gather(*(parameters.list_all(each, 'page 1') for each in requests))

    other, viewer = ({each.name for each in listed.data} for listed in asyncio.run(use()))
    assert {'speed', 'use_sim_time'} <= other
    assert 'use_sim_time' in viewer
    assert 'speed' not in viewer


@pytest.mark.parametrize(
    ('name', 'kind', 'value', 'reason'),
    [
        ('speed', 'double', 9.0, '/robot1/other refuses speed: '),
        ('fixed', 'integer', 8, '/robot1/other refuses fixed: '),
        ('names', 'string_array', ['no'], '/robot1/other refuses names: not that name'),
        ('speed', 'double', 'fast', "'fast' is no double"),
        ('fixed', 'integer', 1.5, '1.5 is no integer'),
        ('fixed', 'integer', 2**70, f'{2**70} is no integer'),
        ('speed', 'cow', 1, 'a parameter cannot be of type cow'),
    ],
)
def test_the_reason_of_a_refusal_is_said_in_one_line(parameters, name, kind, value, reason):
    with pytest.raises(AmrError) as refused:
        asyncio.run(parameters.set(SetParameter(1, '/robot1/other', name, kind, value), 'page 1'))
    assert str(refused.value).startswith(reason)
    assert '\n' not in str(refused.value)


NOW = 12_000_000_034  # ns


class Page:
    """Publishes by forms; a topic that begins with /held is refused."""

    def __init__(self, ros):
        self.logged = []
        self.is_held = False
        self.publications = Publications(
            ros[0],
            ros[2],
            lambda topic: 'a stop holds' if self.is_held and topic == '/cmd' else None,
            lambda: NOW,
            self.logged.append,
        )


def publish(**fields):
    given = {'topic': '/cmd', 'message': 'geometry_msgs/msg/Twist', 'values': {}, 'rate': 0.0}
    return Publish(**{'id': 1} | given | fields)


@pytest.fixture
def heard(ros):
    heard = []
    _, other, _ = ros
    subscription = other.create_subscription(Twist, '/cmd', heard.append, 1000)
    yield heard
    other.destroy_subscription(subscription)


async def come(condition):
    end = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < end
        await asyncio.sleep(0.005)


def test_what_is_published_at_a_rate_ends_with_its_page_or_a_stop(ros, heard):
    page = Page(ros)

    async def use():
        values = {'linear': {'x': 0.5}}
        await page.publications.publish(publish(values=values, rate=100.0), 'page 1')
        await come(lambda: len(heard) > 5)
        page.is_held = True
        with pytest.raises(AmrError, match='a stop holds'):
            await page.publications.publish(publish(), 'page 1')
        await come(lambda: all(each.timer is None for each in page.publications._of.values()))
        page.is_held = False
        await page.publications.publish(publish(values=values, rate=100.0), 'page 1')
        page.publications.forget('page 1')
        assert page.publications._of == {}

    asyncio.run(use())
    assert {each.linear.x for each in heard} == {0.5}
    assert page.logged[0] == 'page 1 publishes geometry_msgs/msg/Twist on /cmd at 100 Hz'


@pytest.mark.parametrize('happening', ['stop', 'gone'])
def test_what_happens_while_the_publisher_is_made_counts(ros, heard, happening):
    page, (_, other, _) = Page(ros), ros

    async def use():
        asked = asyncio.create_task(page.publications.publish(publish(rate=100.0), 'page 1'))
        await asyncio.sleep(0)  # it has been asked for, and waits for its publisher
        if happening == 'stop':
            page.is_held = True
        else:
            page.publications.forget('page 1')
        with pytest.raises(AmrError, match='a stop holds|page 1 has gone'):
            await asked
        page.publications.forget('page 1')
        await come(lambda: other.count_publishers('/cmd') == 0)

    asyncio.run(use())
    assert heard == page.logged == []


def test_two_requests_at_once_make_one_publisher(ros, heard):
    page, (_, other, _) = Page(ros), ros

    async def use():
        await come(lambda: other.count_publishers('/cmd') == 0)  # those of other tests have gone
        requests = [page.publications.publish(publish(), 'page 1') for _ in range(2)]
        await asyncio.gather(*requests)
        assert other.count_publishers('/cmd') == 1
        page.publications.forget('page 1')
        await come(lambda: other.count_publishers('/cmd') == 0)

    asyncio.run(use())


def test_a_stamp_of_now_is_that_of_the_clock_that_robots_have(ros):
    heard = []
    _, other, _ = ros
    subscription = other.create_subscription(TwistStamped, '/stamped', heard.append, 10)
    page = Page(ros)

    async def use():
        fields = {'topic': '/stamped', 'message': 'geometry_msgs/msg/TwistStamped'}
        values = {'header': {'stamp': 'now'}}
        await page.publications.publish(publish(**fields, values=values, rate=100.0), 'page 1')
        await come(lambda: heard)
        page.publications.forget('page 1')

    asyncio.run(use())
    other.destroy_subscription(subscription)
    stamp = heard[0].header.stamp
    assert (stamp.sec, stamp.nanosec) == (12, 34)


@pytest.mark.parametrize(
    ('fields', 'reason'),
    [
        ({'message': 'no_such_msgs/msg/A'}, "there is no package 'no_such_msgs'"),
        ({'values': {'linear': {'w': 1}}}, 'linear'),
        ({'values': {'linear': 3}}, 'linear'),
        ({'topic': 'no name'}, 'must be absolute'),
    ],
)
def test_what_cannot_be_published_is_refused(ros, fields, reason):
    page = Page(ros)
    with pytest.raises(AmrError, match=reason) as refused:
        asyncio.run(page.publications.publish(publish(**fields), 'page 1'))
    assert '\n' not in str(refused.value)
    assert page.logged == []


def fields_of(kind):
    return asyncio.run(define(Definition(1, kind), 'page 1')).data


def test_a_form_has_the_fields_of_the_message_with_their_defaults():
    header, name, position, *_ = fields_of('sensor_msgs/msg/JointState')
    assert [each.name for each in header.fields] == ['stamp', 'frame_id']
    assert (name.kind, name.length, position.kind, position.length) == ('string', 0, 'double', 0)
    (orientation,) = [
        each for each in fields_of('geometry_msgs/msg/Pose') if each.name == 'orientation'
    ]
    assert [each.value for each in orientation.fields] == [0.0, 0.0, 0.0, 1.0]
    assert not any(math.isnan(each.value) for each in orientation.fields)


@pytest.mark.parametrize('part', ['findings', 'alarms'])
def test_findings_of_the_doctor_come_while_a_page_wants_them(ros, shown, part, monkeypatch):
    monkeypatch.setattr(health, '_SLOW_DISCOVERY', 1.0)
    viewer, other, _ = ros
    introspection, told = shown
    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    publisher = other.create_publisher(TFMessage, '/tf_static', latched)
    both = [TransformStamped(child_frame_id='laser') for _ in range(2)]
    for each, parent in zip(both, ('base_link', 'base_footprint'), strict=True):
        each.header.frame_id, each.transform.rotation.w = parent, 1.0
    publisher.publish(TFMessage(transforms=both))

    def doctors():
        return [each for each in viewer.executor.get_nodes() if 'doctor' in each.get_name()]

    def watch_again():
        introspection.watch({part}, ())

    watch_again()
    found = until(introspection, told, lambda message: message.items)
    assert [each.rule for each in found] == ['tf_two_parents']
    assert "'laser' has 2 parents" in found[0].what
    assert introspection.latest(part).items == found
    if part == 'alarms':
        monkeypatch.setattr(health, '_LOOK', 0.0)
        monkeypatch.setattr(health, '_SLOW_PERIOD', 0.0)
        watch_again()
        introspection.poll()
        assert not doctors(), 'the graph is as it was'
        other.destroy_publisher(publisher)
        until(introspection, told, lambda message: message.items == () or watch_again())
    introspection.watch(set(), ())
    assert introspection.latest('findings') is None
    other.destroy_publisher(publisher)
    assert not doctors()


def test_only_commands_are_offered_to_be_copied():
    for fix in (
        '`kill -CONT 12`',
        '`ros2 param set /a b 0.4`, or simulate less at once: fewer robots',
        'mend /synth: name, position',
        '`ros2 param set /a c true`; `ros2 param set /b c true`',
        'let a mux decide: `ros2 run twist_mux twist_mux` (see docs)',
    ):
        assert health.with_quotes(fix.replace('`', '')) == fix
