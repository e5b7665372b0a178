# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The services and events of a recorder."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

from rclpy.node import Node
from rosbag2_interfaces.msg import WriteSplitEvent
from rosbag2_interfaces.srv import IsPaused, Pause, Resume, Snapshot, SplitBagfile

from amr_description.bag.ros.recorder import Recorder


def offer_services(recorder: Recorder) -> None:
    """Serve ``~/pause``, ``~/resume``, ``~/is_paused``, ``~/split_bagfile``, ``~/snapshot``."""
    node = recorder.node

    def is_paused(_request: Any, response: Any) -> Any:
        response.paused = recorder.is_paused
        return response

    def snapshot(_request: Any, response: Any) -> Any:
        response.success = recorder.snapshot()
        return response

    node.create_service(Pause, '~/pause', _doing(recorder.pause))
    node.create_service(Resume, '~/resume', _doing(recorder.resume))
    node.create_service(IsPaused, '~/is_paused', is_paused)
    node.create_service(SplitBagfile, '~/split_bagfile', _doing(recorder.split))
    if recorder.options.snapshot_mode:
        node.create_service(Snapshot, '~/snapshot', snapshot)


def split_publisher(node: Node) -> Callable[[Path, Path], None]:
    """Return what tells ``events/write_split`` of a new file."""
    publisher = node.create_publisher(WriteSplitEvent, 'events/write_split', 1)

    def publish(closed: Path, opened: Path) -> None:
        publisher.publish(
            WriteSplitEvent(
                closed_file=str(closed),
                opened_file=str(opened),
                node_name=node.get_fully_qualified_name(),
            )
        )

    return publish


def _doing(act: Callable[[], object]) -> Callable[[Any, Any], Any]:
    def serve(_request: Any, response: Any) -> Any:
        act()
        return response

    return serve
