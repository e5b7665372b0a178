# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Numbers of command lines: read, as the ``type`` of options of argparse, and written."""

from argparse import ArgumentTypeError
from decimal import Decimal
import math


def finite(word: str) -> float:
    """Read a number. Raises ArgumentTypeError: it is none, or NaN, or infinite."""
    value = _number(word)
    if not math.isfinite(value):
        raise ArgumentTypeError(f"'{word}' is no number")
    return value


def positive(word: str) -> float:
    """Read a finite number above 0. Raises ArgumentTypeError: it is none."""
    value = _number(word)
    if not 0.0 < value < math.inf:
        raise ArgumentTypeError(f"'{word}' is no number above 0")
    return value


def word_of(value: float) -> str:
    """Return a number for a command line; argparse takes -1e-05, as Python has it, for a flag."""
    return format(Decimal(str(value)), 'f')


def _number(word: str) -> float:
    """Return NaN for what is no number."""
    try:
        return float(word)
    except ValueError:
        return math.nan
