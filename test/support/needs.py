# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What a test needs that not every machine has: where it lacks, CI fails and others are told."""

import os

import pytest


def need(found, what):
    """
    Skip the test, with the reason in the summary, unless ``found``; fail where nothing may lack.

    :param what: What is missing and what would do: "no chromium; apt install chromium".
    """
    if found:
        return
    if os.environ.get('AMR_SKIP_NOTHING') == '1':
        pytest.fail(what)
    pytest.skip(what)
