# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The topics that controllers of wheeled robots share."""

from amr_description.control.contracts import Controller, Input, Output, Port, Qos, Severity
from amr_description.control.samples import OdometrySample, TwistSample

STAMPED_TWIST = 'geometry_msgs/msg/TwistStamped'
REFERENCE_QOS = Qos(depth=1, reliability='best_effort')
"""Of ``~/reference``."""


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
