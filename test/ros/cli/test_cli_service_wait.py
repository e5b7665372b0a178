# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What ``ros2 service call`` says while it waits for a service that is discovered late."""

from types import SimpleNamespace

import pytest

from amr_description.cli import service as call

WHY = 'you call /set_it as another type'


class Session:
    """A session in which no service comes; it is interrupted after some waits."""

    node = None

    def __init__(self, waits):
        self.waits, self.waited = waits, []

    def spin(self, until, timeout):
        self.waited.append(timeout)
        if len(self.waited) == self.waits:
            raise KeyboardInterrupt
        return until()


def test_the_reason_is_looked_for_until_it_is_known(monkeypatch, capsys):
    known = iter(['', '', WHY])
    monkeypatch.setattr(call, '_explain_absence', lambda *_: next(known))
    client = SimpleNamespace(service_is_ready=bool, srv_name='/set_it', srv_type=None)
    session = Session(waits=4)
    monkeypatch.setattr('amr_description.ros.service_calls._is_offered', lambda *_: False)
    with pytest.raises(KeyboardInterrupt):
        call._wait_for_service(session, client, None)
    assert session.waited == [2.0, 2.0, 2.0, float('inf')]
    assert capsys.readouterr().err == f'WARNING: {WHY}\n'
