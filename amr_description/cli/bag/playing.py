# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Play bags until their end, for ``play`` and ``burst``."""

from argparse import Namespace
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TextIO

from rclpy.logging import LoggingSeverity
from rclpy.node import Node

from amr_description.bag.qos_text import overrides_from_text, QosProfile
from amr_description.bag.recording import BagRecording
from amr_description.bag.ros.keyboard import DOWN, keys, RIGHT, SPACE, UP
from amr_description.bag.ros.player import Player, PlayerOptions
from amr_description.bag.ros.player_services import offer_services
from amr_description.bag.topic_selection import full_name, TopicSelection
from amr_description.cli.bag.inputs import open_bags
from amr_description.cli.discovery import wait_for_discovery
from amr_description.cli.session import open_session
from amr_description.errors import BagError
from amr_description.ros.endpoints import endpoint_node

_STEP = 0.1  # of the rate, a key


def overrides_of(file: TextIO | None) -> dict[str, QosProfile]:
    """Return the QoS profiles of a file of overrides. Raises BagError."""
    return overrides_from_text(file.read(), file.name) if file else {}


def play(
    given: Sequence[tuple[Path, str | None]],
    chosen: TopicSelection,
    options: PlayerOptions,
    args: Namespace,
    *,
    burst: int | None = None,
) -> int:
    """
    Play bags; return 0 after their end.

    Args:
        given: path and storage of each.
        chosen: which topics.
        options: how.
        args: ``remap``, ``log_level``, ``disable_keyboard_controls``.
        burst: messages to publish first, at once, with what is paused; 0: all; None: none.

    Raises:
        BagError: a bag cannot be read, or somebody else publishes ``/clock``.
        StopRequested: a signal came.
    """
    rules = [word for rule in args.remap for word in ('-r', rule)]
    with (
        open_bags(given) as readers,
        open_session(name='rosbag2_player', ros_args=rules) as session,
    ):
        node = session.node
        node.get_logger().set_level(LoggingSeverity[args.log_level.upper()])
        recording = BagRecording(readers, chosen.holds)
        _warn_of_absent(node, recording, chosen)
        player = Player(node, recording, options, on_finished=session.interrupt)
        offer_services(node, player)
        try:
            wait_for_discovery(session, None)
            if options.has_clock or '/clock' in recording.topics:
                _refuse_second_clock(node)
            with _keyboard(node, player, args):
                with session.stop.deferred(session.interrupt):  # while its thread is made
                    player.start()
                if burst is not None:
                    player.burst(burst)
                    if player.is_at_end:
                        player.stop()
                session.serve(lambda: player.is_over)
        finally:
            player.end()
    return 0 if player.error is None else 1


def _warn_of_absent(node: Node, recording: BagRecording, chosen: TopicSelection) -> None:
    for name in chosen.topics:
        if full_name(name) not in recording.topics:
            node.get_logger().warning(f'{full_name(name)} is not in the bag')


def _refuse_second_clock(node: Node) -> None:
    topic = node.resolve_topic_name('/clock')
    own = node.get_fully_qualified_name()
    found = [endpoint_node(each) for each in node.get_publishers_info_by_topic(topic)]
    if own in found:
        found.remove(own)  # not those of other players: their name is the same
    if found:
        others = ', '.join(sorted({name or 'a node' for name in found}))
        raise BagError(
            f'{topic} is published by {others} already, and with two clocks the time of every '
            'node jumps back and forth: play without --clock and with --exclude-topics /clock, or '
            f'end {others}'
        )


@contextmanager
def _keyboard(node: Node, player: Player, args: Namespace) -> Iterator[None]:
    bindings: dict[str, tuple[Callable[[], object], str]] = {
        SPACE: (player.toggle_paused, 'Pause/Resume'),
        RIGHT: (player.play_next, 'Play Next Message'),
        UP: (lambda: player.set_rate(player.rate + _STEP), 'Increase Rate 10%'),
        DOWN: (lambda: player.set_rate(player.rate - _STEP), 'Decrease Rate 10%'),
    }
    if args.disable_keyboard_controls:
        yield
        return
    with keys({key: function for key, (function, _) in bindings.items()}) as are_there:
        if are_there:
            log = node.get_logger()
            log.info('Adding keyboard callbacks.')
            for key, (_, what) in bindings.items():
                log.info(f'Press {key} for {what}')
        yield
