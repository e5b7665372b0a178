# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Who is there: services with their types."""

from collections.abc import Iterable

from rclpy.node import Node
from rclpy.topic_or_service_is_hidden import topic_or_service_is_hidden

from amr_description.text import did_you_mean


def services(node: Node, *, hidden: bool = False) -> list[tuple[str, list[str]]]:
    """Return name and types of each service, sorted; with ``hidden`` also those with a ``_``."""
    return [
        (name, types)
        for name, types in sorted(node.get_service_names_and_types())
        if hidden or not topic_or_service_is_hidden(name)
    ]


def types_of_service(node: Node, service: str) -> list[str]:
    """Return the types under which a service, given by its absolute name, is served or called."""
    return dict(node.get_service_names_and_types()).get(service, [])


def explain_absence(service: str, type_name: str, known: Iterable[tuple[str, list[str]]]) -> str:
    """
    Return why nobody answers, as far as one can tell: it has another type, or another name.

    :param service: The absolute name that is called, with ``type_name``.
    :param known: All services, the one that is called included.
    """
    types = dict(known)
    others = [name for name in types.pop(service, []) if name != type_name]
    if others:
        return f'you call {service} as {type_name}, but it is {" and ".join(others)}; use that'
    hint = did_you_mean(service, types)
    return f'there is no service {service}{hint}' if hint else ''
