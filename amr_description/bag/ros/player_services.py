# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The services of ``rosbag2_player``."""

from collections.abc import Callable
from typing import Any

from rclpy.node import Node
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

from amr_description.bag.ros.player import Player
from amr_description.ros.messages import nanoseconds


def offer_services(node: Node, player: Player) -> None:
    """Offer the services of a player below the name of its node."""

    def offer(
        kind: Any, name: str, call: Callable[[Any], object], field: str | None = None
    ) -> None:
        def answer(request: Any, response: Any) -> Any:
            result = call(request)
            if field:
                setattr(response, field, result)
            return response

        node.create_service(kind, f'~/{name}', answer)

    def play(_request: Any) -> bool:
        node.get_logger().warning('Trying to play() while in playback, dismissing request.')
        return False

    def seek(request: Any) -> bool:
        player.seek(nanoseconds(request.time))
        return True

    offer(Pause, 'pause', lambda _: player.pause())
    offer(Resume, 'resume', lambda _: player.resume())
    offer(TogglePaused, 'toggle_paused', lambda _: player.toggle_paused())
    offer(IsPaused, 'is_paused', lambda _: player.is_paused, 'paused')
    offer(GetRate, 'get_rate', lambda _: player.rate, 'rate')
    offer(SetRate, 'set_rate', lambda request: player.set_rate(request.rate), 'success')
    offer(Play, 'play', play, 'success')
    offer(PlayNext, 'play_next', lambda _: player.play_next(), 'success')
    offer(Burst, 'burst', lambda request: player.burst(request.num_messages), 'actually_burst')
    offer(Seek, 'seek', seek, 'success')
    offer(Stop, 'stop', lambda _: player.stop())
