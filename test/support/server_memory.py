# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Make forks of a server cheap: in memory that they share with it, and for its own parent.

Of what a short program takes once its modules are loaded, most is the kernel copying memory: the
tables of all pages at the fork, then each page that is written. Python writes to what it only
reads, as it counts references.
"""

import ctypes
import functools
import gc
from pathlib import Path
import platform
import types

import numpy as np

_CLONE_PARENT = 0x00008000  # linux/sched.h
_CLONE_CHILD_CLEARTID = 0x00200000
_CLONE_CHILD_SETTID = 0x01000000
_SIGCHLD = 17
# asm/unistd.h: clone, get_robust_list, set_robust_list
_NUMBERS = {'x86_64': (56, 274, 273), 'aarch64': (220, 100, 99)}
_MADV_COLLAPSE = 25  # asm-generic/mman-common.h
_PR_GET_TID_ADDRESS = 40  # linux/prctl.h
_IMMORTAL = 0xFFFFFFFF
"""The count of references of an object that never dies, and whose references nobody counts."""
_LOWEST = 64
"""An address below all objects: numpy takes memory at 0 for none."""


def share_objects():
    """
    Have nobody count the references to what is loaded, so that to use it does not copy it.

    CPython 3.12 itself has such objects (PEP 683): None, and names. Call it before ``gc.freeze``.
    """
    containers = gc.get_objects()
    _make_immortal(containers)
    found = gc.get_referents(*containers)
    _make_immortal(found)
    # What the garbage collection does not know may hold others: code, and constants in tuples.
    known = set()
    while found:
        inner = []
        for each in found:
            kind = type(each)
            if kind in (tuple, dict, types.CodeType) and id(each) not in known:
                if kind is types.CodeType:
                    known.add(id(each))
                    inner += (each.co_consts, each.co_names, each.co_linetable)
                    inner += (each.co_exceptiontable, each.co_filename)
                elif not gc.is_tracked(each):
                    known.add(id(each))
                    inner += gc.get_referents(each)
        _make_immortal(inner)
        found = inner


def _make_immortal(objects):
    addresses = np.fromiter(map(id, objects), np.int64, len(objects))
    _words()[(addresses - _LOWEST) >> 2] = _IMMORTAL


@functools.cache
def _words():
    """The memory of this process from _LOWEST on; an object begins with its count."""

    class Memory:
        __array_interface__ = {
            'shape': ((1 << 45) - _LOWEST,),
            'typestr': '<u4',
            'data': (_LOWEST, False),
            'version': 3,
        }

    return np.asarray(Memory())


def use_huge_pages():
    """
    Put what this process has allocated into huge pages, whose tables a fork need not copy.

    A process that writes to one gets a page of its own of the usual size. Linux before 6.1 leaves
    all as it is.
    """
    size = 1 << 21
    library = ctypes.CDLL(None)
    for line in Path('/proc/self/maps').read_text(errors='surrogateescape').splitlines():
        bounds, permissions, _, device, *_ = line.split(maxsplit=4)
        start, end = (int(bound, 16) for bound in bounds.split('-'))
        start, end = -(-start // size) * size, end // size * size
        if permissions == 'rw-p' and device == '00:00' and start < end:
            library.madvise(ctypes.c_void_p(start), ctypes.c_size_t(end - start), _MADV_COLLAPSE)


class SiblingFork:
    """
    ``os.fork`` whose child is one of this process's parent, as if that had forked.

    The C library cannot: what it does beside the system call is done here for the one thread that
    forks. Others there may be, as long as they only wait: those of LTTng.
    """

    def __init__(self):
        self._python = ctypes.pythonapi
        self._library = ctypes.PyDLL(None)  # keeps the interpreter's lock
        clone, get_robust_list, self._set_robust_list = _NUMBERS[platform.machine()]
        thread = ctypes.c_void_p()  # where the C library has the number of this thread
        if self._library.prctl(_PR_GET_TID_ADDRESS, ctypes.byref(thread), 0, 0, 0):
            raise OSError('the kernel does not say where the number of this thread is')
        self._robust, self._robust_size = ctypes.c_void_p(), ctypes.c_size_t()
        self._library.syscall(
            get_robust_list, 0, ctypes.byref(self._robust), ctypes.byref(self._robust_size)
        )
        flags = _CLONE_PARENT | _CLONE_CHILD_SETTID | _CLONE_CHILD_CLEARTID | _SIGCHLD
        last = (thread, None) if clone == 56 else (None, thread)
        self._arguments = [ctypes.c_long(clone), ctypes.c_ulong(flags), None, None, *last]

    def __call__(self):
        """Fork; return 0 in the child, and its pid in this process."""
        self._python.PyOS_BeforeFork()
        pid = self._library.syscall(*self._arguments)
        if pid == 0:
            self._library.syscall(self._set_robust_list, self._robust, self._robust_size)
            self._python.PyOS_AfterFork_Child()
            return 0
        self._python.PyOS_AfterFork_Parent()
        if pid < 0:
            raise OSError('cannot fork')
        return pid
