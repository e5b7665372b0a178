# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A motor board on a pseudo-terminal, and the component that is connected to it."""

import pytest
from support.motor_boards import BoardOnPty
from support.serial_rig import Rig, threads


@pytest.fixture
def plugged():
    with BoardOnPty() as plugged:
        yield plugged


@pytest.fixture
def board(plugged):
    return plugged.board


@pytest.fixture
def rig(plugged):
    """Connected and active."""
    rig = Rig(plugged.port)
    rig.start()
    yield rig
    rig.system.cleanup()
    assert threads() == []
