# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Encoders (:mod:`amr_description.messages.encoders`) of messages of rclpy."""

from collections.abc import Callable
from typing import Any

from amr_description.cdr.layouts import FieldGroup
from amr_description.cdr.template import Template
from amr_description.messages import encoders
from amr_description.messages.encoders import Encoder
from amr_description.ros.layouts import is_that_of, layout_of


class RosForm:
    """The messages of a class of rclpy."""

    def __init__(self, message_class: Any) -> None:
        """Take a class."""
        self._message_class = message_class

    @property
    def layout(self) -> FieldGroup:
        """How they are laid out."""
        return layout_of(self._message_class)

    def new(self) -> Any:
        """Return a message of defaults."""
        return self._message_class()

    def is_right(self, template: Template, data: bytes, message: Any) -> bool:
        """Return whether rclpy makes the same bytes of a message."""
        return is_that_of(message, data, template)


def encoder_of(
    sample: type | None, message: str, fill: Callable[[Any, Any], None], message_class: Any
) -> Encoder:
    """Return an encoder of messages of a class; see that of the same name there."""
    return encoders.encoder_of(sample, message, fill, RosForm(message_class))
