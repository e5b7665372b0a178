# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Templates (:mod:`amr_description.cdr.template`) of messages of rclpy, and what it makes."""

from collections.abc import Collection
from typing import Any

from rclpy.serialization import serialize_message

from amr_description.cdr import template
from amr_description.cdr.template import Template
from amr_description.ros.cdr_types import layout_of


def template_of(
    message: Any, changing: Collection[str], *, blocks: Collection[str] = ()
) -> Template:
    """Return the template of a message of rclpy; see that of the same name there."""
    kind: Any = type(message)
    return template.template_of(layout_of(kind), message, changing, blocks=blocks)


def is_that_of(message: Any, data: bytes, made: Template) -> bool:
    """Return whether bytes that a template has made are those that rclpy makes of a message."""
    return made.has_made(data, serialize_message(message))
