# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The simulated world: a ground, robots that come and go, and time.

::

    world = MujocoWorld('empty', log=log)
    world.timestep = physics_stepping(10_000_000).step     # 2 ms for a 100 Hz controller
    robot = world.spawn('amr', urdf_text, Transform((0.0, 0.0, 0.2)))
    wheels = robot.joints(['joint_wheel_front_left', …])
    wheels.command('velocity', [5.0, …])
    world.advance(10_000_000)                               # 10 ms of simulated time: 5 steps
    robot.pose('base_footprint')
"""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager

import mujoco
import numpy as np

from amr_description.errors import SimulationError, SpawnError
from amr_description.log import Log, null_log, Severity
from amr_description.model.frames import Transform, wxyz_from_xyzw
from amr_description.model.robot import Robot
from amr_description.model.wheels import Rollers
from amr_description.sim.engine import compiler_message, compiler_warnings, Engine, LONGEST_STEP
from amr_description.sim.faults import collect_mujoco_warnings, FaultMonitor
from amr_description.sim.gazebo_physics import wheel_geom_name
from amr_description.sim.overlap import find_drop, find_overlap, TOLERANCE
from amr_description.sim.rays import RayScene
from amr_description.sim.robot_spec import build_robot, RobotSpec
from amr_description.sim.robot_view import RobotView
from amr_description.sim.spawning import (
    check_name,
    checked_pose,
    read_description,
    SpawnCode,
)
from amr_description.sim.wheel_contact import add_wheel_contact, ContactSettings, WHEEL_CONTACT
from amr_description.sim.wheel_trim import Contacts, trimmed_contacts
from amr_description.sim.world_file import load_world, longest_step, static_surfaces, WorldSettings
from amr_description.sim.wrenches import Wrenches
from amr_description.text import quote_all

AT_ORIGIN = Transform()
_FILE_SETTINGS = WorldSettings()
_NO_ROLLERS: Mapping[str, Rollers] = {}


class MujocoWorld:
    """
    One MuJoCo world with any number of robots.

    Not thread-safe: every call is made on the control thread. Deterministic: the same world,
    robots and commands at the same steps give the same :meth:`state`, bit by bit. It is a
    :class:`~amr_description.control.loop.Stepper`.
    """

    def __init__(
        self,
        world: str = 'empty',
        *,
        settings: WorldSettings = _FILE_SETTINGS,
        timestep: int | None = None,
        contact: ContactSettings = WHEEL_CONTACT,
        seed: int = 0,
        strict: bool = False,
        log: Log = null_log,
    ) -> None:
        """
        Load a world.

        Args:
            world: The name of a shipped world, or the path of an MJCF file.
            settings: Physics options; they take precedence over the file's.
            timestep: Physics step, ns; by default the longest that settings and file allow.
            contact: The contact of wheels with static surfaces.
            seed: Not negative; seeds the noise of all sensors.
            strict: Refuse a description that would have to be taken as something else.
            log: Gets warnings and faults.

        Raises:
            SimulationError: There is no such world, or MuJoCo rejects it.
        """
        collect_mujoco_warnings()
        self._log = log
        self._settings = settings
        spec = self._read(world)
        self.longest_step = longest_step(spec, settings)
        """The longest physics step that settings and file allow, ns."""
        self._surfaces = static_surfaces(spec)
        self._contact = contact
        self._seed = seed
        self._strict = strict
        self._contacts: dict[tuple[str, tuple[Rollers, ...]], Contacts] = {}
        # MuJoCo keeps every spec that was ever attached, 0.1 MB each: so there is one for each
        # description, and it is copied into the world for each robot of it.
        self._specs: dict[str, mujoco.MjSpec] = {}
        with _compiling(world, log):
            self.engine = Engine(spec, self.longest_step if timestep is None else timestep)
            """Model and data, for this package and its tests."""
        self.faults = FaultMonitor(self.engine, log)
        """Checks the state after every step; its ``on_fault`` may be set."""
        self._robots: dict[str, RobotView] = {}
        self._roots: tuple[tuple[str, int], ...] = ()
        self._on_wheels: frozenset[str] = frozenset()
        self._ray_scene: tuple[int, RayScene] | None = None
        self.wrenches = Wrenches(self.engine, lambda robot, link: self.robot(robot).body(link))
        """From outside; they end with their robot, and with a reset."""

    def load(self, world: str) -> None:
        """
        Load another world in the place of this one, which no robot is in any more; at time 0.

        Args:
            world: As at the start.

        Raises:
            SimulationError: There is no such world, MuJoCo rejects it, or a robot is in this one;
                nothing has changed.
        """
        if self._robots:
            raise SimulationError(f'{quote_all(self.names)}: still in the world; delete first')
        spec = self._read(world)
        longest = longest_step(spec, self._settings)
        with _compiling(world, self._log):
            self.engine.load(spec, longest)
        self.longest_step, self._surfaces = longest, static_surfaces(spec)
        self._contacts.clear()  # gravity may be another
        self.faults.release()
        self.faults.bind()
        self.faults.reset()

    def _read(self, world: str) -> mujoco.MjSpec:
        """Read the file of a world. Raises SimulationError."""
        with compiler_warnings(self._log, f"world '{world}'"):
            spec = load_world(world, self._settings)
        spec.copy_during_attach = True
        step = longest_step(spec, self._settings)
        if step > LONGEST_STEP:
            self._log(
                Severity.WARN,
                f"world '{world}': a physics step of {step / 1e6:g} ms is asked; the wheels' "
                f'contacts are tuned for {LONGEST_STEP / 1e6:g} ms and less',
            )
        return spec

    @property
    def time(self) -> int:
        """Simulated time, ns; setting it changes nothing else."""
        return self.engine.time

    @time.setter
    def time(self, time: int) -> None:
        self.engine.time = time
        self.faults.reset()

    @property
    def timestep(self) -> int:
        """The physics step, ns; it may be set at any time, time goes on from the present one."""
        return self.engine.timestep

    @timestep.setter
    def timestep(self, timestep: int) -> None:
        self.engine.timestep = timestep

    @property
    def seed(self) -> int:
        """Of the noise of all sensors; one that is set counts from the next reset on."""
        return self._seed

    @seed.setter
    def seed(self, seed: int) -> None:
        if seed < 0:
            raise SimulationError(f'a seed of {seed} is asked; 0 and above will do')
        self._seed = seed
        for view in self._robots.values():
            view.seed_with(seed)

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the robots, in the order in which they were spawned."""
        return tuple(self._robots)

    def robot(self, name: str) -> RobotView:
        """Return a robot by name. Raises SimulationError, which lists the names that exist."""
        try:
            return self._robots[name]
        except KeyError:
            raise SimulationError(
                f"there is no robot '{name}'; there are: {', '.join(self.names) or 'none'}"
            ) from None

    def spawn(
        self,
        name: str,
        description: str | Robot,
        pose: Transform = AT_ORIGIN,
        *,
        lift: bool = False,
        rollers: Mapping[str, Rollers] = _NO_ROLLERS,
    ) -> RobotView:
        """
        Put a robot into the world, its joints held at their initial positions.

        Time and all other robots stay as they are.

        Args:
            name: Of the robot; prefixes its elements in the model.
            description: A URDF, or what
                :func:`~amr_description.sim.spawning.read_description` made of it.
            pose: Transform from the robot's root link to the world.
            lift: Whether a robot that would be inside the ground, or another static body, is
                lifted until it is free, and one at z = 0 that would drop is put onto what is
                below it; either is logged.
            rollers: Of mecanum and omni wheels, by joint, of which the description does not tell.

        Returns:
            The robot, as a hardware component sees it.

        Raises:
            SpawnError: The world is unchanged.
        """
        check_name(name, self.names)
        pose = checked_pose(pose)
        if isinstance(description, str):
            description = read_description(description, name, self._log, strict=self._strict)
        model = build_robot(description, self._log, strict=self._strict, named_rollers=rollers)
        contacts = self._contacts_of(description, model)
        spec = self._specs.setdefault(description.text, model.spec)
        self._add_rollers(name, model)
        self._attach(name, spec, pose, contacts)
        # A view sets the initial positions of the joints, which a free height follows from.
        others = self._log, self._seed, self.ray_scene
        view = RobotView(self.engine, name, description, model, pose, *others)
        if height := self._height(name, pose, lift=lift):
            x, y, z = pose.translation
            pose = Transform((x, y, z + height), pose.rotation)
            self._put(name, pose)
            view = RobotView(self.engine, name, description, model, pose, *others)
        self._robots[name] = view
        self._index_roots()
        return view

    def _height(self, name: str, pose: Transform, *, lift: bool) -> float:
        """
        Return how much higher than it has just been put a robot is to be, m.

        Raises SpawnError, without the robot: it is inside what it may not be lifted from.
        """
        overlap = find_overlap(self.engine, name)
        if overlap is None:
            on_ground = lift and pose.translation[2] == 0.0
            drop = find_drop(self.engine, name) if on_ground else 0.0
            if drop <= TOLERANCE:
                return 0.0
            self._log(
                Severity.INFO,
                f"'{name}' is put {drop:.3f} m lower, where it stands: at z = 0 it would drop",
            )
            return -drop
        if not lift or overlap.lift is None:
            self._detach(name)
            raise overlap.error(name)
        self._log(
            Severity.INFO,
            f"'{name}' is lifted by {overlap.lift:.3f} m: its link '{overlap.link}' would be "
            f'{overlap.depth:.3f} m deep in {overlap.other}',
        )
        return overlap.lift

    def _put(self, name: str, pose: Transform) -> None:
        """Put a robot that has just been attached elsewhere; its meshes stay as they are."""
        self.engine.spec.frame(name).pos = pose.translation
        self._recompile()
        model, data = self.engine.model, self.engine.data
        for joint in np.flatnonzero(model.jnt_type == mujoco.mjtJoint.mjJNT_FREE).tolist():
            if model.joint(joint).name.startswith(f'{name}/'):
                begin = model.jnt_qposadr[joint]
                data.qpos[begin : begin + 7] = model.qpos0[begin : begin + 7]

    def remove(self, name: str) -> None:
        """Remove a robot; its view becomes invalid. Raises SimulationError for an unknown name."""
        self.robot(name)
        self.wrenches.forget(name)
        self._detach(name)
        del self._robots[name]
        self._index_roots()

    def step(self, count: int = 1) -> None:
        """Advance by ``count`` physics steps, then check for faults."""
        if self.wrenches:
            self.wrenches.step(count)
        else:
            self.engine.step(count)
        self.faults.check(self._roots, self._on_wheels)

    def advance(self, period: int) -> None:
        """Advance by ``period`` (ns), rounded to whole physics steps, by one at least."""
        self.step(round(period / self.engine.timestep) or 1)

    def state(self) -> bytes:
        """Return everything the next step depends on, to compare two runs bit by bit."""
        return self.engine.state()

    def ray_scene(self) -> RayScene:
        """Return what can be seen, where it is now; the same one until a robot comes or goes."""
        engine = self.engine
        engine.refresh_kinematics()
        if self._ray_scene is None or self._ray_scene[0] != engine.generation:
            scene = RayScene(engine.model, engine.data, self.names)
            self._ray_scene = engine.generation, scene
        return self._ray_scene[1]

    def reset(self) -> None:
        """Set the time to 0 and every robot to where it was spawned, its joints held."""
        self.engine.reset()
        self.wrenches.clear_all()
        for view in self._robots.values():
            view.start()
        self.faults.release()
        self.faults.reset()

    def _contacts_of(self, robot: Robot, model: RobotSpec) -> Contacts:
        """Return the contacts of wheels and casters, computed once for each description."""
        key = robot.text, tuple(model.rollers.values())
        if key not in self._contacts:
            gravity = float(np.linalg.norm(self.engine.spec.option.gravity))

            def log(severity: Severity, text: str, *, throttle: float = 0.0) -> None:
                self._log(severity, f'{robot.source}: {text}', throttle=throttle)

            self._contacts[key] = trimmed_contacts(model, self._contact, gravity, log)
        return self._contacts[key]

    def _add_rollers(self, name: str, model: RobotSpec) -> None:
        for wheel in model.wheels:
            geom = wheel_geom_name(wheel.link)
            if geom in model.rollers:
                angle = model.rollers[geom].angle
                self.engine.rollers.add(f'{name}/{geom}', f'{name}/{wheel.joint}', angle)

    def _attach(
        self, name: str, robot: mujoco.MjSpec, pose: Transform, contacts: Contacts
    ) -> None:
        spec = self.engine.spec
        frame = spec.worldbody.add_frame(
            name=name, pos=pose.translation, quat=wxyz_from_xyzw(pose.rotation)
        )
        try:
            spec.attach(robot, frame=frame, prefix=f'{name}/')
            for geom, contact in contacts.items():
                for surface in self._surfaces:
                    add_wheel_contact(spec, f'{name}/{geom}', surface, contact)
            self._recompile()
        except ValueError as cause:
            self._delete(name)
            raise SpawnError(
                f"'{name}' cannot be put into the world: {compiler_message(str(cause))}",
                SpawnCode.OPERATION_FAILED,
            ) from cause

    def _detach(self, name: str) -> None:
        self._delete(name)
        self._recompile()

    def _recompile(self) -> None:
        self.engine.recompile()
        self.faults.bind()  # at once: what was sound is kept of this model

    def _delete(self, name: str) -> None:
        """Delete from the spec what was attached, including its assets and its default class."""
        spec = self.engine.spec
        self.engine.rollers.remove(f'{name}/')
        spec.delete(spec.frame(name))
        for asset in (*spec.meshes, *spec.textures, *spec.materials):
            if asset.name.startswith(f'{name}/'):
                spec.delete(asset)
        defaults = spec.find_default(f'{name}/main')
        if defaults is not None:
            spec.delete(defaults)

    def _index_roots(self) -> None:
        heights = ((name, view.height_index()) for name, view in self._robots.items())
        self._roots = tuple((name, index) for name, index in heights if index is not None)
        self._on_wheels = frozenset(name for name, view in self._robots.items() if view.wheels)


@contextmanager
def _compiling(world: str, log: Log) -> Iterator[None]:
    """Log MuJoCo's warnings; make its ValueError a SimulationError that names the world."""
    try:
        with compiler_warnings(log, f"world '{world}'"):
            yield
    except ValueError as cause:
        raise SimulationError(f"world '{world}': {compiler_message(str(cause))}") from cause
