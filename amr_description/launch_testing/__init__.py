# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``launch_testing`` and ``launch_pytest``: tests that start processes, and run beside them.

Written anew for tests as packages of robots have them. Processes are started by
:class:`~amr_description.launch_api.service.LaunchService`; the tests run on the thread that pytest
or ``launch_test`` has called, so that they may use signals and rclpy as they like.

===================== ===========================================================================
``actions.py``        ReadyToTest, StdoutReadyListener, GTest, PyTest
``markers.py``        parametrize, post_shutdown_test, keep_alive and other decorators
``util.py``           which processes a name means; KeepAliveProc
``text.py``           expected texts, found in what was written
``asserts.py``        assertExitCodes, assertInStdout, assertSequentialStdout
``handlers.py``       proc_info and proc_output
``tools.py``          a process that a test starts itself; waiting for output, start and end
``loading.py``        a file with generate_test_description -> its runs
``runner.py``         a run: processes, the tests beside them, the tests after them
``command.py``        ``launch_test FILE``
``pytest_items.py``   the same files for pytest
``pytest_plugin.py``  launch_pytest: its fixture, and tests marked ``launch``
===================== ===========================================================================
"""

from amr_description.launch_testing import (
    actions,
    actions as event_handlers,
    asserts,
    handlers as io_handler,
    handlers as proc_info_handler,
    markers,
    tools,
    util,
)
from amr_description.launch_testing.handlers import (
    ActiveIoHandler,
    ActiveProcInfoHandler,
    IoHandler,
    ProcInfoHandler,
)
from amr_description.launch_testing.markers import (
    parametrize,
    post_shutdown_test,
    ready_to_test_action_timeout,
    ReadyAggregator,
)

__all__ = [
    'ActiveIoHandler',
    'ActiveProcInfoHandler',
    'IoHandler',
    'ProcInfoHandler',
    'ReadyAggregator',
    'actions',
    'asserts',
    'event_handlers',
    'io_handler',
    'markers',
    'parametrize',
    'post_shutdown_test',
    'proc_info_handler',
    'ready_to_test_action_timeout',
    'tools',
    'util',
]
