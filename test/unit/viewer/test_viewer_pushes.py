# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The pushes of pages: who lets go when."""

import pytest

from amr_description.errors import ViewerError
from amr_description.viewer.pushes import NO_VECTOR, PUSH_TIMEOUT, Pushes
from amr_description.viewer.requests import Push

FORCE = (5.0, 0.0, 0.0)


def push(force=FORCE, link='base_link'):
    return Push('/sim', 'amr', link, force, NO_VECTOR)


@pytest.fixture
def applied():
    return []


@pytest.fixture
def pushes(applied):
    return Pushes(applied.append)


def test_a_push_is_applied_and_its_end_too(pushes, applied):
    pushes.push('page 1', push(), 0.0)
    pushes.push('page 1', push(NO_VECTOR), 0.1)
    assert applied == [push(), push(NO_VECTOR)]
    assert pushes.next_expiry() is None


def test_a_silent_page_lets_go(pushes, applied):
    pushes.push('page 1', push(), 0.0)
    pushes.push('page 1', push(), 0.2)
    assert pushes.next_expiry() == pytest.approx(0.2 + PUSH_TIMEOUT)
    pushes.expire(0.2 + 0.9 * PUSH_TIMEOUT)
    assert len(applied) == 2
    pushes.expire(0.2 + PUSH_TIMEOUT)
    assert applied[2:] == [push(NO_VECTOR)]


def test_a_page_that_has_gone_lets_go_of_what_it_pushed_and_of_nothing_else(pushes, applied):
    pushes.push('page 1', push(), 0.0)
    pushes.push('page 2', push(link='arm'), 0.0)
    pushes.forget('page 1')
    assert applied[2:] == [push(NO_VECTOR)]
    assert pushes.next_expiry() == pytest.approx(PUSH_TIMEOUT)


def test_the_page_that_pushed_last_is_the_one(pushes, applied):
    pushes.push('page 1', push(), 0.0)
    pushes.push('page 2', push(), 0.1)
    pushes.forget('page 1')
    assert len(applied) == 2
    pushes.forget('page 2')
    assert applied[2:] == [push(NO_VECTOR)]


def test_to_let_go_of_what_nobody_holds_is_nothing(pushes, applied):
    pushes.push('page 1', push(NO_VECTOR), 0.0)
    assert applied == []


def test_a_push_that_is_refused_is_not_held_and_a_simulator_may_go(applied):
    def refuse(message):
        raise ViewerError('there is no simulator')

    pushes = Pushes(refuse)
    with pytest.raises(ViewerError):
        pushes.push('page 1', push(), 0.0)
    assert pushes.next_expiry() is None
    gone = Pushes(lambda message: applied.append(message) if any(message.force) else refuse(0))
    gone.push('page 1', push(), 0.0)
    gone.expire(10.0)
    assert gone.next_expiry() is None
