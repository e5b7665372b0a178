# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""When to colour what a person reads, and how."""

import os
import sys
from typing import TextIO

RED = '\033[91m'
GREEN = '\033[92m'
YELLOW = '\033[93m'
BLUE = '\033[94m'
MAGENTA = '\033[95m'
CYAN = '\033[96m'
_END = '\033[0m'


def colored(text: str, color: str, stream: TextIO | None = None) -> str:
    """
    Return the text in a colour if the stream that it is for, else stdout, is a terminal.

    ``RCUTILS_COLORIZED_OUTPUT`` =1 demands colours, =0 forbids them, as for the log of a node.
    """
    return f'{color}{text}{_END}' if color and _wanted(stream or sys.stdout) else text


def _wanted(stream: TextIO) -> bool:
    forced = os.environ.get('RCUTILS_COLORIZED_OUTPUT')
    return forced == '1' if forced in ('0', '1') else stream.isatty()
