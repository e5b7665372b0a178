"""The rover in simulation, with all of its controllers: ``ros2 launch rover rover_sim.py``."""

from amr_description.bringup import include, Node, ready, Stack


def rover_sim(world: str = 'empty', rtf: float = 1.0) -> Stack:
    """The stack ``simulation`` with this robot, and its third controller."""
    robot = include(
        'simulation',
        urdf='package://rover/urdf/rover.urdf.xacro',
        controllers='package://rover/config/rover.yaml',
        world=world,
        rtf=rtf,
    )
    imu = Node('spawner', arguments=['imu_sensor_broadcaster'], start_when=ready(robot))
    return Stack([robot, imu])
