# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What ``ros2 topic bw`` and ``delay`` make of the messages that arrive."""

from geometry_msgs.msg import TwistStamped
import pytest
from rclpy.serialization import serialize_message
from std_msgs.msg import String

from amr_description.cli.meters import BandwidthMeter, DelayMeter, WindowStatistics
from amr_description.cli.topic.rates import stamp_reader
from amr_description.errors import AmrError

MS = 1_000_000  # ns
SECOND = 1_000_000_000  # ns


def test_a_spread_is_that_of_the_population():
    spread = WindowStatistics.of([100 * MS, 300 * MS, 200 * MS])
    assert (spread.mean, spread.shortest, spread.longest, spread.window) == (
        pytest.approx(0.2),
        pytest.approx(0.1),
        pytest.approx(0.3),
        3,
    )
    assert spread.deviation == pytest.approx((0.02 / 3) ** 0.5)
    same = WindowStatistics.of([5 * MS] * 4)
    assert same.deviation == 0.0
    assert str(same) == '\tmin: 0.005s max: 0.005s std dev: 0.00000s window: 4'


def test_delay_is_arrival_minus_stamp():
    meter = DelayMeter(window=2)
    assert (meter.report(), meter.started) == (None, False)
    for delay in (900, 1, 3):
        assert meter.add(now=SECOND + delay * MS, stamp=SECOND) or delay == 1
    delays = meter.report()
    assert str(delays) == (
        'average delay: 0.002\n\tmin: 0.001s max: 0.003s std dev: 0.00100s window: 2'
    )
    assert (meter.report(), meter.started) == (None, True)


def test_delay_starts_over_when_time_goes_back():
    meter = DelayMeter(window=10)
    assert meter.add(now=5 * SECOND, stamp=0)
    assert not meter.add(now=SECOND, stamp=SECOND)
    assert (meter.report().window, meter.report()) == (1, None)
    assert not meter.add(now=0, stamp=0)
    assert (meter.report(), meter.started) == (None, False)


def test_nothing_is_measured_before_simulation_time_begins():
    meter = DelayMeter(window=10)
    assert meter.add(now=0, stamp=SECOND)
    assert (meter.report(), meter.started) == (None, False)


def test_a_message_from_the_future_has_a_negative_delay():
    meter = DelayMeter(window=10)
    meter.add(now=SECOND, stamp=2 * SECOND)
    assert meter.report().mean == pytest.approx(-1.0)


@pytest.mark.parametrize(
    ('size', 'lines'),
    [
        (99, '198 B/s from 2 messages\n\tMessage size mean: 99 B min: 99 B max: 99 B'),
        (
            500,
            '1.00 KB/s from 2 messages\n\tMessage size mean: 0.50 KB min: 0.50 KB max: 0.50 KB',
        ),
        (
            2_500_000,
            '5.00 MB/s from 2 messages\n\tMessage size mean: 2.50 MB min: 2.50 MB max: 2.50 MB',
        ),
    ],
)
def test_bandwidth_is_told_in_the_unit_of_the_rate(size, lines):
    meter = BandwidthMeter(window=10)
    for time in (0, 500 * MS):
        meter.add(time, size)
    assert str(meter.report(SECOND)) == lines


def test_bandwidth_is_that_of_the_window():
    meter = BandwidthMeter(window=3)
    meter.add(0, 1000)
    assert meter.report(SECOND) is None
    for time, size in ((1, 10), (2, 20), (3, 30)):
        meter.add(time * SECOND, size)
    found = meter.report(4 * SECOND)
    assert (found.window, found.smallest, found.largest, found.mean) == (3, 10, 30, 20.0)
    assert found.rate == pytest.approx(60 / 3)
    assert meter.report(7 * SECOND).rate == pytest.approx(60 / 6)  # fades when nothing comes


def test_bandwidth_starts_over_when_time_goes_back():
    meter = BandwidthMeter(window=3)
    for time in (5, 6):
        meter.add(time * SECOND, 10)
    assert meter.report(SECOND) is None
    meter.add(SECOND, 10)
    assert meter.report(2 * SECOND) is None


class HeaderLast(TwistStamped):
    """Declares the header last; only that decides how the bytes are read."""

    @classmethod
    def get_fields_and_field_types(cls):
        return dict(reversed(super().get_fields_and_field_types().items()))


@pytest.mark.parametrize('message_class', [TwistStamped, HeaderLast])
def test_the_stamp_is_read_from_the_bytes(message_class):
    message = TwistStamped()
    message.header.stamp.sec, message.header.stamp.nanosec = 7, 8
    assert stamp_reader(message_class)(serialize_message(message)) == 7 * SECOND + 8
    message.header.stamp.sec = -1  # which rclpy's Time raises at
    assert stamp_reader(message_class)(serialize_message(message)) == 8 - SECOND


def test_a_message_without_a_header_is_refused():
    with pytest.raises(AmrError, match='msg does not have header: the delay of std_msgs/msg/Str'):
        stamp_reader(String)
