# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``replay``: drives a recorded run of the simulator again, and compares every message.

::

    ros2 run amr_description replay drive            # a bag, or one of its files
    ros2 run amr_description replay drive -o again   # what is published now is kept

The robots of the bag are simulated anew, in lock-step and in a ROS domain of their own; each
command acts at the simulated time at which it did. So all that the simulator publishes is the
same, byte for byte. Meshes, worlds from files and third-party controllers have to be where they
were.

Exit codes: 0: it is the same; 1: it is not, or cannot be run; 2: wrong options.
"""

import argparse
from collections.abc import Sequence
from pathlib import Path
import sys
import tempfile

from amr_description.clock import NANOSECONDS
from amr_description.errors import AmrError, BagError
from amr_description.simulation.recorded_run import (
    delays,
    differences,
    read_run,
    RecordedRun,
    simulation_of,
)
from amr_description.testing.simulation import deserialized, Simulation


def replay(
    bag: Path | RecordedRun, output: Path | None = None, *, rtf: float = 0.0
) -> tuple[list[str], bool]:
    """
    Drive a recorded run again.

    Args:
        bag: A folder, or one of its files; or what was read of it.
        output: A folder to record to; None: what is published now is not kept.
        rtf: Real-time factor; 0: as fast as possible.

    Returns:
        A line for each topic that differs, or was delayed; and whether none differs.

    Raises:
        AmrError: It cannot be run again.
    """
    run = bag if isinstance(bag, RecordedRun) else read_run(bag, deserialized)
    with tempfile.TemporaryDirectory(prefix='amr-replay-') as name:
        folder = Path(name)
        made = output or folder / 'replay'
        with simulation_of(Simulation, run, folder, rtf=rtf, record=made) as sim:
            sim.replay(run)
        again = read_run(made)
    unlike = differences(run, again)
    lines = [
        f'{each.topic}: {each.late} messages were later in real time, {each.left_out} left out'
        for each in delays(run, again)
    ]
    lines += [
        f'{each.topic}: {each.unlike} of {each.total} messages differ, the first at '
        f'{each.time / NANOSECONDS:.9g} s'
        for each in unlike
    ]
    return lines, not unlike


def main(args: Sequence[str] | None = None) -> int:
    """Run the executable; return its exit code."""
    options = argparse.ArgumentParser(
        prog='replay',
        description='Drive a recorded run of the simulator again, and compare every message.',
        allow_abbrev=False,
    )
    options.add_argument('bag', type=Path, help='a bag that mujoco_sim has recorded, or a file')
    options.add_argument('-o', '--output', type=Path, help='record what is published now')
    options.add_argument('--rtf', type=float, default=0.0, help='real-time factor; 0: fastest (0)')
    given = options.parse_args(args)
    try:
        if given.output is not None and given.output.exists():
            raise BagError(f'--output {given.output}: it is there already; another name will do')
        run = read_run(given.bag, deserialized)
        print(f'{given.bag}: {run.seconds:.9g} s, {run.commands} commands', flush=True)
        lines, is_equal = replay(run, given.output, rtf=given.rtf)
    except AmrError as error:
        print(f'replay: {error}', file=sys.stderr)
        return 1
    for line in lines:
        print(line)
    count = sum(map(len, run.messages.values()))
    but = ' but for these' if lines else ''
    print(f'equal, byte for byte{but}: {count} messages' if is_equal else 'NOT equal')
    return 0 if is_equal else 1


if __name__ == '__main__':
    sys.exit(main())
