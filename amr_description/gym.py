# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A robot with its controllers as an environment of Gymnasium, simulated in this process without ROS.

What is learned commands what users command: the topics of its controllers, whose limits and
time-outs hold. Actions and observations are chosen by name::

    env = RobotEnv(
        'my_robot.urdf',
        actions={'linear': (-0.5, 0.5), 'angular': (-1.0, 1.0)},
        observations=['odometry', 'scan'],
    )

A task is a class of its own, of which :class:`DriveToGoal` is an example. The same seed gives the
same bits. It needs ``gymnasium`` (``pip install 'amr-description[gym]'``).
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
import math
from typing import Any, TypeAlias

import numpy as np

from amr_description.errors import SimulationError, UsageError
from amr_description.model.frames import yaw_of
from amr_description.simulation.in_process import Simulation
from amr_description.text import quote_all

try:
    import gymnasium
    from gymnasium import spaces
except ModuleNotFoundError as error:
    if error.name != 'gymnasium':
        raise
    raise ModuleNotFoundError(
        "amr_description.gym needs gymnasium: python -m pip install 'amr-description[gym]'",
        name='gymnasium',
    ) from error

URDF = 'package://amr_description/urdf/amr.urdf'
TWIST = ('linear', 'lateral', 'angular')
"""Actions that are a velocity command together: m/s forward, m/s to the left, rad/s."""
RENDER_MODES = ['rgb_array']
_TIMES = 1e6
"""How many periods an action may last at most."""
Bounds: TypeAlias = tuple[float, float]
Observe: TypeAlias = Callable[[Simulation], Any]


def _odometry(sim: Simulation) -> Sequence[float]:
    """Return x, y, yaw, forward and turning speed by odometry; 0 before there is any."""
    if not sim.robot.has_odometry:
        return (0.0,) * 5
    return _planar(sim.odometry)


def _planar(motion: Any) -> Sequence[float]:
    return motion.x, motion.y, motion.yaw, motion.linear[0], motion.angular[2]


def _joints(sim: Simulation) -> Sequence[float]:
    """Return the positions of all joints, then their velocities, in order of their names."""
    joints = [joint for _, joint in sorted(sim.joints.items())]
    return [each.position for each in joints] + [each.velocity for each in joints]


def _scan(sim: Simulation) -> np.ndarray:
    """Return the ranges of the only lidar, m; what it does not see is at its longest range."""
    scan = sim.scan
    return np.nan_to_num(
        np.where(np.isfinite(scan.ranges), scan.ranges, scan.range_max), nan=scan.range_max
    )


OBSERVATIONS: Mapping[str, Observe] = {
    'odometry': _odometry,
    'truth': lambda sim: _planar(sim.truth),
    'joints': _joints,
    'scan': _scan,
    'image': lambda sim: sim.image().pixels,
}
"""What can be observed by name: ``odometry`` and ``truth`` are x, y, yaw, m/s and rad/s."""


class RobotEnv(gymnasium.Env[dict[str, np.ndarray], np.ndarray]):
    """
    See the module. A task overrides :meth:`begin` and :meth:`judge`, and observes what it wants.

    ``action_space`` is a Box of all actions in their order; ``observation_space`` a Dict by name,
    which ``gymnasium.wrappers.FlattenObservation`` makes one array.
    """

    metadata = {'render_modes': RENDER_MODES, 'render_fps': 10}  # noqa: RUF012  # Gymnasium's

    def __init__(
        self,
        urdf: str = URDF,
        controllers: str | Sequence[str] | None = None,
        *,
        actions: Mapping[str, Bounds | Sequence[Bounds]],
        observations: Sequence[str] | Mapping[str, Observe],
        period: float = 0.1,
        seconds: float = 30.0,
        render_mode: str | None = None,
        **options: Any,
    ) -> None:
        """
        Start a simulation.

        Args:
            urdf: As of the class Simulation, as ``controllers`` and ``options``.
            controllers: Of its parameter files.
            actions: Lower and upper bound by name: of :data:`TWIST`, in m/s and rad/s, or several
                bounds by the topic of a controller that takes ``std_msgs/msg/Float64MultiArray``.
            observations: Names of :data:`OBSERVATIONS`, or functions of the simulation by name.
            period: s of simulated time that an action lasts.
            seconds: After which an episode is truncated.
            render_mode: ``rgb_array``, or None.
            options: Further ones of the class Simulation.

        Raises:
            UsageError: A name or a bound will not do.
            AmrError: The simulation cannot start.
        """
        if render_mode not in (None, *RENDER_MODES):
            raise UsageError(f"render_mode is '{render_mode}'; 'rgb_array' or None will do")
        self.render_mode = render_mode
        self._actions = {name: _bounds(name, given) for name, given in actions.items()}
        low, high = np.array([each for some in self._actions.values() for each in some]).T
        self.action_space = spaces.Box(low, high, dtype=np.float64)
        self._observed = _observed(observations)
        self._period, self._end = period, seconds
        self.sim = Simulation(urdf, controllers, **options)
        """The simulation, whose methods a task may call."""
        self.sim.start()
        try:
            self._steps = self._steps_of(period)
            self._require_topics()
            self.reset(seed=0)
            self.observation_space = spaces.Dict(
                {name: _space_of(value) for name, value in self._observation().items()}
            )
        except BaseException:
            self.close()
            raise

    # --- what a task is -----------------------------------------------------------------------

    def begin(self) -> None:
        """
        Begin an episode, at time 0 after a reset: choose a goal, alter what varies.

        ``self.np_random`` is the generator of the seed; :mod:`amr_description.trials.variations`
        and ``faults`` alter the robot.
        """

    def judge(self) -> tuple[float, bool]:
        """Return the reward for the last period, and whether the episode has come to its end."""
        return 0.0, False

    # --- of Gymnasium -------------------------------------------------------------------------

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[dict[str, np.ndarray], dict[str, Any]]:
        """Begin an episode: at rest where the robot was spawned; a first period passes."""
        super().reset(seed=seed, options=options)
        self.sim.reset(seed=int(self.np_random.integers(2**31)))
        self.begin()
        self.sim.step(self._steps)
        return self._observation(), {'time': self.sim.time}

    def step(
        self, action: np.ndarray
    ) -> tuple[dict[str, np.ndarray], float, bool, bool, dict[str, Any]]:
        """
        Let a period pass under an action.

        Returns:
            Observations, reward, whether the task has ended, whether time has, ``{'time': s}``.

        Raises:
            UsageError: The action is not one of ``action_space``; it is taken into its bounds.
        """
        self.sim.send_all(self._commands(action))
        self.sim.step(self._steps)
        reward, is_terminated = self.judge()
        time = self.sim.time
        return self._observation(), reward, is_terminated, time >= self._end, {'time': time}

    def render(self) -> np.ndarray | None:
        """Return a picture of the world, height x width x 3 bytes; needs no display."""
        return self.sim.picture().pixels if self.render_mode else None

    def close(self) -> None:
        """End the simulation; it may be called again."""
        if self.sim.is_alive:
            self.sim.close()

    # --- actions and observations -------------------------------------------------------------

    def _commands(self, action: np.ndarray) -> dict[str, Any]:
        values = np.asarray(action, dtype=np.float64)
        if values.shape != self.action_space.shape or not np.isfinite(values).all():
            raise UsageError(
                f'an action is {action!r}; {self.action_space.shape[0]} finite numbers will do: '
                f'{quote_all([*self._actions])}'
            )
        values = np.clip(values, self.action_space.low, self.action_space.high)
        twist = dict.fromkeys(TWIST, 0.0)
        commands: dict[str, Any] = {}
        at = 0
        for name, bounds in self._actions.items():
            given = values[at : at + len(bounds)].tolist()
            at += len(bounds)
            if name in twist:
                (twist[name],) = given
            else:
                commands[name] = {'data': given}
        if any(name in twist for name in self._actions):
            robot = self.sim.robot
            command = robot.twist(twist['linear'], twist['angular'])
            commands[robot.command_topic] = replace(command, lateral=twist['lateral'])
        return commands

    def _require_topics(self) -> None:
        """Raise SimulationError: nothing takes the actions."""
        if set(self._actions) & {*TWIST} and not self.sim.robot.command_topic:
            raise SimulationError('no controller drives this robot; name the topic of one')
        self.sim.send_all(self._commands(np.zeros(self.action_space.shape)))

    def _observation(self) -> dict[str, np.ndarray]:
        found = {name: np.asarray(each(self.sim)) for name, each in self._observed.items()}
        return {
            name: value if value.dtype == np.uint8 else value.astype(np.float32)
            for name, value in found.items()
        }

    def _steps_of(self, period: float) -> int:
        steps = period / self.sim.timestep
        if not 1 <= steps <= _TIMES or abs(steps - round(steps)) > 1e-6 * steps:
            raise UsageError(
                f'a period of {period} s; a multiple of the time step of {self.sim.timestep:g} s '
                'will do'
            )
        return round(steps)


class DriveToGoal(RobotEnv):
    """
    The shipped robot drives to a goal, which is drawn 1 to 2 m from where it begins.

    Reward: how many m nearer it has come in a period, and 1 at the goal, within 0.15 m.
    """

    WITHIN = 0.15
    """m, at the goal."""

    def __init__(self, **options: Any) -> None:
        """``options``: as of :class:`RobotEnv`."""
        self.goal = (1.0, 0.0)
        """x and y in the world, m."""
        self._distance = 0.0
        given: dict[str, Any] = {
            'actions': {'linear': (-0.5, 0.5), 'angular': (-1.5, 1.5)},
            'observations': {'goal': self._goal_from_robot, 'speed': self._speed},
            'seconds': 20.0,
        }
        super().__init__(**{**given, **options})

    def begin(self) -> None:
        """Draw a goal."""
        distance, angle = self.np_random.uniform((1.0, -math.pi), (2.0, math.pi))
        self.goal = (distance * math.cos(angle), distance * math.sin(angle))
        self._distance = distance

    def judge(self) -> tuple[float, bool]:
        """Return the way towards the goal, m; more at the goal, which ends it."""
        truth = self.sim.truth
        before, self._distance = (
            self._distance,
            math.dist(self.goal, (truth.x, truth.y)),
        )
        is_there = self._distance < self.WITHIN
        return before - self._distance + is_there, is_there

    def _goal_from_robot(self, sim: Simulation) -> Sequence[float]:
        """Return where the goal is: m ahead and m to the left."""
        truth = sim.truth
        east, north = self.goal[0] - truth.x, self.goal[1] - truth.y
        yaw = yaw_of(truth.pose.rotation)
        ahead = math.cos(yaw) * east + math.sin(yaw) * north
        left = math.cos(yaw) * north - math.sin(yaw) * east
        return ahead, left

    def _speed(self, sim: Simulation) -> Sequence[float]:
        return _odometry(sim)[3:]


def _observed(observations: Sequence[str] | Mapping[str, Observe]) -> Mapping[str, Observe]:
    if isinstance(observations, Mapping):
        return observations
    unknown = [name for name in observations if name not in OBSERVATIONS]
    if unknown:
        raise UsageError(
            f"'{unknown[0]}' cannot be observed by name; {quote_all([*OBSERVATIONS])} can, and "
            'functions of the simulation: {name: function}'
        )
    return {name: OBSERVATIONS[name] for name in observations}


def _bounds(name: str, given: Bounds | Sequence[Bounds]) -> list[Bounds]:
    """Return the bounds of an action, one or several. Raises UsageError."""
    try:
        found = np.array(given, dtype=np.float64).reshape(-1, 2)
        is_sound = bool(np.isfinite(found).all() and (found[:, 0] < found[:, 1]).all())
    except (TypeError, ValueError):
        is_sound = False
    is_twist = name in TWIST
    if not (is_twist or name.startswith('/')):
        raise UsageError(
            f"'{name}' is no action; {quote_all([*TWIST])} are, and topics such as "
            "'/arm_controller/commands'"
        )
    if not is_sound or (is_twist and len(found) != 1):
        pairs = '(lower, upper)' if is_twist else '[(lower, upper), …]'
        raise UsageError(f"the bounds of '{name}' are {given!r}; {pairs} will do, both finite")
    return [(low, high) for low, high in found.tolist()]


def _space_of(value: np.ndarray) -> spaces.Box:
    if value.dtype == np.uint8:
        return spaces.Box(0, 255, value.shape, np.uint8)
    return spaces.Box(-np.inf, np.inf, value.shape, np.float32)


gymnasium.register('amr_description/DriveToGoal-v0', entry_point=DriveToGoal)
