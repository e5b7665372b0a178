# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Drive twice, in real time and as fast as possible on a busy machine: are the bits the same.

``python -m amr_description.testing.determinism --seconds 30`` drives the robot of this package
twice, prints the digests of the two logs, and exits with 0 if they are equal byte by byte.
"""

import argparse
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
import hashlib
from pathlib import Path
import subprocess
import sys
import tempfile
import time

from simulation_interfaces.msg import SimulationState
from simulation_interfaces.srv import SetSimulationState
import yaml

from amr_description.ament_index import own_share
from amr_description.testing.simulation import Simulation

_CONTROLLER = 'recorded_drive'
_NOISE = '<noise type="gaussian"><stddev>0.01</stddev><bias_stddev>0.1</bias_stddev></noise>'
_IMU = f"""
    <sensor name="imu">
      <state_interface name="angular_velocity.z"/>
      <state_interface name="linear_acceleration.x"/>
    </sensor>
  </ros2_control>
  <gazebo reference="base_link">
    <sensor name="imu" type="imu">
      <imu>
        <angular_velocity><z>{_NOISE}</z></angular_velocity>
        <linear_acceleration><x>{_NOISE}</x></linear_acceleration>
      </imu>
    </sensor>
  </gazebo>"""
"""A noisy sensor: the first thing that differs, if anything does."""


@dataclass(frozen=True)
class Run:
    """The result of one drive."""

    log: bytes
    """The log of :mod:`amr_description.testing.recorded_drive`."""
    factor: float
    """Simulated over wall time."""

    @property
    def digest(self) -> str:
        """The beginning of the SHA-256 of the log."""
        return hashlib.sha256(self.log).hexdigest()[:16]


def record(seconds: float, rtf: float, *, busy: int = 0) -> Run:
    """
    Drive the course and return its log.

    Args:
        seconds: Of simulated time.
        rtf: Real-time factor; 0: as fast as possible.
        busy: The number of processes that load the machine meanwhile.
    """
    with tempfile.TemporaryDirectory(prefix='amr-determinism-') as name:
        folder = Path(name)
        log = folder / 'drive.log'
        controllers, urdf = _files(folder, log, seconds)
        activate = ['diff_drive_controller', _CONTROLLER]
        with (
            Simulation(urdf, controllers, world='kerbs', rtf=rtf, activate=activate) as sim,
            load(busy),  # from the first tick on: to start is no part of the drive
        ):
            begin = time.monotonic()
            sim.ask(SetSimulationState, state=SimulationState(state=SimulationState.STATE_PLAYING))
            sim.wait(log.exists, 'the end of the drive', timeout=60.0 + 3.0 * seconds)
            taken = time.monotonic() - begin
        return Run(log.read_bytes(), seconds / taken)


@contextmanager
def load(count: int) -> Iterator[None]:
    """Run ``count`` processes that take a core each, while inside, all of it."""
    endless = [sys.executable, '-c', "print('busy', flush=True)\nwhile True: pass"]
    processes = [
        subprocess.Popen(endless, stdout=subprocess.PIPE, start_new_session=True)
        for _ in range(count)
    ]
    try:
        for process in processes:
            assert process.stdout is not None
            process.stdout.readline()  # else a short drive might be over before they run
        yield
    finally:
        for process in processes:
            process.kill()
            process.wait()
            if process.stdout is not None:
                process.stdout.close()


def _files(folder: Path, log: Path, seconds: float) -> tuple[Path, Path]:
    """Write the shipped parameters with the recording controller, and the robot with an IMU."""
    share = own_share()
    urdf = folder / 'amr.urdf'
    text = (share / 'urdf' / 'amr.urdf').read_text(encoding='utf-8')
    urdf.write_text(text.replace('</ros2_control>', _IMU), encoding='utf-8')
    table = yaml.safe_load((share / 'config' / 'controllers.yaml').read_text(encoding='utf-8'))
    kind = f'{__package__}.recorded_drive/RecordedDrive'
    table['/**/controller_manager']['ros__parameters'][_CONTROLLER] = {'type': kind}
    table[_CONTROLLER] = {'ros__parameters': {'log': str(log), 'seconds': float(seconds)}}
    controllers = folder / 'controllers.yaml'
    controllers.write_text(yaml.safe_dump(table), encoding='utf-8')
    return controllers, urdf


def main(args: Sequence[str] | None = None) -> int:
    """Run the two and compare them; return the exit code."""
    options = argparse.ArgumentParser(prog='determinism', description=__doc__.split('\n')[1])
    options.add_argument('--seconds', type=float, default=30.0, help='length of the drive (30)')
    options.add_argument('--busy', type=int, default=1, help='processes beside the second (1)')
    given = options.parse_args(args)
    runs = record(given.seconds, 1.0), record(given.seconds, 0.0, busy=given.busy)
    for run in runs:
        print(f'real-time factor {run.factor:6.2f}  {len(run.log)} bytes  {run.digest}')
    is_equal = runs[0].log == runs[1].log
    print('equal, bit by bit' if is_equal else 'NOT equal')
    return 0 if is_equal else 1


if __name__ == '__main__':
    sys.exit(main())
