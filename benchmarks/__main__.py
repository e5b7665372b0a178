# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Measure the stack, part by part, and compare the figures with their goals.

See benchmarks/README.md for what each row means.
"""

import argparse
from collections.abc import Callable, Iterable
import os
import subprocess
import sys
import time

from rclpy.node import Node

from amr_description.ament_index import package_share
from amr_description.errors import AmrError
from amr_description.ros.runtime import program, ros
from benchmarks import machine
from benchmarks.cycle import driven_robot, HEARD, listeners, Simulator
from benchmarks.figures import Figures
from benchmarks.goals import GOALS, missed, report
from benchmarks.options import chosen_parts, parser, why_left_out
from benchmarks.profiles import Profile, profile_text, Speed
from benchmarks.stack import bring_up
from benchmarks.startup import phases_of, start_figures, table

_WARM_STARTS = 3
_LATENCY_SECONDS = 5.0


class Bench:
    """One run of the benchmarks: its figures so far."""

    def __init__(self, node: Node, *, seconds: float, quick: bool) -> None:
        """
        Begin without figures.

        Args:
            node: Of this program.
            seconds: Wall time of each measurement.
            quick: Leave out what has no goal.
        """
        self.values: dict[str, float] = {}
        self.left_out: dict[str, str] = {}
        """Why a figure is not measured, by key."""
        self.bare: list[float] = []
        """Real-time factors of ``mj_step`` alone, in the order in which they were measured."""
        self._node = node
        self._seconds = seconds
        self._is_quick = quick

    def run(self, parts: Iterable[str]) -> None:
        """Run parts; print what they have to say beside the figures of the table."""
        for part in parts:
            print(f'{part} ...', file=sys.stderr, flush=True)
            self.measure(getattr(self, part), f'{part}: ', _keys(part))

    def measure(self, call: Callable[[], Figures], what: str, keys: Iterable[str]) -> None:
        """Take the figures of a part; one that fails is not measured, and the others are."""
        try:
            figures = call()
        except (AmrError, OSError, subprocess.SubprocessError) as error:
            reason = str(error).split('\n', 1)[0]
            print(f'{what}{reason}', file=sys.stderr, flush=True)
            self.left_out.update(dict.fromkeys(keys, reason))
            return
        self.values.update(figures.values)
        if figures.text:
            print(f'{figures.text}\n', flush=True)

    # --- the parts ----------------------------------------------------------------------------

    def speed(self) -> Figures:
        """As fast as possible: first ``/clock`` alone is heard, then the whole stack listens."""
        with driven_robot(self._node) as simulator:
            self.measure(lambda: self._clock(simulator), 'speed: ', ('clock',))
            self.measure(lambda: self._heard(simulator), 'speed: ', ('stack', 'beside'))
        return Figures({})

    def _clock(self, simulator: Simulator) -> Figures:
        with listeners(self._node, 'clock'):
            speed = simulator.speed(self._seconds)
            profile = simulator.profile(self._seconds / 2)
        return Figures({'clock': speed.ratio}, self._speed_text('/clock', speed, profile))

    def _heard(self, simulator: Simulator) -> Figures:
        with listeners(self._node, 'stack'):
            speed = simulator.speed(self._seconds)
            profile = simulator.profile(self._seconds / 2)
        values = {'stack': speed.ratio, 'beside': profile.besides}
        heard = 'robot_state_publisher and a page'
        return Figures(values, self._speed_text(heard, speed, profile))

    def engine(self) -> Figures:
        """The simulation without ROS, in a process of its own."""
        from benchmarks.engine import engine_figures

        return engine_figures(self._seconds)

    def latency(self) -> Figures:
        """Commands to the wheels, and cycles of 1 kHz, in real time."""
        from benchmarks.latency import latency_figures

        seconds = min(self._seconds, 3.0) if self._is_quick else max(self._seconds, 10.0)
        return Figures(latency_figures(self._node, seconds))

    def stack(self) -> Figures:
        """Warm starts; and what a stack in real time takes."""
        from benchmarks.command_line import command_figures
        from benchmarks.load import load_figures
        from benchmarks.viewer import viewer_figures

        node, seconds, quick = self._node, self._seconds, self._is_quick
        starts = []
        if not quick:
            for _ in range(_WARM_STARTS - 1):
                with bring_up('simulation') as run:
                    starts.append(phases_of(run.lines))
        with bring_up('simulation') as run:
            starts.append(phases_of(run.lines))
            self.measure(lambda: start_figures(starts), 'start: ', ('warm',))
            self.measure(lambda: load_figures(node, run, seconds), 'load: ', ('load',))
            self.measure(
                lambda: command_figures(node, seconds, quick=quick),
                'ros2: ',
                ('list', 'hz', 'doctor'),
            )
            self.measure(
                lambda: viewer_figures(node, seconds, quick=quick), 'the page: ', ('page',)
            )
        return Figures({})

    def page(self) -> Figures:
        """The page: many of them, plots, and what a browser makes of it."""
        from benchmarks.page import page_figures

        return page_figures(self._node, self._seconds)

    def robot_state_publisher(self) -> Figures:
        """robot_state_publisher alone."""
        from benchmarks.robot_state_publisher import transform_figures

        return transform_figures(self._node, self._seconds, quick=self._is_quick)

    def fleet(self) -> Figures:
        """Many robots in one simulator."""
        from benchmarks.fleet import fleet_figures

        urdf = (package_share('amr_description') / 'urdf' / 'amr.urdf').read_text('utf-8')
        return fleet_figures(self._node, urdf, self._seconds / 2)

    def fleet_start(self) -> Figures:
        """Ten robots, from the command to driving."""
        from benchmarks.load import fleet_start_figures

        return fleet_start_figures(self._node)

    def sensors(self) -> Figures:
        """Lidars and cameras: what they take, heard and not."""
        from benchmarks.sensors import sensor_figures

        return sensor_figures(self._node, self._seconds)

    def recording(self) -> Figures:
        """A recorder of many small messages, and of large ones."""
        from benchmarks.recording import recording_figures

        return recording_figures(self._node, self._seconds)

    def playing(self) -> Figures:
        """A player that plays ten times faster than recorded."""
        from benchmarks.playing import playing_figures

        return playing_figures(self._node, self._seconds)

    def memory(self) -> Figures:
        """An hour of simulated time."""
        from benchmarks.load import memory_figures

        return memory_figures(self._node)

    def cold(self) -> Figures:
        """A new clone, from set-up to ready."""
        from benchmarks.load import cold_figures

        return cold_figures()

    def profile(self) -> Figures:
        """A cycle by part, with nobody and with the stack listening; the start by phase."""
        texts = []
        with driven_robot(self._node) as simulator:
            for heard in reversed(HEARD):
                with listeners(self._node, heard):
                    texts.append(profile_text(heard, simulator.profile(2 * self._seconds)))
        with bring_up('simulation') as run:
            texts.append(table(phases_of(run.lines)))
        return Figures({}, '\n\n'.join(texts))

    def _speed_text(self, heard: str, speed: Speed, profile: Profile) -> str:
        self.bare += speed.bare
        numbers = '  '.join(f'{each:.1f}' for each in speed.full)
        bare = '  '.join(f'{each:.1f}' for each in speed.bare)
        return (
            f'real-time factor at factor 0, driven; heard by {heard}\n'
            f'full stack           {numbers}\nmj_step alone        {bare}\n'
            f'a cycle: {profile.cycle:.0f} µs of processor time, mj_step alone '
            f'{profile.bare:.0f} µs: {profile.bare / profile.cycle:.3f}'
        )


def _keys(part: str) -> list[str]:
    return [goal.key for goal in GOALS if goal.part == part]


def benchmark(options: argparse.Namespace) -> int:
    """Measure and print; return the exit code."""
    os.environ['ROS_DOMAIN_ID'] = str(options.domain_id)
    os.environ['ROS_AUTOMATIC_DISCOVERY_RANGE'] = 'LOCALHOST'
    with ros([]):
        node = Node('benchmark')
        try:
            return measured(options, node)
        finally:
            node.destroy_node()


def measured(options: argparse.Namespace, node: Node) -> int:
    """Run the parts, print their figures, and return the exit code."""
    parts, begin = chosen_parts(options), time.monotonic()
    before, start = machine.usage_before(), machine.usage()
    seconds = options.seconds or (3.0 if options.quick else 5.0)
    bench = Bench(node, seconds=seconds, quick=options.quick)
    bench.left_out = why_left_out(parts, quick=options.quick)
    bench.run(parts)
    during = machine.usage().since(start)
    ends = (bench.bare[0], bench.bare[-1]) if bench.bare else None
    complaints = machine.complaints(before, during, ends)
    if not options.profile:
        print(report(bench.values, bench.left_out, is_quiet=not complaints))
    for line in complaints:
        print(f'the machine was not quiet: {line}')
    print(f'measured in {time.monotonic() - begin:.0f} s', file=sys.stderr)
    if not options.check:
        return 0
    lines = missed(bench.values, bench.left_out, parts=parts if options.only else None)
    for line in lines:
        print(line, file=sys.stderr)
    return 1 if lines else 0


def main(args: list[str] | None = None) -> int:
    """Run the benchmarks; return the exit code."""
    return program(lambda: benchmark(parser().parse_args(args)))


if __name__ == '__main__':
    sys.exit(main())
