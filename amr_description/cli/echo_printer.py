# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The output of ``ros2 topic echo`` for each message."""

from argparse import Namespace
from collections.abc import Mapping
from functools import reduce
import sys
from typing import Any

from rclpy.event_handler import QoSMessageLostInfo

from amr_description.cli.message_filter import make_filter
from amr_description.errors import AmrError
from amr_description.ros.message_text import dump_yaml, Style, to_csv, to_yaml


class EchoPrinter:
    """Selects, formats and prints messages."""

    def __init__(self, args: Namespace, message_class: Any) -> None:
        """Raise AmrError if the class has no such field as ``args.field``."""
        self.count = 0
        """How many messages were printed."""
        self._failure: Exception | None = None
        self._once = args.once
        self._field = args.field.split('.') if args.field else []
        if not args.raw:
            self._select(message_class())
        self._filter = make_filter(args.filter_expr)
        self._with_info = args.include_message_info
        self._csv = args.csv
        self._style = style_of(args)

    def receive(self, message: Any) -> None:
        """
        Print a message, or the bytes of one, if it passes the filter; until that fails.

        Why it fails is for :meth:`has_printed`: EventsExecutor logs what a callback raises. It
        also hands over all that have come before anybody can end it: ``--once`` is kept here.
        """
        if self._failure is None and not (self._once and self.count):
            try:
                self.receive_with_info(message, {})
            except Exception as error:
                self._failure = error

    def has_printed(self) -> bool:
        """Return whether a message was printed. Raises why it could not be."""
        if self._failure is not None:
            raise self._failure
        return self.count > 0

    def receive_with_info(self, message: Any, info: Mapping[str, Any]) -> None:
        """Print a message, or the bytes of one, if it passes the filter."""
        if not isinstance(message, bytes):
            message = self._select(message)
        if not self._filter(message):
            return
        self.count += 1
        if self._with_info:
            print(f'{dump_yaml(dict(info), sort_keys=True)}---')
        self._print(message)

    def report_lost(self, lost: QoSMessageLostInfo) -> None:
        """
        Say that the queue ran over: on stderr, as stdout holds YAML that others read.

        What was lost before the first message is that publisher's past, which it kept too short.
        """
        if self.count:
            print(
                'A message was lost!!!\n'
                f'\ttotal count change:{lost.total_count_change}\n'
                f'\ttotal count: {lost.total_count}',
                file=sys.stderr,
            )

    def _print(self, value: Any) -> None:
        if not hasattr(value, 'get_fields_and_field_types'):
            print(value, end='\n---\n')
        elif self._csv:
            print(to_csv(value, self._style))
        else:
            print(f'{to_yaml(value, self._style)}---')

    def _select(self, message: Any) -> Any:
        try:
            return reduce(getattr, self._field, message)
        except AttributeError as error:
            raise AmrError(f"Invalid field '{'.'.join(self._field)}': {error}") from error


def style_of(args: Namespace) -> Style:
    """Return what the arguments say of how messages are printed."""
    return Style(
        truncate_length=None if args.full_length else args.truncate_length,
        arrays=not args.no_arr,
        strings=not args.no_str,
        flow_style=args.flow_style,
    )
