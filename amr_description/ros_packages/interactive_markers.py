# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``interactive_markers``: handles and menus that RViz shows, and what is done with them.

A change is seen by the clients once ``applyChanges`` is called; callbacks change at once.
"""

# ruff: noqa: N802, N803 (the original's names)

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
import sys
from threading import RLock
from typing import Any

from builtin_interfaces.msg import Time as TimeMessage
from geometry_msgs.msg import Pose
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.time import Time
from std_msgs.msg import Header
from visualization_msgs.msg import (
    InteractiveMarker,
    InteractiveMarkerFeedback,
    InteractiveMarkerPose,
    InteractiveMarkerUpdate,
    MenuEntry,
)
from visualization_msgs.srv import GetInteractiveMarkers

FeedbackCallback = Callable[[InteractiveMarkerFeedback], object]

_ALONE = Duration(seconds=1)
"""For so long after a client has moved a marker, others may not."""


@dataclass
class _Callbacks:
    """What is called at feedback of a marker."""

    default: FeedbackCallback | None = None
    by_event: dict[int, FeedbackCallback] = field(default_factory=dict)

    def set(self, callback: FeedbackCallback | None, event: int) -> None:
        if event == InteractiveMarkerServer.DEFAULT_FEEDBACK_CALLBACK:
            self.default = callback
        elif callback is None:
            self.by_event.pop(event, None)
        else:
            self.by_event[event] = callback


@dataclass
class _Shown:
    """A marker as the clients have it, and who was the last to touch it."""

    marker: InteractiveMarker
    touched: Time | None = None
    client: str = ''


@dataclass
class _Pending:
    """What the next ``applyChanges`` sends of a marker."""

    marker: InteractiveMarker | None = None
    """A new one, or one to take another's place."""
    pose: Pose | None = None
    header: Header | None = None
    is_erased: bool = False


class InteractiveMarkerServer:
    """Shows interactive markers below ``<namespace>/update`` and hears what clients do."""

    DEFAULT_FEEDBACK_CALLBACK = 255

    def __init__(
        self,
        node: Node,
        namespace: str,
        *,
        update_pub_qos: QoSProfile | None = None,
        feedback_sub_qos: QoSProfile | None = None,
    ) -> None:
        self.node = node
        self.namespace = namespace
        self.seq_num = 0
        self._lock = RLock()  # a callback may change markers
        self._shown: dict[str, _Shown] = {}
        self._pending: dict[str, _Pending] = {}
        self._callbacks: dict[str, _Callbacks] = {}
        self._service = node.create_service(
            GetInteractiveMarkers, f'{namespace}/get_interactive_markers', self._answer
        )
        self._publisher = node.create_publisher(
            InteractiveMarkerUpdate, f'{namespace}/update', update_pub_qos or QoSProfile(depth=100)
        )
        self._subscription = node.create_subscription(
            InteractiveMarkerFeedback,
            f'{namespace}/feedback',
            self.processFeedback,
            feedback_sub_qos or QoSProfile(depth=1),
        )
        self._is_open = True

    def shutdown(self) -> None:
        """Take away all markers, and what was made of the node; to be called before its end."""
        if not self._is_open:
            return
        self._is_open = False
        if self.node.context.ok():
            self.clear()
            self.applyChanges()
        self.node.destroy_service(self._service)
        self.node.destroy_publisher(self._publisher)
        self.node.destroy_subscription(self._subscription)

    def insert(
        self,
        marker: InteractiveMarker,
        *,
        feedback_callback: FeedbackCallback | None = None,
        feedback_type: int = DEFAULT_FEEDBACK_CALLBACK,
    ) -> None:
        """Show a marker, in place of one of that name."""
        with self._lock:
            self._pending[marker.name] = _Pending(marker)
            if feedback_callback is not None:
                self.setCallback(marker.name, feedback_callback, feedback_type)

    def setPose(self, name: str, pose: Pose, header: Header | None = None) -> bool:
        """Move a marker that is shown; without a frame in ``header`` it keeps its own."""
        with self._lock:
            pending = self._pending.get(name)
            shown = self._shown.get(name)
            if shown is None or (pending is not None and pending.marker is not None):
                return False
            own = shown.marker.header
            self._move(name, pose, header if header is not None and header.frame_id else own)
            return True

    def erase(self, name: str) -> bool:
        """Take a marker away; return whether there was one."""
        with self._lock:
            if name not in self._shown and name not in self._pending:
                return False
            self._pending[name] = _Pending(is_erased=True)
            return True

    def clear(self) -> None:
        """Take all markers away."""
        with self._lock:
            self._pending = {name: _Pending(is_erased=True) for name in self._shown}

    def setCallback(
        self,
        name: str,
        feedback_callback: FeedbackCallback | None,
        feedback_type: int = DEFAULT_FEEDBACK_CALLBACK,
    ) -> bool:
        """Call this at feedback of a kind, or, by default, of any that has no other."""
        with self._lock:
            if name not in self._shown and name not in self._pending:
                return False
            self._callbacks.setdefault(name, _Callbacks()).set(feedback_callback, feedback_type)
            return True

    def applyChanges(self) -> None:
        """Send what was changed since the last time."""
        with self._lock:
            if not self._pending:
                return
            pending, self._pending = self._pending, {}
            update = InteractiveMarkerUpdate(
                server_id=self.node.get_fully_qualified_name(), type=InteractiveMarkerUpdate.UPDATE
            )
            for name, change in pending.items():
                self._apply(name, change, update)
            self.seq_num += 1
            update.seq_num = self.seq_num
            self._publisher.publish(update)

    def get(self, name: str) -> InteractiveMarker | None:
        """Return a marker as it will be after ``applyChanges``; None: there will be none."""
        with self._lock:
            pending = self._pending.get(name, _Pending())
            if pending.is_erased:
                return None
            if pending.marker is not None:
                return pending.marker
            shown = self._shown.get(name)
            if shown is None:
                return None
            if pending.pose is not None:
                shown.marker.pose = pending.pose
            return shown.marker

    def processFeedback(self, feedback: InteractiveMarkerFeedback) -> None:
        """Do what a client has done: move the marker, and call who waits for it."""
        name = feedback.marker_name
        with self._lock:
            shown = self._shown.get(name)
            now = self.node.get_clock().now()
            if shown is None:
                return
            is_held = shown.touched is not None and now - shown.touched < _ALONE
            if is_held and shown.client != feedback.client_id:
                self.node.get_logger().debug(f"feedback for '{name}' of a second client is left")
                return
            shown.client, shown.touched = feedback.client_id, now
            pending = self._pending.get(name)
            is_replaced = pending is not None and pending.marker is not None
            if feedback.event_type == InteractiveMarkerFeedback.POSE_UPDATE and not is_replaced:
                # A marker without a stamp stays in its frame, wherever that goes.
                is_fixed = shown.marker.header.stamp == TimeMessage()
                header = shown.marker.header if is_fixed else feedback.header
                self._move(name, feedback.pose, header)
            callbacks = self._callbacks.get(name, _Callbacks())
            callback = callbacks.by_event.get(feedback.event_type, callbacks.default)
        if callback is not None:
            callback(feedback)
        self.applyChanges()

    def _move(self, name: str, pose: Pose, header: Header) -> None:
        self._pending[name] = _Pending(pose=pose, header=header)

    def _apply(self, name: str, change: _Pending, update: InteractiveMarkerUpdate) -> None:
        shown = self._shown.get(name)
        if change.is_erased:
            self._callbacks.pop(name, None)
            if self._shown.pop(name, None):
                update.erases.append(name)
        elif change.marker is not None:
            if shown is None:
                self._shown[name] = _Shown(change.marker)
            else:
                shown.marker = change.marker
            update.markers.append(change.marker)
        elif shown is not None:
            shown.marker.pose, shown.marker.header = change.pose, change.header
            moved = InteractiveMarkerPose(name=name, pose=change.pose, header=change.header)
            update.poses.append(moved)

    def _answer(self, _request: Any, response: Any) -> Any:
        with self._lock:
            response.sequence_number = self.seq_num
            response.markers = [shown.marker for shown in self._shown.values()]
        return response


@dataclass
class _Entry:
    title: str
    command: str
    command_type: int
    callback: FeedbackCallback | None
    below: list[int] = field(default_factory=list)
    is_visible: bool = True
    check_state: int = 0


class MenuHandler:
    """A menu of markers: its entries, and what is called when one is chosen."""

    NO_CHECKBOX = 0
    CHECKED = 1
    UNCHECKED = 2

    def __init__(self) -> None:
        self._entries: dict[int, _Entry] = {}
        self._top: list[int] = []
        self._markers: set[str] = set()

    def insert(
        self,
        title: str,
        parent: int | None = None,
        command_type: int = MenuEntry.FEEDBACK,
        command: str = '',
        callback: FeedbackCallback | None = None,
    ) -> int | None:
        """Add an entry, below another one if ``parent`` is given; return its number."""
        if parent is not None and parent not in self._entries:
            print(f"Parent menu entry '{parent}' not found", file=sys.stderr)
            return None
        handle = len(self._entries) + 1
        self._entries[handle] = _Entry(title, command, command_type, callback)
        (self._top if parent is None else self._entries[parent].below).append(handle)
        return handle

    def setVisible(self, handle: int, visible: bool) -> bool:
        """Show or hide an entry; return whether there is one."""
        if handle not in self._entries:
            return False
        self._entries[handle].is_visible = visible
        return True

    def setCheckState(self, handle: int, check_state: int) -> bool:
        """Tick an entry, or not; return whether there is one."""
        if handle not in self._entries:
            return False
        self._entries[handle].check_state = check_state
        return True

    def getCheckState(self, handle: int) -> int | None:
        """Return whether an entry is ticked; None: there is none of that number."""
        return self._entries[handle].check_state if handle in self._entries else None

    def getTitle(self, handle: int) -> str | None:
        """Return the text of an entry; None: there is none of that number."""
        return self._entries[handle].title if handle in self._entries else None

    def apply(self, server: InteractiveMarkerServer, marker_name: str) -> bool:
        """Give a marker this menu as it is now; return whether there is such a marker."""
        marker = server.get(marker_name)
        if marker is None:
            self._markers.discard(marker_name)
            return False
        marker.menu_entries = list(self._messages(self._top, 0))
        server.insert(
            marker,
            feedback_callback=self.processFeedback,
            feedback_type=InteractiveMarkerFeedback.MENU_SELECT,
        )
        self._markers.add(marker_name)
        return True

    def reApply(self, server: InteractiveMarkerServer) -> bool:
        """Do so again for all that have it; return whether all are there."""
        return all([self.apply(server, name) for name in sorted(self._markers)])

    def processFeedback(self, feedback: InteractiveMarkerFeedback) -> None:
        """Call what waits for an entry that was chosen."""
        entry = self._entries.get(feedback.menu_entry_id)
        if entry is not None and entry.callback is not None:
            entry.callback(feedback)

    def _messages(self, handles: list[int], parent: int) -> Iterator[MenuEntry]:
        ticks = {self.NO_CHECKBOX: '', self.CHECKED: '[x] ', self.UNCHECKED: '[ ] '}
        for handle in handles:
            entry = self._entries[handle]
            if entry.is_visible:
                yield MenuEntry(
                    id=handle,
                    parent_id=parent,
                    title=ticks[entry.check_state] + entry.title,
                    command=entry.command,
                    command_type=entry.command_type,
                )
                yield from self._messages(entry.below, handle)
