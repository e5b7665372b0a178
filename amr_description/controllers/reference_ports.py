# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The topics that the mecanum drive and the steering controllers share."""

from amr_description.control.contracts import Controller, Input, Output, Port, Qos, Severity
from amr_description.control.samples import OdometrySample, TwistSample

REFERENCE_QOS = Qos(depth=1, reliability='best_effort')
"""Of ``~/reference``."""

LEAST_PERIOD = 100_000
"""ns: a shorter period is no basis of odometry."""


def reference_input() -> Input[TwistSample]:
    """Return ``~/reference``, of which only the latest message counts."""
    port = Port('~/reference', 'geometry_msgs/msg/TwistStamped', '', REFERENCE_QOS, TwistSample)
    return Input(port, capacity=1)


def odometry_outputs(tf_topic: str) -> tuple[Output[OdometrySample], Output[OdometrySample]]:
    """Return ``~/odometry``, and the topic of its transform."""
    return (
        Output(Port('~/odometry', 'nav_msgs/msg/Odometry', sample=OdometrySample)),
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
