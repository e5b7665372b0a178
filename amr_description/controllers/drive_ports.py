# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The topics that controllers of wheeled robots share."""

from collections import deque

from amr_description.control.contracts import Controller, Input, Log, Output, Port, Qos, Severity
from amr_description.control.samples import FlagSample, OdometrySample, TwistSample

STAMPED_TWIST = 'geometry_msgs/msg/TwistStamped'
REFERENCE_QOS = Qos(depth=1, reliability='best_effort')
"""Of ``~/reference``."""


EMERGENCY_STOP = 'emergency_stop'
"""Topic of the lock, in the namespace of the robot."""


class EmergencyStop(Input[FlagSample]):
    """
    The lock of a drive: while the latest message on ``emergency_stop`` is true, it stands.

    Such locks are those of ``twist_mux``. The genuine controllers have none. A message counts also
    while the controller is inactive: activating it again does not release the robot.
    """

    def __init__(self, log: Log) -> None:
        super().__init__(
            Port(
                EMERGENCY_STOP,
                'std_msgs/msg/Bool',
                '',
                Qos(depth=1, reliability='reliable'),
                FlagSample,
            ),
            capacity=1,
        )
        self._log = log
        self._is_engaged = False
        self._latest = False
        """Of the ROS thread, which is ahead of the control thread."""
        self._arrived: deque[tuple[bool, bytes]] = deque(maxlen=16)

    @property
    def is_engaged(self) -> bool:
        """Whether the robot is held; on the control thread, which acts on it now."""
        while self._arrived:
            self._is_engaged, message = self._arrived.popleft()
            if self.on_drain is not None and message:
                self.on_drain([message])
        return self._is_engaged

    def put(self, sample: FlagSample, message: bytes = b'') -> bool:
        """Take the state of the lock, whatever the controller's is."""
        was_engaged, self._latest = self._latest, sample.value
        self._arrived.append((sample.value, message))
        if was_engaged != sample.value:
            name = self.port.name
            text = (
                f"'{name}' is true: the robot is held at rest, and commands are not taken, until "
                'it is false'
                if sample.value
                else f"'{name}' is false: commands are taken again"
            )
            self._log(Severity.WARN, text)
        return True


def stamped_twist_input() -> Input[TwistSample]:
    """Return ``~/cmd_vel``."""
    return Input(Port('~/cmd_vel', STAMPED_TWIST, sample=TwistSample))


def reference_input() -> Input[TwistSample]:
    """Return ``~/reference``, of which only the latest message counts."""
    return Input(Port('~/reference', STAMPED_TWIST, '', REFERENCE_QOS, TwistSample), capacity=1)


def odometry_outputs(
    topic: str, tf_topic: str
) -> tuple[Output[OdometrySample], Output[OdometrySample]]:
    """Return the topics of odometry and of its transform."""
    return (
        Output(Port(topic, 'nav_msgs/msg/Odometry', sample=OdometrySample)),
        Output(Port(tf_topic, 'tf2_msgs/msg/TFMessage', sample=OdometrySample)),
    )


def warn_of_one_shot_reference(controller: Controller, timeout: int) -> None:
    """Say what a ``reference_timeout`` (ns) of 0 means; few publishers are as fast as that."""
    if timeout == 0:
        rate = controller.context.update_rate
        controller.log(
            Severity.WARN,
            'reference_timeout is 0: each command counts for one update only '
            f'({1000 / rate:.3g} ms); for publishers slower than {rate} Hz set it, to 0.5 s say',
        )
