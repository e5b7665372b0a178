# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Have a process end without the destructors of the C++ libraries that it has loaded.

Fast DDS 2.14 sleeps for 0.1 s in the destructor of its factory of participants, as the very last
thing that a process does, although all of them are gone. Each of our programs would pay that, and
whoever waits for its end: of a bring-up that starts one program when another has exited, three in
a row.
"""

import ctypes
from functools import cache


@cache
def skip_destructors() -> None:
    """
    Have this process end at once when Python has finished; call it after Fast DDS was used.

    Nothing of Python's own end is left out, and what C code has written is flushed. The exit code
    stays. A participant that is left then says no goodbye: its nodes are destroyed before.
    """
    libc = ctypes.CDLL(None)
    try:
        register = libc.on_exit  # of glibc; its functions are called in reverse order
    except AttributeError:
        return
    register(libc._exit, None)  # with the exit code as its argument
    register(libc.fcloseall, None)
