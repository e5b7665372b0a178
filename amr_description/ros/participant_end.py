# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Mend how Fast DDS 2.14.5 waits for a callback of discovery when it destroys a participant.

It waits "for ever", by ``set_listener(nullptr)``, whose time-out is ``seconds::max()``. In the
conversion to the system's clock that overflows to a time before 1970, which
``pthread_cond_timedwait`` refuses at once, without unlocking the mutex; so the thread waits in a
loop, holding the mutex that the callback needs to end. (Fast DDS issue 6513.) It has the
interpreter's lock, too: no signal but SIGKILL ends such a process. Of programs that ended while
other nodes came and went beside them, on a busy machine, it befell one of a thousand.

Here the wait gets a time-out that does not overflow. It is a constant in the first instruction of
that function; nothing else of the library is touched, and nothing at all of another version or of
another processor.

This module imports no rclpy.
"""

from contextlib import suppress
import ctypes
from functools import cache

TIMEOUT = 10 * 365 * 86_400
"""s; long enough for any callback. Fast DDS adds it to a time in ns since 1970, of 64 bits."""

_LIBRARY = 'libfastrtps.so.2.14'
_SET_LISTENER = (  # DomainParticipant::set_listener(DomainParticipantListener *)
    '_ZN8eprosima7fastdds3dds17DomainParticipant12set_listenerEPNS1_25DomainParticipantListenerE'
)
_LOAD = b'\x48\xba'  # movabs $constant, %rdx: of x86-64, the third argument of what it calls
_FOR_EVER = (2**63 - 1).to_bytes(8, 'little')


@cache
def bound_listener_wait() -> None:
    """
    Have participants of this process end while discovery goes on; once rclpy is initialised.

    Where the code is not as expected, or the system does not let it be changed, it stays as it is.
    """
    with suppress(OSError, AttributeError):  # no such library, or function
        function = ctypes.CDLL(_LIBRARY)[_SET_LISTENER]
        address = ctypes.cast(function, ctypes.c_void_p).value or 0
        # The kernel writes to a copy of the page, although the process itself may not.
        with open('/proc/self/mem', 'r+b', buffering=0) as memory:
            memory.seek(address)
            if memory.read(len(_LOAD + _FOR_EVER)) == _LOAD + _FOR_EVER:
                memory.seek(address + len(_LOAD))
                memory.write(TIMEOUT.to_bytes(8, 'little'))
