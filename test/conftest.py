# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Give each test process a ROS of its own: a free domain, this host only, its own log folder.

So several can run side by side: of several checkouts, or of one (``scripts/test``).
"""

import os
from pathlib import Path
import signal
import sys
import tempfile

from hypothesis import settings
import pytest

from amr_description.testing.program import take_domain

ROOT = Path(__file__).resolve().parents[1]
# The parts of these are tested too, and benchmarks/ is imported from the checkout.
sys.path[:0] = [str(ROOT / 'scripts'), str(ROOT / 'interfaces'), str(ROOT)]

KEPT = {}  # what has to last as long as the run

# Where files run side by side, these start first, longest first: none is left alone at the end.
# It is about time only; a file that is not named here starts later.
LONGEST = (
    'test_page_in_browser', 'test_fleet',
    'test_cli_golden', 'test_docs_machines', 'test_cli_param', 'test_mujoco_sim',
    'test_cli_control_state', 'test_cli_lifecycle', 'test_cli_completion', 'test_tutorial',
    'test_cli_action', 'test_stack', 'test_viewer', 'test_viewer_server',
    'test_viewer_simulation',
    'test_spawner', 'test_cli_service', 'test_cli_topic_rate', 'test_cli_topic', 'test_teleop',
    'test_bringup_stop', 'test_bringup_faults', 'test_hardware_spawner', 'test_bringup_start',
    'test_cli_run',
)  # fmt: skip

settings.load_profile('ci')  # everywhere the same numbers, and no deadline on a busy machine


def pytest_configure(config):
    # A background job starts with Ctrl-C ignored, which every child would inherit.
    if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    if has_workers(config):
        return  # it starts no test; each worker finds the shell's domain forbidden, and takes one
    domain, KEPT['lock'] = take_domain()
    KEPT['logs'] = tempfile.TemporaryDirectory(prefix='amr-test-logs-')
    prefixes = [str(ROOT / 'install' / 'amr_description'), sys.prefix]
    known = os.environ.get('AMENT_PREFIX_PATH', '').split(os.pathsep)
    os.environ |= {
        'ROS_DOMAIN_ID': str(domain),
        'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST',
        'ROS_LOG_DIR': KEPT['logs'].name,
        'AMENT_PREFIX_PATH': os.pathsep.join(
            dict.fromkeys(prefix for prefix in (*prefixes, *known) if prefix)
        ),
    }


def has_workers(config):
    """Whether this process only hands tests out to others, those of pytest-xdist (``-n``)."""
    return bool(config.getoption('numprocesses', None))


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_auto_num_workers():
    """
    How many processes ``-n auto`` is: one more than cores, as they often wait for others; with
    two for each core the programs under test do not answer in time.
    """
    return len(os.sched_getaffinity(0)) + 1


def pytest_collection_modifyitems(config, items):
    if hasattr(config, 'workerinput'):  # one of several processes
        rank = {name: place for place, name in enumerate(LONGEST)}
        items.sort(key=lambda item: rank.get(item.path.stem, len(rank)))


def pytest_report_header(config):
    domain = 'of each worker' if has_workers(config) else os.environ['ROS_DOMAIN_ID']
    return f'ROS_DOMAIN_ID={domain}, LOCALHOST'


def pytest_unconfigure(config):
    if not has_workers(config):
        KEPT['logs'].cleanup()
        os.close(KEPT['lock'])
