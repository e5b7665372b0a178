# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What is sent to a controller without ROS: a sample, or a dict in the form of the message."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from amr_description.clock import NANOSECONDS
from amr_description.control.contracts import Port
from amr_description.messages.plain import has_stamp, message_of


def sample_of(port: Port, message: Any, time: int) -> Any:
    """
    Return the sample of what was sent to an input; one without a stamp gets the time.

    Args:
        port: Of the input.
        message: A sample already, or a mapping in the form of the message.
        time: Present time, ns.

    Raises:
        AmrError: A value does not fit, or there is no converter.
    """
    if not isinstance(message, Mapping):
        is_without = has_stamp(port.message) and getattr(message, 'stamp', None) == 0
        return replace(message, stamp=time) if is_without else message
    from amr_description.messages.readers import reader_of  # with the samples of all controllers

    made = message_of(port.message, message)
    stamp = getattr(getattr(made, 'header', None), 'stamp', None)
    if stamp is not None and stamp.sec == stamp.nanosec == 0:
        stamp.sec, stamp.nanosec = divmod(time, NANOSECONDS)
    return reader_of(port)(made)
