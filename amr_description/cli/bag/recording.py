# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Record until a signal, for ``ros2 bag record``."""

from argparse import Namespace
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
import sys

from rclpy.logging import LoggingSeverity
from rclpy.node import Node

from amr_description.bag import mcap_options
from amr_description.bag.info_text import size_text
from amr_description.bag.mcap_writer import BagWriter, WriterOptions
from amr_description.bag.qos_text import overrides_from_text
from amr_description.bag.ros.keyboard import keys, SPACE
from amr_description.bag.ros.recorder import Recorder, RecorderOptions
from amr_description.bag.ros.recorder_services import offer_services, split_publisher
from amr_description.bag.topic_filter import TopicFilter
from amr_description.cli.discovery import wait_for_discovery
from amr_description.cli.names import full_name
from amr_description.cli.session import open_session, Session
from amr_description.ros.signals import StopRequested
from amr_description.terminal import is_in_foreground

_SECOND = 10**9
_STATUS_PERIOD = 1.0  # s
_CLOCK_PERIOD = 0.02  # s between two looks for a simulated time


def record(args: Namespace, folder: str) -> int:
    """Record; return 0 after a signal. Raises BagError."""
    writing = writer_options(args)
    with open_session(name=args.node_name, use_sim_time=args.use_sim_time) as session:
        node = session.node
        node.get_logger().set_level(LoggingSeverity[args.log_level.upper()])
        options = recorder_options(args, node)
        writing = replace(writing, on_split=split_publisher(node))
        with suppress(StopRequested):
            if args.no_discovery:
                wait_for_discovery(session, None)
            with BagWriter(Path(folder), writing) as writer:
                recorder = Recorder(node, writer, options)
                offer_services(recorder)
                _run(session, recorder, writer, args)
    return 0


def writer_options(args: Namespace) -> WriterOptions:
    """Return how the bag is written. Raises BagError."""
    config = args.storage_config_file
    return WriterOptions(
        storage=args.storage,
        preset=args.storage_preset_profile,
        settings=mcap_options.settings_from_text(config.read(), config.name) if config else {},
        max_bag_size=args.max_bag_size,
        max_bag_duration=args.max_bag_duration * _SECOND,
        compress_files=args.compression_mode == 'file',
        custom_data=dict(each.split('=', 1) for each in args.custom_data or ()),
    )


def recorder_options(args: Namespace, node: Node) -> RecorderOptions:
    """Return what is recorded; names are those of a node. Raises AmrError."""
    overrides = args.qos_profile_overrides_path
    profiles = overrides_from_text(overrides.read(), overrides.name) if overrides else {}
    return RecorderOptions(
        topics=_filter(args, node),
        overrides={full_name(node, topic): each for topic, each in profiles.items()},
        use_sim_time=args.use_sim_time,
        include_unpublished_topics=args.include_unpublished_topics,
        ignore_leaf_topics=args.ignore_leaf_topics,
        start_paused=args.start_paused,
        snapshot_mode=args.snapshot_mode,
        max_cache_size=args.max_cache_size,
    )


def _run(session: Session, recorder: Recorder, writer: BagWriter, args: Namespace) -> None:
    """Record until a signal, or until nothing can be written. Raises BagError, StopRequested."""
    log = recorder.node.get_logger()
    bindings = {} if args.disable_keyboard_controls else {SPACE: recorder.toggle_paused}
    with session.finishing() as is_stopping, keys(bindings) as has_keys:
        if has_keys:
            log.info('Press SPACE for pausing/resuming')
        log.info('Listening for topics...')
        recorder.start()
        try:
            _serve(session, recorder, args, is_stopping)
        finally:
            if is_stopping():
                log.info('Writing remaining messages from cache to the bag. It may take a while')
            session.stop.leave()  # a second Ctrl-C would tear the last chunk
            recorder.end()
            _tell_lost(recorder)
            writer.close()
        if recorder.error:
            raise recorder.error
        log.info('Recording stopped')


def _serve(
    session: Session, recorder: Recorder, args: Namespace, is_stopping: Callable[[], bool]
) -> None:
    """Look for topics, serve the services, and say what is recorded, until a signal."""
    log = recorder.node.get_logger()
    period = max(args.polling_interval, 1) / 1000
    status = Status(recorder)
    began = next_look = session.clock.now()
    is_looking = True
    # What is latched comes at once, and without a simulated time it would have none.
    is_waiting = args.use_sim_time and not _has_time(recorder)
    if is_waiting:
        log.info('use_sim_time set, waiting for /clock before starting recording...')
    else:
        log.info('Recording...')
    while not is_stopping() and recorder.error is None:
        now = session.clock.now()
        if is_waiting:
            if not _has_time(recorder):
                session.clock.wait(_CLOCK_PERIOD, session.executor.spin_once)
                continue
            is_waiting = False
            log.info('Sim time /clock found, starting recording.')
            log.info('Recording...')
        if is_looking and now >= next_look:
            next_look = now + period
            for topic in recorder.discover():
                log.info(f"Subscribed to topic '{topic}'")
            if recorder.is_complete:
                log.info('All requested topics are subscribed. Stopping discovery...')
            is_looking = not (args.no_discovery or recorder.is_complete)
        status.show(now - began)
        left = min(next_look - now, _STATUS_PERIOD) if is_looking else _STATUS_PERIOD
        session.clock.wait(left, session.executor.spin_once)
    status.clear()


def _has_time(recorder: Recorder) -> bool:
    return recorder.node.get_clock().now().nanoseconds > 0


class Status:
    """A line of what is recorded, a second, if somebody sits there."""

    def __init__(self, recorder: Recorder) -> None:
        self._recorder = recorder
        self._is_seen = sys.stderr.isatty()
        self._last = 0.0

    def show(self, elapsed: float) -> None:
        """Show it ``elapsed`` s after the start, if a second has gone."""
        if self._is_seen and elapsed - self._last >= _STATUS_PERIOD:
            self._last = elapsed
            if not is_in_foreground(sys.stderr.fileno()):
                return
            print(f'\r\x1b[K{self.text(elapsed)}', end='', file=sys.stderr, flush=True)

    def text(self, elapsed: float) -> str:
        """Return the line."""
        recorder = self._recorder
        lost = sum(recorder.lost.values())
        return (
            f'{elapsed:.0f} s: {recorder.messages_received} messages of '
            f'{len(recorder.topics)} topics, {size_text(recorder.bytes_received)}'
            f'{f", {lost} lost" if lost else ""}{", paused" if recorder.is_paused else ""}'
        )

    def clear(self) -> None:
        """Leave the line empty."""
        if self._is_seen:
            print('\r\x1b[K', end='', file=sys.stderr, flush=True)


def _tell_lost(recorder: Recorder) -> None:
    for topic, count in sorted(recorder.lost.items()):
        recorder.node.get_logger().warning(
            f'Cache buffers lost messages per topic: {topic}: {count}; --max-cache-size is too '
            'small, or the disk too slow'
        )


def _filter(args: Namespace, node: Node) -> TopicFilter:
    def names(given: list[str] | None) -> list[str]:
        return [full_name(node, name) for name in given or ()]

    overridden = args.all or args.all_topics or args.all_services
    return TopicFilter(
        all_topics=args.all or args.all_topics,
        all_services=args.all or args.all_services,
        topics=names(args.topics),
        topic_types=args.topic_types,
        services=names(args.services),
        regex='' if overridden else args.regex,
        exclude_regex=args.exclude_regex,
        exclude_topics=names(args.exclude_topics),
        exclude_topic_types=args.exclude_topic_types,
        exclude_services=names(args.exclude_services),
        include_hidden_topics=args.include_hidden_topics,
    )
