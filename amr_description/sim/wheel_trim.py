# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The contacts of wheels and casters, trimmed for each robot so that it rests at its true height.

The soft contacts of :mod:`amr_description.sim.wheel_contact` sink under load; a ``margin`` cancels
that. The margin needed depends on how the robot's weight and inertia are spread over its wheels,
so each robot is set down on flat ground once, by itself, before it is spawned. Measured with the
margin of the shipped robot: a robot on two wheels of 50 mm and a ball sinks by 0.65 mm and drives
0.6 % short; trimmed, by 2 µm.

A ball caster slides when the robot turns, as a wheel does, and so does whatever else a robot on
wheels rests on: a skid, a fixed caster wheel, its tail. With MuJoCo's default contacts it hops,
and the wheels slip by 10 %; so it gets the contact of a wheel too.
"""

from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace
import hashlib
import math
from typing import TypeAlias

import mujoco
import numpy as np

from amr_description.log import Log, null_log, Severity
from amr_description.sim.engine import compiler_warnings
from amr_description.sim.faults import collect_mujoco_warnings
from amr_description.sim.gazebo_physics import wheel_geom_name
from amr_description.sim.robot_spec import RobotSpec
from amr_description.sim.wheel_contact import add_wheel_contact, ContactSettings
from amr_description.sim.world_file import apply_settings, WorldSettings
from amr_description.text import quote_all

Contacts: TypeAlias = Mapping[str, ContactSettings]
"""Name of a geom → its contact with static surfaces."""

_HIGH = 100.0
"""m; nothing of a robot is so far below its root."""
_STEPS = 1000
_STEP = 0.002
"""s."""
_STILL = 0.01
"""m/s and rad/s; a robot that moves faster is not at rest, and its heights are not used."""

_HOLDS = 0.9
"""The share of what the wheels can pull from which on they slip."""


@dataclass(frozen=True, slots=True)
class Rest:
    """How a geom rests on flat ground."""

    height: float
    """Above the ground, m."""
    load: float
    """N."""


_KNOWN: dict[tuple[bytes, bytes, bytes], Mapping[str, Rest]] = {}
"""
How robots have settled in this process, by all that it follows from: the compiled model, and the
positions and commands at the start. The same robot in another world need not settle again.
"""
_MOST_KNOWN = 100


def trimmed_contacts(
    model: RobotSpec, settings: ContactSettings, gravity: float, log: Log = null_log
) -> Contacts:
    """
    Return the contact of each wheel, and of each caster on which the robot rests.

    Args:
        model: The robot.
        settings: The contact whose margin is trimmed; a wheel that does not come to rest on the
            ground keeps it as it is.
        gravity: m/s².
        log: Gets a warning if what slides holds the robot as hard as its wheels can pull.

    Raises:
        ValueError: MuJoCo's.
    """
    contacts = {
        geom: _settings_of(geom, model, settings)
        for geom in (wheel_geom_name(wheel.link) for wheel in model.wheels)
    }
    rests = _rests(model, settings, gravity)
    for geom, rest in rests.items():
        contact = _settings_of(geom, model, settings)
        contacts[geom] = replace(contact, margin=max(0.0, settings.margin - rest.height))
    for geom, share in _shares_of_grip(model.slipping, rests).items():
        grip = min(1.0, contacts[geom].sliding_friction)
        contacts[geom] = replace(contacts[geom], sliding_friction=grip * share)
    warning = drag_warning(model, rests)
    if warning:
        log(Severity.WARN, warning)
    return contacts


def drag_warning(model: RobotSpec, rests: Mapping[str, Rest]) -> str:
    """
    Return a line if what slides on the ground holds a robot about as hard as its wheels can pull.

    By Coulomb, on ground as rough as the default of links: the sum of friction times load over
    what slides, and over the driven wheels. Empty: the wheels can pull it.
    """
    moved = {joint for joint, names in model.commands.items() if names}
    moved |= {each.name1 for each in model.spec.equalities if each.name2 in moved}  # mimics
    driven = {wheel_geom_name(wheel.link) for wheel in model.wheels if wheel.joint in moved}
    sliding = {geom: rest.load for geom, rest in rests.items() if geom in model.casters}

    def force(loads: Mapping[str, float]) -> float:
        own = model.frictions
        return math.fsum(min(1.0, own.get(geom, 1.0)) * load for geom, load in loads.items())

    pull = force({geom: rest.load for geom, rest in rests.items() if geom in driven})
    drag = force(sliding)
    if not driven or not sliding or drag < _HOLDS * pull:
        return ''
    links = list(dict.fromkeys(geom.rpartition('/')[0] for geom in sliding))
    return (
        f'{quote_all(links)} slide on the ground and hold the robot with {drag:.3g} N, its wheels '
        f'pull with {pull:.3g} N at most: they slip; as a ball that rolls, write <gazebo '
        f'reference="{links[0]}"><mu1>0.01</mu1></gazebo>'
    )


def _shares_of_grip(slipping: Collection[str], rests: Mapping[str, Rest]) -> Mapping[str, float]:
    """
    Return the share of its friction that is left to each wheel that slips by force, not by load.

    So all of them hold the robot as hard as that which bears least; where wheels one behind the
    other scrub in a turn, it turns as with loads that are equal, wherever its weight is.
    """
    loads = {geom: rest.load for geom, rest in rests.items() if geom in slipping and rest.load > 0}
    least = min(loads.values(), default=0.0)
    return {geom: least / load for geom, load in loads.items()}


def _settings_of(geom: str, model: RobotSpec, settings: ContactSettings) -> ContactSettings:
    settings = _with_friction_of(geom, model, settings)
    rollers = model.rollers.get(geom)
    return settings if rollers is None else settings.with_rollers(rollers)


def _with_friction_of(geom: str, model: RobotSpec, settings: ContactSettings) -> ContactSettings:
    return replace(settings, sliding_friction=model.frictions.get(geom, math.inf))


def _rests(model: RobotSpec, settings: ContactSettings, gravity: float) -> Mapping[str, Rest]:
    """Return how the wheels and casters rest that are on the ground."""
    if not model.wheels or model.free_joint is None:
        return {}
    spec = mujoco.MjSpec()
    apply_settings(spec.option, WorldSettings(gravity=gravity))
    spec.option.timestep = _STEP
    spec.compiler.fusestatic = False
    ground = spec.worldbody.add_geom(
        name='ground', type=mujoco.mjtGeom.mjGEOM_PLANE, size=[0.0, 0.0, 1.0]
    )
    spec.attach(model.spec.copy(), frame=spec.worldbody.add_frame(), prefix='robot/')
    geoms = [*(wheel_geom_name(wheel.link) for wheel in model.wheels), *model.casters]
    for geom in geoms:
        contact = _with_friction_of(geom, model, settings)
        add_wheel_contact(spec, f'robot/{geom}', ground, contact)
    with compiler_warnings(null_log, ''):  # logged when the robot was built
        compiled = spec.compile()
    data = mujoco.MjData(compiled)
    _place_on_ground(compiled, data, model)
    rests = _known_rests(compiled, data)
    return {geom: rests[f'robot/{geom}'] for geom in geoms if f'robot/{geom}' in rests}


def _known_rests(compiled: mujoco.MjModel, data: mujoco.MjData) -> Mapping[str, Rest]:
    """Return the geoms that touch the ground at rest; none: no rest."""
    packed = np.empty(mujoco.mj_sizeModel(compiled), np.uint8)
    mujoco.mj_saveModel(compiled, None, packed)
    start = (hashlib.sha256(packed).digest(), data.qpos.tobytes(), data.ctrl.tobytes())
    rests = _KNOWN.get(start)
    if rests is None:
        if len(_KNOWN) >= _MOST_KNOWN:
            _KNOWN.clear()
        rests = _KNOWN[start] = _settle(compiled, data)
    return rests


def _settle(compiled: mujoco.MjModel, data: mujoco.MjData) -> Mapping[str, Rest]:
    # Faults here will occur in the world too and be logged then.
    mujoco.set_mju_user_warning(lambda text: None)
    mujoco.mj_step(compiled, data, _STEPS)
    collect_mujoco_warnings()
    if not np.abs(data.qvel).max() < _STILL:
        return {}
    rests: dict[str, Rest] = {}
    force = np.empty(6)
    contacts = zip(data.contact.geom.tolist(), data.contact.dist.tolist(), strict=True)
    for contact, (geoms, height) in enumerate(contacts):
        mujoco.mj_contactForce(compiled, data, contact, force)
        name = compiled.geom(max(geoms)).name
        before = rests[name].load if name in rests else 0.0
        rests[name] = Rest(height, before + float(force[0]))
    return rests


def _place_on_ground(compiled: mujoco.MjModel, data: mujoco.MjData, model: RobotSpec) -> None:
    """Set the initial joint positions, and put the lowest point of the robot on the ground."""
    for name, state in model.initial_states.items():
        joint = f'robot/{name}'
        data.joint(joint).qpos[:] = state.position
        for actuator in range(compiled.nu):
            # A spring on the joint itself; behind a clutch it acts on the rotor.
            if compiled.actuator_trnid[actuator, 0] == compiled.joint(joint).id:
                is_spring = compiled.actuator_biasprm[actuator, 1] != 0.0
                data.ctrl[actuator] = state.position if is_spring else 0.0
    height = compiled.jnt_qposadr[compiled.joint(f'robot/{model.free_joint}').id] + 2
    data.qpos[height] = _HIGH
    mujoco.mj_forward(compiled, data)
    ground = compiled.geom('ground').id
    touching = np.flatnonzero(compiled.geom_contype | compiled.geom_conaffinity)
    data.qpos[height] -= min(
        mujoco.mj_geomDistance(compiled, data, ground, geom, 2.0 * _HIGH, None)
        for geom in touching.tolist()
        if geom != ground
    )
