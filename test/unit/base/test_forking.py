# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The fork server, without forks."""

import inspect
import os

from amr_description import forking


def test_what_inspect_looks_up_for_the_first_line_of_a_log_is_known_beforehand(monkeypatch):
    files = {}
    monkeypatch.setattr(inspect, 'modulesbyfile', files)
    monkeypatch.setattr(inspect, '_filesbymodname', {})
    forking.note_files_of_modules()
    assert files[os.path.realpath(inspect.__file__)] == 'inspect'
