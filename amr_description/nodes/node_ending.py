# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The end of a node in a process that goes on.

rclpy 7.1 forgets one thing: ``~/get_type_description``, which rcl makes for every node and of
which rclpy has no more than the address. It would stay in the graph under the name of the node
that is gone, with 0.1 MB, and answer beside that of the next node of the name.
"""

from collections.abc import Callable
import ctypes
from functools import cache

from rclpy.node import Node


def destroy_node(node: Node) -> None:
    """Remove a node with all that it has; on the thread of its executor, which has let it go."""
    service = node._type_description_service._type_description_srv
    fini = _service_fini()
    if service is not None and fini is not None:
        with node.handle, service.impl:
            fini(service.impl.pointer, node.handle.pointer)  # a second time does nothing
    node.destroy_node()


@cache
def _service_fini() -> Callable[[int, int], int] | None:
    """``rcl_service_fini`` of the library that rclpy has loaded; None: it is not to be found."""
    try:
        fini = ctypes.CDLL('librcl.so').rcl_service_fini
    except (OSError, AttributeError):
        return None
    fini.argtypes = [ctypes.c_void_p, ctypes.c_void_p]
    return fini
