# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The page: what many pages and plots cost its node, and what a browser makes of it.

The browser is a Chromium that draws without a GPU, in the world ``warehouse``, 1280 × 760 CSS
pixels. Without one on the machine only the node is measured.
"""

from collections.abc import Callable
from contextlib import ExitStack
from importlib import import_module
from pathlib import Path
import statistics
import sys
import time
from types import ModuleType
from typing import Any

from geometry_msgs.msg import TwistStamped
from rclpy.node import Node

from amr_description.viewer.client import PageClient
from benchmarks.figures import Figures
from benchmarks.stack import bring_up, driving
from benchmarks.viewer import delays, load, viewer, wait

WORLD = 'warehouse'
_SIZE = {'width': 1280, 'height': 760}
_MANY = 20
_FIELDS = {
    '/joint_states': [
        f'{name}[{index}]' for name in ('position', 'velocity') for index in range(4)
    ],
    '/ground_truth/odom': ['pose.pose.position.x', 'pose.pose.position.y'],
}
"""Ten numbers of topics of 100 Hz."""
_DRAWN = 'amr.now.scene && amr.now.scene.triangles > 500'
_HEAP_SECONDS = 60.0
_COMMANDS = '/diff_drive_controller/cmd_vel'


def page_figures(node: Node, seconds: float) -> Figures:
    """
    Bring up a robot and measure.

    Args:
        node: Reads the commands of the pages.
        seconds: Wall time of each measurement.
    """
    with bring_up('simulation', f'world:={WORLD}', 'viewer:=false'), viewer() as (process, url):
        figures = _of_the_node(node, process.pid, url, seconds)
        support = _support()
        if support is None:
            text = 'the page in a browser: there is no Chromium here'
            return Figures(figures.values, f'{figures.text}\n{text}')
        with support.Chromium() as browser:
            seen = _in_a_browser(node, browser, url, seconds)
    return Figures({**figures.values, **seen.values}, f'{figures.text}\n{seen.text}')


def _of_the_node(node: Node, pid: int, url: str, seconds: float) -> Figures:
    with driving(node), ExitStack() as stack:
        pages = [stack.enter_context(PageClient(url)) for _ in range(_MANY)]
        _, many = load(node, pages, pid, seconds)
    with driving(node), PageClient(url) as page:
        plain, plotted = [], []
        for _ in range(3):  # in turn: a busy machine changes both
            page.send('watch', parts=[])
            plain.append(load(node, [page], pid, seconds)[1])
            page.send('watch', parts=[], fields=_FIELDS)
            plotted.append(load(node, [page], pid, seconds)[1])
    with PageClient(url) as page:
        times = delays(node, page)
    late = 1e3 * statistics.quantiles(times, n=20)[-1]
    more = statistics.median(plotted) - statistics.median(plain)
    lines = [
        f'{_MANY} pages{many:43.1f} % of a core',
        f'ten plotted fields of 100 Hz{more:22.1f} % of a core more',
        f'key to command, 95th percentile{late:19.1f} ms',
    ]
    return Figures({'pages': many, 'plot': more, 'key': late}, '\n'.join(lines))


def _in_a_browser(node: Node, browser: Any, url: str, seconds: float) -> Figures:
    page = browser.open(url, pixels=1.0, every_frame=True, **_SIZE)
    look = f'(done) => {_DRAWN} ? done(performance.now()) : setTimeout(look, 5, done)'
    drawn = page.evaluate(f'new Promise(function look(done) {{ ({look})(done); }})') / 1e3
    page.wait_until("document.querySelector('#drive:not(.cannot)')")  # its topic is known
    page.key_down('KeyW')
    page.key_down('KeyA')
    frames, gaps = _held(node, page, seconds)
    heap = _heap_growth(node, page)
    page.let_go()
    page.close()
    lines = [
        f'first drawn robot, cold{drawn:27.2f} s',
        f'frames while it drives{frames:28.1f} /s',
        f'held key, 99th percentile of the gaps{gaps:13.0f} ms',
        f'heap after {_HEAP_SECONDS:g} s of driving{heap:25.2f} MB more',
    ]
    values = {'drawn': drawn, 'frames': frames, 'held': gaps, 'heap': heap}
    return Figures(values, '\n'.join(lines))


def _held(node: Node, page: Any, seconds: float) -> tuple[float, float]:
    """Return frames per second, and the 99th percentile of the gaps between commands, ms."""
    arrived: list[float] = []
    subscription = node.create_subscription(
        TwistStamped, _COMMANDS, lambda _: arrived.append(time.monotonic()), 100
    )
    try:
        wait(node, lambda: len(arrived) > 30)  # noqa: PLR2004 - it is driven
        arrived.clear()
        begin, before = time.monotonic(), page.evaluate('amr.now.scene.frames')
        wait(node, lambda: time.monotonic() >= begin + 2 * seconds, 2 * seconds)
        frames = page.evaluate('amr.now.scene.frames') - before
        elapsed = time.monotonic() - begin
    finally:
        node.destroy_subscription(subscription)
    gaps = [after - at for at, after in zip(arrived, arrived[1:], strict=False)]
    return frames / elapsed, 1e3 * statistics.quantiles(gaps, n=100)[-1]


def _heap_growth(node: Node, page: Any) -> float:
    """Return by how much what the page holds on to has grown, MB; compiled code is left out."""
    wait(node, _after(5.0), 5.0)
    before = page.held_bytes()
    wait(node, _after(_HEAP_SECONDS), _HEAP_SECONDS)
    return float(page.held_bytes() - before) / 1e6


def _after(seconds: float) -> Callable[[], bool]:
    end = time.monotonic() + seconds
    return lambda: time.monotonic() >= end


def _support() -> ModuleType | None:
    """Return the tests' way to ask a browser; None: there is no browser."""
    tests = str(Path(__file__).parents[1] / 'test')
    if tests not in sys.path:
        sys.path.append(tests)
    support = import_module('support.chromium')
    return support if support.executable() else None
