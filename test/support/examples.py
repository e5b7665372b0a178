# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
How many examples Hypothesis tries of a law.

| profile  | a law that says nothing | others                   | numbers             |
| -------- | ----------------------- | ------------------------ | ------------------- |
| `normal` | 50                      | what `examples` is given | always the same     |
| `long`   | 2,000                   | forty times as many      | new ones, each time |
"""

from hypothesis import settings

_FACTOR = settings().max_examples / settings.get_profile('normal').max_examples


def examples(count, **others):
    """
    Return the settings of a law that usually is tried with ``count`` examples.

    The rest is that of the run: usually everywhere the same numbers, with ``--long`` new ones.

    :param others: More of Hypothesis's settings.
    """
    return settings(max_examples=round(_FACTOR * count), **others)
