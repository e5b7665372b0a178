# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The machine: system, Python, memory, disks, network."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Python:
    """The interpreter that runs this, and the rclpy that it finds."""

    version: str
    executable: str
    extension_suffix: str
    """That of its binary modules: ``.cpython-312-x86_64-linux-gnu.so``."""
    rclpy_folder: str = ''
    """Where rclpy is found; empty: nowhere."""
    rclpy_suffixes: tuple[str, ...] = ()
    """Of which interpreters rclpy has its binary module, as ``extension_suffix``."""
    rclpy_version: str = ''
    rclpy_fault: str = ''
    """Why rclpy cannot be imported; empty: it can be, or it was not tried."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Disk:
    """The file system in which a folder is."""

    purpose: str
    """What the folder is for: ``log files``."""
    folder: str
    free: int
    """Bytes that this user may still write."""
    total: int
    """Bytes."""
    is_writable: bool = True
    """Whether this user may write into the folder, or make it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Interface:
    """A network interface."""

    name: str
    is_up: bool = True
    is_loopback: bool = False
    has_multicast: bool = True
    is_tunnel: bool = False
    """Of a VPN: point to point, without a link layer."""
    addresses: tuple[str, ...] = ()
    """IPv4."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Machine:
    """The machine that this runs on."""

    system: str
    """``Linux 6.1.0``."""
    architecture: str
    """``x86_64``."""
    c_library: str
    """``glibc 2.36``; empty: another one."""
    processors: int
    load: float
    """Programs that ran or wanted to, in the mean of the last minute."""
    python: Python
    encoding: str
    """Of text on the terminal and of file names."""
    memory: int
    """Bytes."""
    free_memory: int
    """Bytes that programs can get without swapping."""
    stalled_by_memory: float
    """Share of the last 10 s in which all programs waited for memory, 0 to 1."""
    disks: tuple[Disk, ...] = ()
    interfaces: tuple[Interface, ...] = ()
    firewall: str = ''
    """The name of the one that is active: ``ufw``; empty: none, or not known."""
    is_clock_synchronised: bool | None = None
    """Whether the kernel says that some service keeps the clock right; None: not known."""
