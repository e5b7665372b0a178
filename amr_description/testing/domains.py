# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
ROS domains that nobody else is in, as far as they ask here.

So several tests can run side by side: of several checkouts, or of one.
"""

from collections.abc import Iterator
from contextlib import contextmanager
import fcntl
import os
from pathlib import Path
import tempfile

from amr_description.errors import SimulationError

# Domains whose ports lie below the system's ephemeral ones; 0 is everybody's.
DOMAINS = range(1, 102)
LOCKS = Path(tempfile.gettempdir())

DOMAIN = 'ROS_DOMAIN_ID'
RANGE = 'ROS_AUTOMATIC_DISCOVERY_RANGE'


def take_domain() -> tuple[int, int]:
    """
    Return a domain that no other test holds, and the open file that holds it.

    Never the one of the shell: a robot may be listening there. Raises SimulationError.
    """
    forbidden = os.environ.get(DOMAIN)
    start = os.getpid() % len(DOMAINS)
    for domain in (*DOMAINS[start:], *DOMAINS[:start]):
        if str(domain) == forbidden:
            continue
        try:
            lock = os.open(LOCKS / f'ros_domain_{domain}.lock', os.O_CREAT | os.O_RDWR, 0o666)
        except PermissionError:  # another user's
            continue
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            os.close(lock)
            continue
        return domain, lock
    raise SimulationError(f'all ROS domains from {DOMAINS[0]} to {DOMAINS[-1]} are taken')


@contextmanager
def own_domain() -> Iterator[int]:
    """
    Be, with all that is started inside, in a free domain on this host; yield its number.

    Contexts of rclpy that are initialised inside are in it; those from before stay where they
    are. Raises SimulationError.
    """
    before = {name: os.environ.get(name) for name in (DOMAIN, RANGE)}
    domain, lock = take_domain()
    try:
        os.environ |= {DOMAIN: str(domain), RANGE: 'LOCALHOST'}
        yield domain
    finally:
        for name, value in before.items():
            if value is None:
                os.environ.pop(name, None)
            else:
                os.environ[name] = value
        os.close(lock)
