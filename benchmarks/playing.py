# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""How punctually a bag is played."""

from pathlib import Path
import tempfile
from typing import Any

from rclpy.node import Node
from rclpy.qos import QoSProfile
from std_msgs.msg import String

from amr_description.bag.mcap_writer import BagWriter
from amr_description.bag.playback import PlaybackOptions
from amr_description.bag.qos_text import QosProfile
from amr_description.bag.reader import BagReader
from amr_description.bag.recording import BagRecording
from amr_description.bag.ros.player import Player, PlayerOptions
from amr_description.bag.storage import BagMessage, TopicMetadata
from benchmarks.figures import Figures

_TOPIC = '/benchmark_of_bags'
_RATE = 10.0
_RECORDED = (100, 1000)  # messages/s; the first one's figure has a goal
_TEXT = b'\0\1\0\0\4\0\0\0abc\0'
_BEGIN = 1_700_000_000 * 10**9  # ns


class _TimedPlayer(Player):
    """Notes how late each message is published, ms."""

    def __init__(self, *args: Any, **options: Any) -> None:
        self.late: list[float] = []
        super().__init__(*args, **options)

    def _publish(self, message: BagMessage) -> bool:
        self.late.append(-self.playback.clock.until(message.log_time) / 1e6)
        return super()._publish(message)


def playing_figures(node: Node, seconds: float) -> Figures:
    """
    Play bags ten times faster than recorded, heard by one subscriber.

    Args:
        node: To publish and subscribe with.
        seconds: Of each measurement.
    """
    subscription = node.create_subscription(String, _TOPIC, lambda _: None, QoSProfile(depth=10))
    lines = ['a bag played at rate 10: lateness of messages, ms']
    found = []
    for recorded in _RECORDED:
        late = sorted(_lateness(node, recorded, seconds))
        p50, p95, p99 = (late[int(len(late) * part)] for part in (0.5, 0.95, 0.99))
        found.append(p95)
        lines.append(
            f'{recorded * _RATE:6.0f}/s  p50 {p50:.3f}  p95 {p95:.3f}  p99 {p99:.3f}  most '
            f'{late[-1]:.3f}'
        )
    node.destroy_subscription(subscription)
    return Figures({'played': found[0]}, '\n'.join(lines))


def _lateness(node: Node, recorded: int, seconds: float) -> list[float]:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / 'bag'
        with BagWriter(path) as writer:
            writer.add_topic(TopicMetadata(_TOPIC, 'std_msgs/msg/String', 'cdr', (QosProfile(),)))
            for number in range(int(recorded * _RATE * seconds)):
                time = _BEGIN + number * 10**9 // recorded
                writer.write(BagMessage(_TOPIC, _TEXT, time, time))
        with BagReader(path) as reader:
            options = PlayerOptions(playback=PlaybackOptions(rate=_RATE))
            player = _TimedPlayer(node, BagRecording([reader]), options)
            player.start()
            player.await_end()
            player.destroy()
            return player.late
