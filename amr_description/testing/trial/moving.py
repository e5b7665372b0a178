# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Joints, moved a little way by a trajectory, by position or velocity commands, or by the action of a
gripper, and read again.

What is asked of a joint: 0.3 rad or 5 cm, a fifth of its range at most, to the side with more
room.
"""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
import math
from typing import Any

from builtin_interfaces.msg import Duration
from control_msgs.action import GripperCommand, ParallelGripperCommand
from rclpy.action import ActionClient, get_action_names_and_types
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64, Float64MultiArray
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

from amr_description.errors import AmrError, SimulationError
from amr_description.model.robot import Joint, JointType
from amr_description.ros.service_calls import ActionReadiness
from amr_description.simulation.readings import Joint as State
from amr_description.testing.lock_step import LatestMessage
from amr_description.testing.readings import joints_of
from amr_description.testing.simulation import Simulation
from amr_description.testing.trial.bring_up import Active, topics_of
from amr_description.testing.trial.findings import MotionResult

_ANGLE, _LENGTH = 0.3, 0.05
"""rad and m."""
_SHARE = 0.2
"""Of the range of a joint."""
_OF_LEGS = 0.2
"""As a share of how far others are moved: two legs that bend as far as an arm fall."""
_MIDDLE = 0.01
"""Of the range of a joint; as far from its middle it has as much room to both sides."""
_SECONDS, _SETTLING = 2.0, 1.5
"""s: a trajectory's duration, and the time after it."""
_START, _LONGEST_START, _STEADY = 0.5, 15.0, 0.02
"""
s between two looks at speeds, s until they are judged, and what is steady: that share of the
command, or of what still lacks of it.
"""
_TOLERANCE = 0.1
"""Of what is asked of a joint."""
_BROADCASTER = 'JointStateBroadcaster'
_TRAJECTORIES = 'JointTrajectoryController'
_GROUPS = ('ForwardCommandController', 'JointGroup')
_GRIPPERS = 'GripperActionController'
_ONE_NUMBER = 'GazeboJointCommand'
_MOVED = (_TRAJECTORIES, _GRIPPERS, _ONE_NUMBER, *_GROUPS)
_ACTIONS: dict[str, Any] = {
    'control_msgs/action/GripperCommand': GripperCommand,
    'control_msgs/action/ParallelGripperCommand': ParallelGripperCommand,
}


def is_moved(controller: Active) -> bool:
    """Return whether a controller is one that is tried here."""
    return any(word in controller.type for word in _MOVED)


def offset_of(joint: Joint | None, position: float, *, on_legs: bool = False) -> float:
    """
    Return how far a joint is to move from a position, with its sign: rad or m.

    ``on_legs``: whether what is in the middle of its range but for a hair goes the same way as all
    others; legs that go apart push against the ground.
    """
    if joint is None:
        return _ANGLE
    far = _LENGTH if joint.type is JointType.PRISMATIC else _ANGLE
    if joint.limit is None or joint.type is JointType.CONTINUOUS:
        return far
    above, below = joint.limit.upper - position, position - joint.limit.lower
    far = min(far, _SHARE * (joint.limit.upper - joint.limit.lower))
    hair = _MIDDLE * (above + below) if on_legs else 0.0
    return far if above >= below - hair else -far


class JointStates:
    """The joint states of the active joint_state_broadcaster."""

    def __init__(self, sim: Simulation, active: Sequence[Active]) -> None:
        """Subscribe. Raises LookupError: there is no broadcaster."""
        names = [each for each in active if each.type.endswith(_BROADCASTER)]
        if not names:
            raise LookupError('no joint_state_broadcaster is active that tells of joints')
        self._sim, self._inside = sim, names[0].namespace
        topic = f'{self._inside.rstrip("/")}/joint_states'
        self._latest = LatestMessage(sim.node, JointState, topic)

    def read(self) -> Mapping[str, State]:
        """Return the states. Raises SimulationError: none come."""

        def newest() -> JointState | None:
            self._sim.step(10)
            return self._latest.take()

        return joints_of(self._sim.wait(newest, 'joint states', 5.0))

    def close(self) -> None:
        """Stop listening."""
        self._latest.close()


class Mover:
    """Moves the joints of one controller."""

    def __init__(
        self,
        sim: Simulation,
        controller: Active,
        joints: Mapping[str, Joint],
        states: JointStates,
        *,
        on_legs: bool = False,
        held: Collection[str] = (),
    ) -> None:
        """``on_legs``: whether the robot stands on legs; ``held``: joints that are not moved."""
        self._on_legs = on_legs
        self._held = frozenset(held)
        self._sim = sim
        self._controller = controller
        self._joints = joints
        self._states = states
        # Of a reference of another controller, too: arm/joint1/position.
        pairs = [each.split('/')[-2:] for each in controller.claimed]
        self._names = list(dict.fromkeys(joint for joint, _ in pairs))
        self._interfaces = {interface for _, interface in pairs}

    def move(self) -> MotionResult:
        """Move all joints of the controller at once; the worst of them is told."""
        what = 'trajectory' if _TRAJECTORIES in self._controller.type else 'command'
        try:
            if what == 'trajectory':
                return self._by_trajectory()
            if _GRIPPERS in self._controller.type:
                return self._by_action()
            if self._interfaces == {'position'}:
                return self._by_position()
            if self._interfaces == {'velocity'}:
                return self._by_velocity()
        except (AmrError, KeyError) as error:
            return MotionResult(self._controller.name, what, 0.0, None, None, False, str(error))
        kinds = ', '.join(sorted(self._interfaces)) or 'no'
        note = f'{kinds} commands are not tried'
        return MotionResult(self._controller.name, what, 0.0, None, None, True, note)

    @property
    def _takes_one_number(self) -> bool:
        return self._controller.type.endswith(_ONE_NUMBER)

    def _command(self, values: Sequence[float]) -> None:
        """Send a command for each joint, or one for all."""
        if self._takes_one_number:
            self._send('std_msgs/msg/Float64', Float64(data=values[0]))
        else:
            self._send('std_msgs/msg/Float64MultiArray', Float64MultiArray(data=list(values)))

    def _send(self, kind: str, message: Any) -> None:
        """Send on the controller's topic of a type, which a plugin may name as it likes."""
        subscribed = self._sim.node.get_subscriber_names_and_types_by_node
        topics = topics_of(self._sim, subscribed, self._controller, (kind,))
        if not topics:
            raise SimulationError(f'{self._controller.name} subscribes to no {kind}')
        self._sim.send(topics[0][0], message)

    def _targets(self) -> dict[str, tuple[float, float]]:
        """Return (start, target) of each joint."""
        states = self._states.read()
        starts = {name: states[name].position for name in self._names}
        return {
            name: (start, start + self._share_of(name) * offset)
            for name, start in starts.items()
            for offset in [offset_of(self._joints.get(name), start, on_legs=self._on_legs)]
        }

    def _share_of(self, name: str) -> float:
        """Return the share of a joint, of which all that are asked of are not held."""
        is_held = name in self._held and not self._held.issuperset(self._names)
        return 0.0 if is_held else _OF_LEGS if self._on_legs else 1.0

    def _by_trajectory(self) -> MotionResult:
        targets = self._targets()
        point = JointTrajectoryPoint(
            positions=[target for _, target in targets.values()],
            time_from_start=Duration(sec=int(_SECONDS)),
        )
        message = JointTrajectory(joint_names=list(targets), points=[point])
        self._send('trajectory_msgs/msg/JointTrajectory', message)
        return self._judge('trajectory', targets)

    def _by_position(self) -> MotionResult:
        targets = self._targets()
        if self._takes_one_number:  # the same for all joints, some of which it may be too far for
            first = next(iter(targets.values()))
            targets = {name: (start, first[1]) for name, (start, _) in targets.items()}
        self._command([target for _, target in targets.values()])
        moved = self._judge('position', targets)
        # Back: wheels that stay steered would hold what is tried next.
        self._command([start for start, _ in targets.values()])
        self._sim.run(_SECONDS)
        return moved

    def _by_action(self) -> MotionResult:
        """Move a gripper by its action; the result has to come, too."""
        name, node = self._topic('gripper_cmd'), self._sim.node

        def offered() -> list[str]:
            named = dict(get_action_names_and_types(node))
            return [kind for kind in named.get(name, ()) if kind in _ACTIONS]

        kind = _ACTIONS[self._sim.wait(offered, f"the action '{name}'")[0]]
        targets = self._targets()
        (joint, (_, target)), *_ = targets.items()
        goal = kind.Goal()
        if kind is GripperCommand:
            goal.command.position = target
        else:
            goal.command = JointState(name=[joint], position=[target])
        client = ActionClient(node, kind, name)
        try:
            is_ready = ActionReadiness(node, client, kind, name)
            self._sim.wait(is_ready, f"the server of '{name}'")
            handle = self._finished(client.send_goal_async(goal), 'the answer to the goal')
            if not handle.accepted:
                return MotionResult(
                    self._controller.name, 'gripper', target, None, None, False, 'refused'
                )
            moved = self._judge('gripper', targets)
            result = self._finished(handle.get_result_async(), 'the result of the action')
        finally:
            client.destroy()
        end = result.result
        ended = f'reached_goal={end.reached_goal}, stalled={end.stalled}'
        return replace(moved, note=f'{moved.note}; {ended}')

    def _finished(self, future: Any, what: str) -> Any:
        """Let time pass until a future is done; return its result."""

        def result() -> Any:
            self._sim.step(10)
            return future.done() or None

        self._sim.wait(result, what, 10.0)
        return future.result()

    def _judge(self, what: str, targets: Mapping[str, tuple[float, float]]) -> MotionResult:
        self._sim.run(_SECONDS + _SETTLING)
        states = self._states.read()
        reached = {
            name: (target - start, states[name].position - start)
            for name, (start, target) in targets.items()
            if target != start or self._share_of(name)
        }
        return self._worst(what, reached)

    def _by_velocity(self) -> MotionResult:
        speeds = dict.fromkeys(self._names, _ANGLE)
        for name in self._names:
            limit = joint.limit if (joint := self._joints.get(name)) else None
            if limit is not None and limit.velocity > 0.0:
                speeds[name] = min(_ANGLE, 0.5 * limit.velocity)
        if self._takes_one_number:
            speeds = dict.fromkeys(speeds, min(speeds.values()))
        self._command([*speeds.values()])
        reached = self._steady(speeds)
        self._command([0.0] * len(speeds))
        self._sim.run(0.5)
        return self._worst('velocity', {n: (v, reached[n]) for n, v in speeds.items()})

    def _steady(self, speeds: Mapping[str, float]) -> dict[str, float]:
        """Return the speeds once they are as asked, or change no more: heavy ones take time."""
        end = self._sim.time + _LONGEST_START
        before, last = self._states.read(), dict.fromkeys(speeds, math.inf)
        begin = self._sim.time
        while True:
            self._sim.run(_START)
            now, time = self._states.read(), self._sim.time
            reached = {
                name: (now[name].position - before[name].position) / (time - begin)
                for name in speeds
            }
            is_there = all(
                abs(reached[n] - v) <= _STEADY * abs(v)
                or abs(reached[n] - last[n]) <= _STEADY * abs(v - reached[n])
                for n, v in speeds.items()
            )
            if is_there or time >= end:
                return reached
            before, last, begin = now, reached, time

    def _worst(self, what: str, reached: Mapping[str, tuple[float, float]]) -> MotionResult:
        """Return the motion of the joint with the greatest error: name → (asked, found)."""

        def error(name: str) -> float:
            asked, found = reached[name]
            return abs(found - asked) / abs(asked) if math.isfinite(found) and asked else math.inf

        name = max(reached, key=error)
        asked, found = reached[name]
        note = f'{len(reached)} joints, worst {name}'
        is_fine = error(name) <= _TOLERANCE
        return MotionResult(self._controller.name, what, asked, found, None, is_fine, note)

    def _topic(self, name: str) -> str:
        return f'{self._controller.namespace.rstrip("/")}/{self._controller.name}/{name}'
