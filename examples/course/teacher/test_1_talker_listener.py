"""Exercise 1: a node that talks, and one that listens."""

from conftest import expect
import pytest
import rclpy
from std_msgs.msg import String

PERIOD = 500_000_000  # ns
LONG = 5.0  # s


@pytest.fixture
def ros():
    """An executor, which spins until a condition holds."""
    rclpy.init()
    executor = rclpy.executors.SingleThreadedExecutor()

    def spin_until(condition, *nodes):
        for node in nodes:
            if node not in executor.get_nodes():
                executor.add_node(node)
        until = executor.context
        clock = rclpy.clock.Clock(clock_type=rclpy.clock.ClockType.STEADY_TIME)
        end = clock.now().nanoseconds + LONG * 1e9
        while not condition() and clock.now().nanoseconds < end and until.ok():
            executor.spin_once(timeout_sec=0.1)
        return condition()

    yield spin_until
    for node in executor.get_nodes():
        node.destroy_node()
    executor.shutdown()
    rclpy.shutdown()


@pytest.fixture
def talker(ros, submitted):
    return submitted('talker_listener').Talker()


@pytest.mark.points(3)
def test_topic(ros, talker):
    """Texts are published on chatter."""
    topics = {p.topic_name: p.msg_type for p in talker.publishers if '/rosout' not in p.topic_name}
    topics.pop('/parameter_events', None)
    expect(topics, 'your talker has no publisher: self.create_publisher(String, …)')
    found = ', '.join(topics)
    expect('/chatter' in topics, f'your talker publishes on {found}; /chatter was asked for')
    kind = topics['/chatter'].__name__
    expect(topics['/chatter'] is String, f'/chatter has the type {kind}; String was asked for')


@pytest.mark.points(4)
def test_texts(ros, talker):
    """They are Hello 1, Hello 2, Hello 3, every 0.5 s."""
    timers = [timer.timer_period_ns for timer in talker.timers]
    expect(timers, 'your talker has no timer: self.create_timer(0.5, …)')
    said = f'your timer has a period of {timers[0] / 1e9:g} s; every 0.5 s was asked for'
    expect(timers == [PERIOD], said)
    heard = []
    ear = rclpy.create_node('ear')
    ear.create_subscription(String, 'chatter', lambda message: heard.append(message.data), 10)
    ros(lambda: len(heard) >= 2, talker, ear)
    expect(heard, f'nothing came on /chatter in {LONG:g} s')
    expect(len(set(heard)) == len(heard), f'"{heard[0]}" came twice: who counts?')
    number = heard[0].removeprefix('Hello ')
    expect(number.isdigit(), f'your text is "{heard[0]}"; "Hello 1" was asked for')
    wanted = [f'Hello {int(number) + place}' for place in range(len(heard))]
    expect(heard == wanted, f'your texts are {heard}; {wanted} were expected')


@pytest.mark.points(3)
def test_listener(ros, submitted):
    """The listener keeps what it hears."""
    listener = submitted('talker_listener').Listener()
    expect(
        '/chatter' in [each.topic_name for each in listener.subscriptions],
        'your listener does not subscribe to /chatter: self.create_subscription(…)',
    )
    mouth = rclpy.create_node('mouth')
    publisher = mouth.create_publisher(String, 'chatter', 10)
    ros(lambda: publisher.get_subscription_count(), mouth, listener)
    for text in ('one', 'two'):
        publisher.publish(String(data=text))
    ros(lambda: len(listener.heard) >= 2, mouth, listener)
    expect(listener.heard == ['one', 'two'], f'it heard {listener.heard}; one, two were said')
