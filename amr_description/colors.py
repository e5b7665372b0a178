# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Colours for terminals, and when to use them."""

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
    Return text in a colour, if its stream is a terminal.

    ``RCUTILS_COLORIZED_OUTPUT`` =1 forces colours, =0 disables them, as for the log of a node.

    Args:
        text: to be printed.
        color: one of the constants of this module; '' for none.
        stream: where it is printed; None: stdout.
    """
    return f'{color}{text}{_END}' if color and _wanted(stream or sys.stdout) else text


def _wanted(stream: TextIO) -> bool:
    forced = os.environ.get('RCUTILS_COLORIZED_OUTPUT')
    return forced == '1' if forced in ('0', '1') else stream.isatty()
