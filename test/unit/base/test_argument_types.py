# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Numbers of command lines, read or refused by one line."""

from argparse import ArgumentTypeError

import pytest

from amr_description.argument_types import finite, positive


def test_numbers_are_read():
    assert [finite(word) for word in ('-1', '0', '2e-3')] == [-1.0, 0.0, 0.002]
    assert positive('2e-3') == 0.002


@pytest.mark.parametrize('word', ['', 'far', 'nan', 'inf', '-inf', '1e999'])
def test_what_is_no_finite_number_is_refused(word):
    with pytest.raises(ArgumentTypeError, match=f"^'{word}' is no number$"):
        finite(word)


@pytest.mark.parametrize('word', ['', 'far', 'nan', 'inf', '0', '-0.0', '-2'])
def test_what_is_not_above_0_is_refused(word):
    with pytest.raises(ArgumentTypeError, match=f"^'{word}' is no number above 0$"):
        positive(word)
