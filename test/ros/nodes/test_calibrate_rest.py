# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""When calibrate takes the robot to be at rest."""

from nav_msgs.msg import Odometry

from amr_description.clock import NANOSECONDS
from amr_description.nodes.calibrate.drive import CalibrationDrive, DriveTrack, REST
from amr_description.ros.messages import fill_stamp

SECOND = NANOSECONDS


def message(time, speed):
    made = Odometry()
    fill_stamp(time, made.header.stamp)
    made.twist.twist.linear.x = speed
    made.pose.pose.orientation.w = 1.0
    return made


class Drive(CalibrationDrive):
    """Its waits end at once, and leave their conditions."""

    def __init__(self):
        self._truth, self._odometry = DriveTrack(), DriveTrack()
        self.conditions = []

    def _send(self):
        pass

    def _spin_until(self, condition):
        self.conditions.append(condition)


def test_the_truth_of_a_manoeuvre_may_come_long_after_its_odometry():
    drive = Drive()
    drive._truth.add(message(SECOND, 0.0))  # noqa: SLF001 - from before the manoeuvre
    drive._odometry.add(message(5 * SECOND, 0.5))  # noqa: SLF001 - from its end
    drive._wait_for_rest()  # noqa: SLF001
    (is_over,) = drive.conditions
    drive._odometry.add(message(6 * SECOND, 0.0))  # noqa: SLF001
    drive._truth.add(message(2 * SECOND, 0.0))  # noqa: SLF001 - still from before it
    assert not is_over()
    drive._truth.add(message(5 * SECOND + 2 * REST, 0.0))  # noqa: SLF001
    assert is_over()
