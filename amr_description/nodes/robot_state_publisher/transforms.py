# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Transforms of links as ``tf2_msgs/TFMessage``, and as the bytes of one."""

from collections.abc import Iterable, Iterator, Sequence

from geometry_msgs.msg import TransformStamped
from tf2_msgs.msg import TFMessage

from amr_description.cdr.template import Template
from amr_description.clock import NANOSECONDS
from amr_description.nodes.robot_state_publisher.robot_state import LinkTransform
from amr_description.ros.layouts import is_that_of, template_of
from amr_description.ros.messages import fill_stamp

_CHANGING = ('transforms.header.stamp', 'transforms.transform')
_MOST_TEMPLATES = 32  # sets of links; a robot has one for each of its publishers of joint states


class TransformEncoder:
    """
    Makes messages, and faster their bytes.

    The message says what is sent. Its bytes are made anew from a template, one for each set of
    links, which is compared with what rclpy makes of the message; should they differ, messages are
    sent. Four transforms take 8 µs as bytes, and 75 µs as a message.

    Args:
        prefix: of every frame name.
    """

    def __init__(self, prefix: str = '') -> None:
        self._prefix = prefix
        self._templates: dict[tuple[str, ...], Template | None] = {}

    def message(self, links: Iterable[LinkTransform], stamp: int) -> TFMessage:
        """Return the transforms with ``stamp`` (ns)."""
        return TFMessage(transforms=[self._transform(link, stamp) for link in links])

    def encode(self, links: Sequence[LinkTransform], stamp: int) -> bytes | TFMessage:
        """Return what is to be published: :meth:`message`, serialized if that is possible."""
        key = tuple(link.child for link in links)
        if key not in self._templates:
            if len(self._templates) >= _MOST_TEMPLATES:
                self._templates.clear()
            self._templates[key] = self._template(links, stamp)
        template = self._templates[key]
        return self.message(links, stamp) if template is None else _pack(template, links, stamp)

    def _template(self, links: Sequence[LinkTransform], stamp: int) -> Template | None:
        message = self.message(links, stamp)
        template = template_of(message, _CHANGING)
        is_right = is_that_of(message, _pack(template, links, stamp), template)
        return template if is_right else None

    def _transform(self, link: LinkTransform, stamp: int) -> TransformStamped:
        message = TransformStamped()
        message.header.frame_id = self._prefix + link.parent
        message.child_frame_id = self._prefix + link.child
        fill_stamp(stamp, message.header.stamp)
        translation, rotation = message.transform.translation, message.transform.rotation
        translation.x, translation.y, translation.z = link.transform.translation
        rotation.x, rotation.y, rotation.z, rotation.w = link.transform.rotation
        return message


def _pack(template: Template, links: Sequence[LinkTransform], stamp: int) -> bytes:
    return template.pack(*_parts(template, links, stamp))


def _parts(
    template: Template, links: Sequence[LinkTransform], stamp: int
) -> Iterator[bytes | float]:
    seconds, nanoseconds = divmod(stamp, NANOSECONDS)
    constants = iter(template.constants)
    for link in links:
        yield next(constants)
        yield seconds
        yield nanoseconds
        yield next(constants)
        yield from link.transform.translation
        yield from link.transform.rotation
    yield next(constants)
