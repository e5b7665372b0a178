# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What a test needs that not every machine has: where it lacks, CI fails and others are told."""

import importlib.util
import os
from pathlib import Path
import shutil
import sysconfig

import pytest

from amr_description.errors import InterfaceBuildError
from amr_description.interface_build.toolchain import find_toolchain


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


def need_compiler():
    """Message packages of users are compiled; the lines that say so have tests of their own."""
    try:
        find_toolchain()
        reason = ''
    except InterfaceBuildError as error:
        reason = str(error)
    need(not reason, reason)


def need_complete_python():
    """The Python of this machine has all that a set-up by it takes: Debian's alone does not."""
    headers = Path(sysconfig.get_path('include'), 'Python.h')
    need(
        importlib.util.find_spec('ensurepip') and headers.exists(),
        'Python here has no pip or no Python.h; apt install python3-venv python3-dev',
    )


def need_program(name, package):
    need(shutil.which(name), f'no {name}; apt install {package}')
