# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The processes of this host that are of ROS, as far as this user may see them."""

from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True, slots=True, kw_only=True)
class ObservedProcess:
    """A process that takes part in a ROS domain, or that a bring-up has started."""

    pid: int
    command: str
    """Its words, shortened."""
    domain: int | None
    """Whose ports it listens to; None: it is in none."""
    state: str = 'S'
    """As proc(5) has it: ``T`` is stopped."""
    variables: Mapping[str, str] = field(default_factory=dict)
    """Of its environment, those that configure ROS and DDS."""
    run: str = ''
    """The name of the bring-up's run that started it; empty: none."""
    open_files: int = 0
    most_open_files: int = 0
    """Its limit; 0: not known."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SharedMemory:
    """Segments of Fast DDS in ``/dev/shm`` whose owner is gone."""

    files: tuple[str, ...] = ()
    size: int = 0
    """Bytes."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Processes:
    """What runs on this host."""

    domain: int
    """That of this process."""
    processes: tuple[ObservedProcess, ...] = ()
    """Without this one."""
    runs: frozenset[str] = frozenset()
    """Names of the runs of bring-ups whose supervisor lives."""
    left_memory: SharedMemory = SharedMemory()
    is_alone: bool | None = None
    """Whether the graph has no node but ours; None: not known."""
