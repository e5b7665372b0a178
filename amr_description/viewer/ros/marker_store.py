# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The markers of a topic, as messages add, change and delete them. Pure, on any thread."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from functools import partial
import math
from pathlib import Path
from typing import NamedTuple, TypeAlias

from amr_description.clock import NANOSECONDS
from amr_description.errors import MeshError, ResourceError
from amr_description.ros import readers
from amr_description.ros.readers import MarkerData
from amr_description.text import shorten
from amr_description.viewer.description import served_file
from amr_description.viewer.protocol import Origin
from amr_description.viewer.ros.marks import Drawn, MarkDrawing, MarkError, size_of

_MOST_MARKERS = 100_000
"""That are kept."""
_ADD, _DELETE, _DELETE_ALL = 0, 2, 3
"""visualization_msgs/msg/Marker"""


_MeshKey: TypeAlias = tuple[str, str, bytes]
"""Resource, and name and content of the file that comes with the marker."""


class _Mesh(NamedTuple):
    """A file that is served, or why there is none."""

    name: str = ''
    content: Path | bytes = b''
    fault: str = ''


class MarkerStore:
    """
    The markers of a topic, by namespace and id.

    Attributes:
        files: The meshes that they name, by the names in their addresses; replaced as a whole.
        expires: When the next of them ends, s; infinity: none does.
        time: Of the last message, s.
        is_empty: Whether there is none.
    """

    def __init__(self) -> None:
        self._markers: dict[tuple[str, int], tuple[MarkerData, float]] = {}
        self._unknown: list[str] = []
        self._meshes: dict[_MeshKey, _Mesh] = {}
        """Those of the last drawing."""
        self.time = -math.inf
        self.is_empty = True
        self.files: Mapping[str, Path | bytes] = {}
        self.expires = math.inf

    def apply(self, markers: Iterable[MarkerData], now: float) -> None:
        """Take in the markers of a message that came at a ROS time, s."""
        self._forget_future(now)
        self._unknown.clear()
        for each in markers:
            key = each.ns, each.id
            if each.action == _ADD and (key in self._markers or self._has_room):
                end = now + each.lifetime / NANOSECONDS if each.lifetime > 0 else math.inf
                self._markers[key] = each, end
            elif each.action == _DELETE:
                self._markers.pop(key, None)
            elif each.action == _DELETE_ALL:
                self._markers.clear()
            elif each.action != _ADD:
                self._unknown.append(f'Unknown marker action: {each.action}')

    def _forget_future(self, now: float) -> None:
        """After a reset: what was drawn is of a time that has not come yet."""
        if now < self.time:
            self._markers.clear()
        self.time = now

    @property
    def _has_room(self) -> bool:
        return len(self._markers) < _MOST_MARKERS

    def draw(self, origin: Origin, now: float) -> Drawn:
        """Return all that is there at a ROS time, s."""
        self._forget_future(now)
        kept = {key: each for key, each in self._markers.items() if each[1] > now}
        self._markers, self.is_empty = kept, not kept
        self.expires = min((end for _, end in kept.values()), default=math.inf)
        markers = [each for each, _ in kept.values()]
        sizes = [size_of(each) for each in markers]
        drawing = MarkDrawing(sum(sizes), singles=sizes.count(1))
        for text in self._unknown:
            drawing.tell(text, '')
        meshes: dict[_MeshKey, _Mesh] = {}
        for each in markers:
            drawing.add_marker(each, partial(self._mesh, meshes))
        # Of what no marker names any more nothing is kept: there may be new ones all the time.
        self._meshes = meshes
        self.files = {each.name: each.content for each in meshes.values() if each.name}
        newest = max((each.header.stamp for each in markers), default=0)
        return drawing.finish(replace(origin, stamp=newest / NANOSECONDS))

    def _mesh(self, meshes: dict[_MeshKey, _Mesh], marker: MarkerData) -> str:
        """Return the address of the mesh of a marker, and note it in ``meshes``. May raise."""
        uri, (name, data) = marker.mesh_resource, marker.mesh
        key = uri, name, data.tobytes()
        mesh = meshes.get(key) or self._meshes.get(key) or _mesh_of(*key)
        meshes[key] = mesh
        if mesh.fault:
            raise MarkError(mesh.fault)
        return f'/mesh/{mesh.name}'


def _mesh_of(uri: str, name: str, data: bytes) -> _Mesh:
    try:
        file = served_file(uri, (name, data) if data else None)
    except (ResourceError, MeshError) as error:
        return _Mesh(fault=f'Could not load resource [{shorten(uri)}]: {error}')
    return _Mesh(file.name, file.content)


def markers_sample(data: bytes, origin: Origin) -> Drawn:
    """Draw what one MarkerArray adds. Raises ValueError: it ends too early."""
    return _alone(readers.MARKERS.read(data), origin)


def marker_sample(data: bytes, origin: Origin) -> Drawn:
    """Draw what one Marker adds. Raises ValueError: it ends too early."""
    return _alone([readers.MARKER.read(data)], origin)


def _alone(markers: Sequence[MarkerData], origin: Origin) -> Drawn:
    store = MarkerStore()
    store.apply(markers, 0.0)
    return store.draw(origin, 0.0)
