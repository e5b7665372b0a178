"""The rover in simulation: ``ros2 launch rover rover_sim.py``."""

from amr_description.bringup import include, Stack


def rover_sim(world: str = 'empty', rtf: float = 1.0) -> Stack:
    """The stack ``simulation`` with this robot."""
    return include(
        'simulation',
        urdf='package://rover/urdf/rover.urdf.xacro',
        controllers='package://rover/config/rover.yaml',
        world=world,
        rtf=rtf,
    )
