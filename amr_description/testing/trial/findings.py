# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What is found of a robot, as data that JSON can hold."""

from collections.abc import Sequence
from dataclasses import asdict, dataclass, field
import json
import math
from typing import Any


@dataclass
class Check:
    """What ``check_urdf`` says."""

    exit_code: int | None = None
    """None: it did not end by itself."""
    errors: list[str] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)
    failure: str = ''
    """A traceback, or why nothing could be checked."""


@dataclass
class RestResult:
    """Three seconds after the spawn without a command."""

    seconds: float
    """Until the root link stands; infinite: it does not."""
    fastest: float
    """Of the root link, m/s."""
    drop: float
    """How far the root link has sunk, m."""
    shift: float
    """How far it has gone aside, m."""
    tilt: float
    """Between its z axis before and after, rad."""


@dataclass
class ControllerFinding:
    """One controller of the parameters."""

    name: str
    type: str
    state: str
    """``active``, ``inactive``, ``unconfigured``, or ``not loaded``."""
    reason: str = ''
    """Why it is not active, or what gave way to it."""
    without: str = ''
    """What the machine or the description has not, so that it cannot be active; '': nothing."""
    names: list[str] = field(default_factory=list)
    """What its parameters and interfaces name, joints among them; of one that is not active."""


@dataclass
class MotionResult:
    """One motion: what was asked, and what came of it, in m, rad, m/s and rad/s."""

    controller: str
    what: str
    asked: float
    truth: float | None
    odometry: float | None = None
    is_fine: bool = True
    note: str = ''
    said: str = ''
    """What the simulator has said that explains why it is not fine: then it is no fault."""


@dataclass
class TrialFindings:
    """Everything about one robot."""

    robot: str
    file: str
    parameters: list[str] = field(default_factory=list)
    parameters_by: str = ''
    """How the parameter file was found."""
    stage: str = 'start'
    """What was under way when this was written; ``done``: it came to the end."""
    check: Check = field(default_factory=Check)
    spawn_seconds: float | None = None
    """s of the wall clock, with the start of the simulator; None: not spawned."""
    rest: RestResult | None = None
    controllers: list[ControllerFinding] = field(default_factory=list)
    motions: list[MotionResult] = field(default_factory=list)
    explained: list[str] = field(default_factory=list)
    """Motions that are off for a reason that the simulator has named."""
    undriven: list[str] = field(default_factory=list)
    """Active controllers that were not tried, and why."""
    warnings: list[str] = field(default_factory=list)
    """WARN and ERROR lines of the simulator."""
    posture: list[str] = field(default_factory=list)
    """That it falls, has tipped over, explodes, or was frozen: at rest, or after a motion."""
    spare: list[str] = field(default_factory=list)
    """Controllers that cannot be active, and whose joints others have moved."""
    has_drive: bool = True
    """Whether its description has anything that drives: commands of joints, or a plugin."""
    faults: list[str] = field(default_factory=list)
    """What else is not as it should be, and nothing has explained."""
    seconds: float = 0.0
    """s of the wall clock."""
    cpu_seconds: float = 0.0
    """s of all processes of this robot."""


def to_json(findings: Sequence[TrialFindings]) -> str:
    """Return everything as JSON, numbers that it does not have as null."""
    return json.dumps([_finite(asdict(each)) for each in findings], indent=1, ensure_ascii=False)


def from_json(text: str) -> TrialFindings:
    """Return what :func:`to_json` has written of one robot."""
    values = json.loads(text)[0]
    rest = values['rest']
    values['check'] = Check(**values['check'])
    if rest is not None:
        values['rest'] = RestResult(**{k: math.inf if v is None else v for k, v in rest.items()})
    values['controllers'] = [ControllerFinding(**each) for each in values['controllers']]
    values['motions'] = [MotionResult(**each) for each in values['motions']]
    return TrialFindings(**values)


def _finite(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _finite(each) for key, each in value.items()}
    if isinstance(value, list):
        return [_finite(each) for each in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
