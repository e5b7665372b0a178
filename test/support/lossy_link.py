# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A link between two network namespaces that loses frames and delays them, as a wireless one.

Few kernels of test machines have ``netem``. So each end is a TAP device, and this program, which
has both open, carries the frames: ``python lossy_link.py PID NAME PID NAME LOSS DELAY``.
"""

from collections import deque
import fcntl
import os
import random
import select
import struct
import sys
import time

_TUNSETIFF, _IFF_TAP, _IFF_NO_PI = 0x400454CA, 0x0002, 0x1000  # linux/if_tun.h
_FRAME = 65536
_QUEUE = 1000
"""Frames on their way, as in the queue of an interface; what is above is lost."""


def tap(pid: int, name: str) -> int:
    """Make a TAP device in the network of a process, and stay in that network; return its file."""
    network = os.open(f'/proc/{pid}/ns/net', os.O_RDONLY)
    os.setns(network, os.CLONE_NEWNET)
    os.close(network)
    file = os.open('/dev/net/tun', os.O_RDWR | os.O_NONBLOCK)
    fcntl.ioctl(file, _TUNSETIFF, struct.pack('16sH', name.encode(), _IFF_TAP | _IFF_NO_PI))
    return file


def carry(ends: tuple[int, int], loss: float, delay: float, chance: random.Random) -> None:
    """
    Carry frames between two TAP devices until stdin is closed.

    :param loss: Of all frames, 0 to 1; each is lost by itself.
    :param delay: From one end to the other, s.
    """
    other = dict(zip(ends, reversed(ends), strict=True))
    waiting: deque[tuple[float, int, bytes]] = deque()
    while True:
        pause = max(waiting[0][0] - time.monotonic(), 0.0) if waiting else None
        ready, _, _ = select.select([*ends, sys.stdin], [], [], pause)
        if sys.stdin in ready:
            return
        for end in ready:
            frame = os.read(end, _FRAME)
            if chance.random() >= loss and len(waiting) < _QUEUE:
                waiting.append((time.monotonic() + delay, other[end], frame))
        while waiting and waiting[0][0] <= time.monotonic():
            _, end, frame = waiting.popleft()
            try:
                os.write(end, frame)
            except OSError:  # the interface is down, or its queue is full
                continue


if __name__ == '__main__':
    first, its_name, second, other_name, lost, late = sys.argv[1:]
    both = tap(int(first), its_name), tap(int(second), other_name)
    print('up', flush=True)
    carry(both, float(lost), float(late), random.Random(0))
