# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Messages about bags: one that the page shows in place of a ROS graph, and one that is recorded.

What a bag holds is sent as a graph is: robots, states, samples. ``time`` of a state is that of the
last ``/clock`` of the bag, if it has one, else the time at which its messages were received.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar, TypeAlias


@dataclass(frozen=True, slots=True)
class Recording:
    """The bag that is shown. There is no graph: nothing can be driven, stopped or changed."""

    type: ClassVar[str] = 'recording'
    name: str  #: of its folder or file
    path: str
    begin: float  #: when it was begun, s since 1970, or of simulated time
    length: float  #: s
    messages: int
    size: int  #: bytes


@dataclass(frozen=True, slots=True)
class Playhead:
    """What time of the bag is shown, for all pages; sent while it changes."""

    type: ClassVar[str] = 'playhead'
    place: float  #: s since the bag's begin
    playing: bool
    rate: float  #: how many times faster than it was recorded


@dataclass(frozen=True, slots=True)
class BagWriting:
    """What the node records at a page's wish; it goes on when the page has gone."""

    type: ClassVar[str] = 'bag_writing'
    active: bool
    path: str  #: the folder of the present bag, else of the last one; empty: there was none
    seconds: float
    messages: int
    size: int  #: bytes of the messages
    topics: int
    lost: int  #: messages for which there was no room
    error: str  #: why it has ended by itself; may be empty
    folder: str  #: where bags are made
    free: int  #: bytes that are free there


@dataclass(frozen=True, slots=True)
class Seek:
    """Show another time of the bag."""

    types: ClassVar[tuple[str, ...]] = ('seek',)
    id: int
    place: float  #: s since the bag's begin


@dataclass(frozen=True, slots=True)
class Playback:
    """Play the bag from where it is, from its begin when it is at the end; or pause."""

    types: ClassVar[tuple[str, ...]] = ('playback',)
    id: int
    playing: bool
    rate: float  #: how many times faster than it was recorded; above 0, at most 100


@dataclass(frozen=True, slots=True)
class ReadSeries:
    """Ask for a number of all messages of a topic of the bag: SeriesData."""

    types: ClassVar[tuple[str, ...]] = ('series',)
    id: int
    topic: str
    path: str  #: as ``ros2 topic echo --field`` has it


@dataclass(frozen=True, slots=True)
class ReadOverview:
    """Ask for states of the whole bag, evenly spaced: OverviewData."""

    types: ClassVar[tuple[str, ...]] = ('overview',)
    id: int


@dataclass(frozen=True, slots=True)
class StartRecording:
    """Have the node record topics into a new bag where it runs."""

    types: ClassVar[tuple[str, ...]] = ('start_recording',)
    id: int
    topics: tuple[str, ...]  #: none: all
    without_types: tuple[str, ...] = ()  #: types of messages that are left out


@dataclass(frozen=True, slots=True)
class StopRecording:
    """End what the node records."""

    types: ClassVar[tuple[str, ...]] = ('stop_recording',)
    id: int


@dataclass(frozen=True, slots=True)
class SeriesData:
    """
    What ``series`` is answered, in the order in which the messages were received.

    Of many messages, the least and the greatest value of those in a row stand for all.
    """

    stamps: str  #: f64, s, little-endian, in base64; of the header, else as states have their time
    values: str  #: likewise; NaN: there is no such element
    names: Mapping[str, str]  #: of the values of a state, as in Values


BagRequest: TypeAlias = (
    Seek | Playback | ReadSeries | ReadOverview | StartRecording | StopRecording
)
"""What pages ask about bags."""
