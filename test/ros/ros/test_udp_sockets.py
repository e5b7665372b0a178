# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The list of UDP sockets, from the kernel itself."""

import os
import socket
import subprocess
import sys

import pytest

from amr_description.ros import udp_sockets
from amr_description.ros.udp_sockets import sockets_of_table

# Opens and closes sockets until its stdin is closed.
OTHERS = """
import select, socket, sys
while not select.select([sys.stdin], [], [], 0)[0]:
    some = [socket.socket(type=socket.SOCK_DGRAM) for _ in range(40)]
    for each in some:
        each.bind(('127.0.0.1', 0))
    for each in some:
        each.close()
"""


def bound(address, family=socket.AF_INET):
    found = socket.socket(family, socket.SOCK_DGRAM)
    found.bind((address, 0))
    return found


def inode(found):
    return os.fstat(found.fileno()).st_ino


@pytest.mark.parametrize('is_refused', [False, True])
def test_sockets_have_port_and_inode(monkeypatch, is_refused):
    if is_refused:
        monkeypatch.setattr(udp_sockets, '_NETLINK_SOCK_DIAG', 31)  # there is none
    with bound('127.0.0.1') as first, bound('::1', socket.AF_INET6) as second:
        found = udp_sockets.udp_sockets()
        for each in (first, second):
            assert inode(each) in found[each.getsockname()[1]]
        port, closed = first.getsockname()[1], inode(first)
    # The port itself may be that of another process already.
    assert closed not in udp_sockets.udp_sockets().get(port, set())


def test_a_request_that_the_kernel_refuses_is_answered_by_the_tables(monkeypatch):
    monkeypatch.setattr(udp_sockets, '_SOCK_DIAG_BY_FAMILY', 99)
    with bound('127.0.0.1') as each:
        with pytest.raises(OSError):
            list(udp_sockets._by_netlink())
        assert inode(each) in udp_sockets.udp_sockets()[each.getsockname()[1]]


def test_none_is_left_out_while_others_come_and_go():
    ours = [bound('127.0.0.1') for _ in range(200)]
    ports = {each.getsockname()[1] for each in ours}
    others = subprocess.Popen([sys.executable, '-I', '-S', '-c', OTHERS], stdin=subprocess.PIPE)
    try:
        for _ in range(300):
            assert ports <= udp_sockets.udp_sockets().keys()
    finally:
        others.communicate()
        for each in ours:
            each.close()


def test_a_table_is_read_below_its_heading():
    table = [
        'sl local_address rem_address st tx_queue rx_queue tr tm->when retrnsmt uid timeout inode',
        '4: 0100007F:1CF2 00000000:0000 07 00000000:00000000 00:00000000 00000000 0 0 5065452 2\n',
    ]
    assert list(sockets_of_table(table)) == [(7410, 5065452)]
