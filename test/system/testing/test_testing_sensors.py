# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What a test reads of sensors: the present instant, the same bits every time, nothing unasked."""

import numpy as np
import pytest
from sensor_msgs.msg import LaserScan
from support.paths import ROOT

from amr_description.model.description_file import description_at
from amr_description.model.frames import Transform

URDF = ROOT / 'urdf' / 'amr_sensors.urdf.xacro'
SPREAD = 0.03
"""m: six times the deviation of the lidar's noise."""
BUMPER = """
  <gazebo reference="base_link">
    <sensor name="bumper" type="contact">
      <topic>bumper</topic><contact><collision>base_link_collision</collision></contact>
    </sensor>
  </gazebo>
</robot>
"""

pytest_plugins = ['amr_description.testing.fixtures']


@pytest.fixture
def sim(simulation):
    return simulation(URDF, world='walls')


@pytest.fixture
def fleet(simulation):
    """Two robots with bumpers."""
    text = description_at(str(URDF), warn=pytest.fail)
    poses = {'robot1': Transform(), 'robot2': Transform((1.0, 0.0, 0.0))}
    return simulation(text.replace('</robot>', BUMPER), world='walls', robots=poses)


def test_what_is_measured_when_it_is_due_is_what_is_read(sim):
    """The noise follows from the instant, not from who asked."""
    heard = []
    subscription = sim.node.create_subscription(LaserScan, '/scan', heard.append, 10)
    try:
        sim.wait(lambda: sim.scan and heard, 'a scan')
        sim.reset()
        sim.run(0.1)
        read = sim.scan
        heard.clear()
        sim.run(0.01)  # the tick at the end of a step belongs to the next one
        sim.wait(lambda: heard, 'the scan that is due')
        assert np.asarray(heard[0].ranges, np.float32).tobytes() == read.ranges.tobytes()
    finally:
        sim.node.destroy_subscription(subscription)
