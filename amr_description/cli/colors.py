# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""When to colour what a person reads, and how."""

import os
import sys

GREEN = '\033[92m'
CYAN = '\033[96m'
YELLOW = '\033[93m'
_END = '\033[0m'


def colored(text: str, color: str) -> str:
    """
    Return the text in a colour if stdout is a terminal.

    ``RCUTILS_COLORIZED_OUTPUT`` =1 demands colours, =0 forbids them, as for the log of a node.
    """
    return f'{color}{text}{_END}' if color and _wanted() else text


def _wanted() -> bool:
    forced = os.environ.get('RCUTILS_COLORIZED_OUTPUT')
    return forced == '1' if forced in ('0', '1') else sys.stdout.isatty()
