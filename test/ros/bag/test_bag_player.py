# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The player as a node: what arrives, with which QoS, and its services."""

from contextlib import contextmanager

from example_interfaces.srv import AddTwoInts
import pytest
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.serialization import serialize_message
from rosbag2_interfaces.msg import ReadSplitEvent
from rosbag2_interfaces.srv import (
    Burst,
    GetRate,
    IsPaused,
    Pause,
    Play,
    PlayNext,
    Resume,
    Seek,
    SetRate,
    Stop,
    TogglePaused,
)
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import get_typestore, Stores
from rosgraph_msgs.msg import Clock
from service_msgs.msg import ServiceEventInfo
from std_msgs.msg import String
from support.ros_processes import PATIENCE
from support.small_bags import BEGIN, LATCHED, MS, string, topic, write_bag, write_runs

from amr_description.bag.mcap_writer import BagWriter
from amr_description.bag.playback import PlaybackOptions
from amr_description.bag.qos_text import QosProfile
from amr_description.bag.reader import BagReader
from amr_description.bag.recording import BagRecording
from amr_description.bag.ros import player as player_module
from amr_description.bag.ros.player import Player, PlayerOptions
from amr_description.bag.ros.player_services import offer_services
from amr_description.bag.storage import BagMessage, TopicMetadata
from amr_description.errors import BagError
from amr_description.ros.messages import nanoseconds
from amr_description.ros.service_calls import wait_until

KEEP = QoSProfile(depth=100)
KEEP_LATCHED = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)
NUMBERS = [(10 * n, '/chatter', str(n)) for n in range(5)]
PAUSED = PlaybackOptions(start_paused=True)
SLOW = PlaybackOptions(rate=0.1)


class Host:
    """The node of a player, and one that hears what is played."""

    def __init__(self):
        self.node, self.other = Node('rosbag2_player'), Node('hears')
        self.executor = SingleThreadedExecutor()
        self.executor.add_node(self.node)
        self.executor.add_node(self.other)
        self.heard = []

    def hear(self, name, kind=String, qos=KEEP):
        self.other.create_subscription(kind, name, lambda m: self.heard.append((name, m)), qos)

    @property
    def texts(self):
        return [message.data for _, message in self.heard]

    @contextmanager
    def player(self, *bags, awaited=('/chatter',), **options):
        """A player whose publishers of these topics are heard."""
        readers = [BagReader(bag) for bag in bags]
        player = Player(self.node, BagRecording(readers), PlayerOptions(**options))
        offer_services(self.node, player)
        try:
            found = [p for p in self.node.publishers if p.topic_name in awaited]
            assert len(found) == len(awaited)
            self.until(lambda: all(p.get_subscription_count() for p in found))
            yield player
        finally:
            player.end()
            for reader in readers:
                reader.close()

    def until(self, condition):
        assert wait_until(self.other, lambda: condition() or None, timeout=PATIENCE)

    def call(self, kind, name, **fields):
        client = self.other.create_client(kind, f'/rosbag2_player/{name}')
        self.until(client.service_is_ready)
        future = client.call_async(kind.Request(**fields))
        self.until(future.done)
        return future.result()

    def end(self):
        self.executor.shutdown()
        self.node.destroy_node()
        self.other.destroy_node()


@pytest.fixture
def host():
    rclpy.init(args=[])
    made = Host()
    yield made
    made.end()
    rclpy.try_shutdown()


@pytest.fixture
def bag(tmp_path):
    return write_bag(tmp_path / 'bag', [topic('/chatter')], NUMBERS)


def test_several_bags_are_played_by_their_times(host, bag, tmp_path):
    host.hear('/chatter')
    second = write_bag(tmp_path / 'second', [topic('/chatter')], [(15, '/chatter', 'between')])
    with host.player(bag, second) as player:
        player.start()
        host.until(lambda: player.is_over and len(host.heard) == 6)
    assert host.texts == ['0', '1', 'between', '2', '3', '4']
    assert player.error is None


def test_a_bag_of_sqlite_is_played(host, tmp_path):
    store = get_typestore(Stores.ROS2_JAZZY)
    with Writer(tmp_path / 'old', version=8, storage_plugin=StoragePlugin.SQLITE3) as writer:
        connection = writer.add_connection('/chatter', 'std_msgs/msg/String', typestore=store)
        for n in range(3):
            writer.write(connection, BEGIN + n * MS, string(str(n)))
    host.hear('/chatter')
    with host.player(tmp_path / 'old') as player:
        player.start()
        host.until(lambda: player.is_over)
        assert player.error is None
        host.until(lambda: host.texts == ['0', '1', '2'])


def test_services_control_it(host, bag):
    host.hear('/chatter')
    with host.player(bag, playback=PAUSED) as player:
        player.start()
        assert host.call(IsPaused, 'is_paused').paused
        assert host.call(PlayNext, 'play_next').success
        assert host.call(Burst, 'burst', num_messages=2).actually_burst == 2
        host.until(lambda: host.texts == ['0', '1', '2'])
        seek = Seek.Request().time
        seek.sec, seek.nanosec = divmod(BEGIN + 40 * MS, 10**9)
        assert host.call(Seek, 'seek', time=seek).success
        assert host.call(Burst, 'burst').actually_burst == 1
        assert not host.call(PlayNext, 'play_next').success
        host.until(lambda: host.texts == ['0', '1', '2', '4'])
        assert host.call(SetRate, 'set_rate', rate=2.5).success
        assert not host.call(SetRate, 'set_rate', rate=0.0).success
        assert host.call(GetRate, 'get_rate').rate == 2.5
        assert not host.call(Play, 'play').success
        host.call(Stop, 'stop')
        host.until(lambda: player.is_over)


def test_pauses_come_and_go(host, bag):
    # Nothing ends so slowly.
    playback = PlaybackOptions(start_paused=True, rate=1e-6)
    with host.player(bag, awaited=(), playback=playback) as player:
        player.start()
        states = [player.is_paused]
        for kind, name in (
            (Resume, 'resume'),
            (TogglePaused, 'toggle_paused'),
            (TogglePaused, 'toggle_paused'),
            (Pause, 'pause'),
        ):
            host.call(kind, name)
            states.append(player.is_paused)
        assert states == [True, False, True, False, True]
        assert not player.is_over
        assert player.burst(0) == 4  # the first was due
        assert player.is_at_end


def test_what_was_latched_by_many_is_all_latched(host, tmp_path):
    texts = [(n, '/tf_static', str(n)) for n in range(12)]
    profiles = [LATCHED] * 12
    bag = write_bag(tmp_path / 'bag', [topic('/tf_static', *profiles)], texts)
    with host.player(bag, awaited=(), playback=PAUSED) as player:
        player.start()
        player.burst(0)
        host.hear('/tf_static', qos=KEEP_LATCHED)  # late
        host.until(lambda: len(host.heard) == 12)


def test_an_offset_keeps_what_was_latched_before(host, tmp_path):
    topics = [topic('/description', LATCHED), topic('/chatter')]
    bag = write_bag(tmp_path / 'bag', topics, [(0, '/description', 'robot'), *NUMBERS])
    host.hear('/description', qos=KEEP_LATCHED)
    host.hear('/chatter')
    playback = PlaybackOptions(start_offset=25 * MS)
    with host.player(bag, awaited=('/chatter', '/description'), playback=playback) as player:
        player.start()
        host.until(lambda: len(host.heard) == 3)
    assert sorted(host.texts) == ['3', '4', 'robot']


def test_qos_is_as_recorded_or_as_overridden(host, tmp_path):
    best = QosProfile(reliability='best_effort', depth=3)
    topics = [
        topic('/best', best, best),
        topic('/mixed', best, QosProfile()),
        topic('/none'),
        topic('/chatter', LATCHED),
    ]
    bag = write_bag(tmp_path / 'bag', topics, NUMBERS)
    overrides = {'/none': QosProfile(depth=7, durability='transient_local')}
    with host.player(bag, awaited=(), overrides=overrides):
        offered = {p.topic_name: p.qos_profile for p in host.node.publishers}
    reliable, best_effort = ReliabilityPolicy.RELIABLE, ReliabilityPolicy.BEST_EFFORT
    assert (offered['/best'].reliability, offered['/best'].depth) == (best_effort, 10)
    assert offered['/mixed'].reliability == reliable
    assert (offered['/none'].durability.name, offered['/none'].depth) == ('TRANSIENT_LOCAL', 7)
    assert offered['/chatter'].durability == DurabilityPolicy.TRANSIENT_LOCAL


def test_the_clock_has_the_times_of_the_recording(host, bag):
    host.hear('/clock', Clock)
    with host.player(bag, awaited=('/clock',), clock_frequency=1000.0, playback=SLOW) as player:
        player.start()
        host.until(lambda: player.is_over and len(host.heard) > 5)
    times = [nanoseconds(message.clock) for _, message in host.heard]
    assert times == sorted(times)
    assert times[0] >= BEGIN
    assert times[-1] < BEGIN + PATIENCE * 10**9


@pytest.mark.parametrize(('triggers', 'ticks'), [((), [0, 10, 20]), (('/other',), [10])])
def test_messages_have_the_clock_before_them(host, tmp_path, triggers, ticks):
    texts = [(0, '/chatter', 'a'), (10, '/other', 'b'), (20, '/chatter', 'c')]
    bag = write_bag(tmp_path / 'bag', [topic('/chatter'), topic('/other')], texts)
    host.hear('/clock', Clock)
    with host.player(bag, awaited=('/clock',), clock_topics=triggers, playback=SLOW) as player:
        player.start()
        host.until(lambda: player.is_over and len(host.heard) >= len(ticks))
    times = [nanoseconds(message.clock) for _, message in host.heard]
    assert times == [BEGIN + tick * MS for tick in ticks]


def test_time_does_not_go_back_for_what_was_latched(host, tmp_path):
    texts = [(0, '/map', 'm'), (20, '/chatter', 'a'), (60, '/chatter', 'b')]
    bag = write_bag(tmp_path / 'bag', [topic('/map', LATCHED), topic('/chatter')], texts)
    host.hear('/clock', Clock)
    playback = PlaybackOptions(start_paused=True, start_offset=10 * MS)
    with host.player(bag, awaited=('/clock',), clock_topics=(), playback=playback) as player:
        player.start()
        assert player.burst(1) == 1
        player.seek(BEGIN + 50 * MS)
        assert player.burst(1) == 1
        host.until(lambda: len(host.heard) == 4)
    times = [(nanoseconds(message.clock) - BEGIN) // MS for _, message in host.heard]
    assert times == [10, 20, 50, 60]


def test_what_fails_for_a_caller_ends_playing(host, bag, capfd):
    with host.player(bag, awaited=(), playback=PAUSED) as player:

        def fail(_count):
            raise BagError('a chunk cannot be read')

        player._burst = fail
        player.start()
        assert host.call(Burst, 'burst').actually_burst == 0
        host.until(lambda: player.is_over)
        assert host.call(IsPaused, 'is_paused').paused
    assert str(player.error) == 'a chunk cannot be read'
    assert capfd.readouterr().err.count('Failed to play: a chunk cannot be read') == 1


def test_who_waits_at_the_end_is_not_forgotten(host, bag):
    """Though what another one wants then fails."""
    finished = []
    with host.player(bag, awaited=(), playback=PAUSED) as player:
        player._on_finished = lambda: finished.append(player.error)
        player._calls.extend([lambda: 1 / 0, lambda: finished.append(1)])
        player._ending = True  # nothing is played
        player.start()
        player.await_end()
    assert finished[0] == 1
    assert isinstance(finished[1], ZeroDivisionError)


def test_the_recorded_clock_gives_way_to_ours(host, tmp_path):
    topics = [topic('/clock', kind='rosgraph_msgs/msg/Clock'), topic('/chatter')]
    bag = write_bag(tmp_path / 'bag', topics, NUMBERS)
    with host.player(bag, awaited=(), clock_frequency=1.0):
        names = [p.topic_name for p in host.node.publishers]
    assert names.count('/clock') == 1


def test_the_next_file_is_told(host, tmp_path):
    texts = [(n, '/chatter', 'x' * 2000) for n in range(0, 60, 20)]
    bag = write_bag(tmp_path / 'bag', [topic('/chatter')], texts, max_bag_size=2000)
    host.hear('/events/read_split', ReadSplitEvent)
    with host.player(bag, awaited=('/events/read_split',), playback=SLOW) as player:
        player.start()
        host.until(lambda: player.is_over and len(host.heard) == 2)
    event = host.heard[0][1]
    assert (event.closed_file, event.opened_file, event.node_name) == (
        str(bag / 'bag_0.mcap'),
        str(bag / 'bag_1.mcap'),
        '/rosbag2_player',
    )


def test_the_clock_jumps_back_with_the_next_run(host, tmp_path, capfd):
    runs = [(10, '/chatter', 'a'), (20, '/chatter', 'b')], [(0, '/chatter', 'c')]
    bag = write_runs(tmp_path / 'bag', [topic('/chatter')], *runs)
    host.hear('/clock', Clock)
    with host.player(bag, awaited=('/clock',), clock_topics=(), playback=SLOW) as player:
        player.start()
        host.until(lambda: player.is_over and len(host.heard) == 3)
    times = [(nanoseconds(message.clock) - BEGIN) // MS for _, message in host.heard]
    assert times == [10, 20, 0]
    assert capfd.readouterr().err.count('Playing the next run: times jump back') == 1


def test_what_cannot_be_acknowledged_is_told(host, tmp_path, capfd):
    best = QosProfile(reliability='best_effort')
    bag = write_bag(tmp_path / 'bag', [topic('/best', best), topic('/chatter')], NUMBERS)
    host.hear('/chatter')
    with host.player(bag, acked_timeout=0) as player:
        player.start()
        host.until(lambda: player.is_over)
        host.until(lambda: len(host.heard) == 5)
    assert '--wait-for-all-acked is invalid for the below topics' in capfd.readouterr().err


def test_a_type_that_is_not_installed_is_left_out(host, tmp_path, capfd):
    with BagWriter(tmp_path / 'bag') as writer:
        writer.add_topic(TopicMetadata('/absent', 'absent_msgs/msg/Absent'), schema='int8 a')
        writer.write(BagMessage('/absent', b'\0\1\0\0\0', BEGIN, BEGIN))
    with host.player(tmp_path / 'bag', awaited=()) as player:
        player.start()
        host.until(lambda: player.is_over)
    assert player.error is None
    assert "Ignoring a topic '/absent', reason: " in capfd.readouterr().err


@pytest.mark.parametrize(
    'wrong',
    [
        topic('/no name'),
        topic(''),
        topic('/\x1b[2J\n'),
        topic('/a', kind=''),
        topic('/a', QosProfile(reliability='unknown')),
    ],
)
def test_a_topic_that_cannot_be_is_left_out(host, tmp_path, wrong, capfd):
    with BagWriter(tmp_path / 'bag') as writer:
        writer.add_topic(wrong, schema='')
        writer.write(BagMessage(wrong.name, b'\0\1\0\0', BEGIN, BEGIN))
    with host.player(tmp_path / 'bag', awaited=()) as player:
        player.start()
        host.until(lambda: player.is_over)
    assert player.error is None
    [line] = [each for each in capfd.readouterr().err.splitlines() if 'Ignoring' in each]
    assert line.isprintable()


def test_the_clock_of_a_far_future_is_refused(host, tmp_path):
    with BagWriter(tmp_path / 'bag') as writer:
        writer.add_topic(topic('/chatter'))
        writer.write(BagMessage('/chatter', string('x'), 2**62, BEGIN))
    with host.player(tmp_path / 'bag', awaited=(), clock_topics=()) as player:
        player.start()
        host.until(lambda: player.is_over)
    assert str(player.error).startswith('/clock cannot have the time 4611686018 s')


def test_an_event_that_cannot_be_read_is_left_out(host, tmp_path, capfd):
    name, kind = '/add/_service_event', 'example_interfaces/srv/AddTwoInts_Event'
    with BagWriter(tmp_path / 'bag') as writer:
        writer.add_topic(TopicMetadata(name, kind), schema='')
        writer.write(BagMessage(name, b'\0\1\0\0', BEGIN, BEGIN))
    source = 'service_introspection'
    with host.player(tmp_path / 'bag', awaited=(), requests_from=source) as player:
        player.start()
        host.until(lambda: player.is_over)
    assert player.error is None
    assert (
        "Can't send service request. An event of '/add' cannot be read: " in capfd.readouterr().err
    )


@pytest.mark.parametrize(
    ('source', 'sums'), [('service_introspection', [3]), ('client_introspection', [7])]
)
def test_recorded_requests_are_sent(host, tmp_path, monkeypatch, source, sums):
    """Of the side that is asked for; responses are there, too."""
    events = [
        (ServiceEventInfo.REQUEST_SENT, AddTwoInts.Request(a=3, b=4)),
        (ServiceEventInfo.REQUEST_RECEIVED, AddTwoInts.Request(a=1, b=2)),
        (ServiceEventInfo.RESPONSE_SENT, None),
    ]
    name, kind = '/add/_service_event', 'example_interfaces/srv/AddTwoInts_Event'
    with BagWriter(tmp_path / 'bag') as writer:
        writer.add_topic(TopicMetadata(name, kind), schema='')
        for number, (event_type, request) in enumerate(events):
            event = AddTwoInts.Event(request=[request] if request else [])
            event.info.event_type = event_type
            writer.write(BagMessage(name, serialize_message(event), BEGIN + number, BEGIN))
    asked = []
    monkeypatch.setattr(player_module, '_ANSWERED', PATIENCE)

    def add(request, response):
        asked.append(request.a + request.b)
        return response

    host.other.create_service(AddTwoInts, '/add', add)
    with host.player(tmp_path / 'bag', awaited=(), requests_from=source) as player:
        client = next(c for c in host.node.clients if c.srv_name == '/add')
        host.until(client.service_is_ready)
        player.start()
        player._thread.join(0.1)
        assert not player.is_over  # before the last one has arrived
        host.until(lambda: player.is_over)
    assert asked == sums
