# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What is done with one robot, in order: check, spawn, rest, controllers, motions.

``python -m amr_description.testing.trial.one_robot JOB RESULT`` does it in a process of its own:
``JOB`` is a JSON file with the fields of :class:`Job`, ``RESULT`` is written anew at every stage,
so that it tells how far a robot came that took the simulator, or the time, with it.
"""

from collections.abc import Callable, Iterator, Sequence
from contextlib import closing
from dataclasses import dataclass
import json
import math
import os
from pathlib import Path
import re
import subprocess
import sys
import tempfile
import time
import warnings

from amr_description.errors import AmrError
from amr_description.model.description_file import description_at
from amr_description.model.frames import rotate
from amr_description.model.robot import Robot
from amr_description.model.urdf import parse
from amr_description.testing.simulation import Simulation
from amr_description.testing.trial.bring_up import Active, BringUp, find_manager, logged
from amr_description.testing.trial.driving import DriveTrial, TOLERANCE
from amr_description.testing.trial.findings import (
    Check,
    from_json,
    MotionResult,
    RestResult,
    to_json,
    TrialFindings,
)
from amr_description.testing.trial.inputs import (
    parameters_of,
    replaced_copy,
    self_typed,
    TrialParameters,
)
from amr_description.testing.trial.moving import is_moved, JointStates, Mover
from amr_description.text import one_line

REST = 3.0
"""s without a command."""
REST_WITHIN = 2.0
"""s in which a robot is to stand."""
_STILL_LINEAR, _STILL_ANGULAR = 0.01, 0.05
"""m/s and rad/s; a slower robot stands."""
_EXPLOSION = 5.0
"""m/s: a fall from more than a metre, which nothing spawned on the ground has before it."""
_SAMPLE = 0.1
"""s between two looks at a robot at rest."""
_DRIVE_PLUGIN = re.compile(
    r'<plugin\b[^>]*\b(?:filename|name)="([^"]*(?:drive|Drive|steering|Steering|planar_move)[^"]*)"'
)
"""A plugin of Gazebo that drives."""
_TOUCHES_NOTHING = 'no shape of it touches anything'
_OF_TURNS = re.compile(r'swapped|inverted|steer to the left|in the order|turn the robot|scrub')
_OF_SLIP = re.compile(r'they slip|scrub')
_TIPPED = math.pi / 6.0
"""rad; a robot at a greater tilt does not come back."""
_STRAIGHT_UP = (0.0, 0.0, 1.0)


@dataclass(frozen=True)
class Job:
    """What is asked of a process."""

    robot: str
    file: str
    controllers: tuple[str, ...] = ()
    replacements: tuple[tuple[str, str], ...] = ()
    check_timeout: float = 60.0


class Trial:
    """One robot on its way through the stages."""

    def __init__(self, job: Job, keep: Callable[[TrialFindings], None]) -> None:
        """``keep`` is called with the findings at every stage."""
        self._job = job
        self._keep = keep
        self.found = TrialFindings(job.robot, job.file)
        self._publishers: set[str] = set()  # active, without a command interface

    def run(self) -> None:
        """Go through all stages; what stops it is a fault of the robot."""
        with tempfile.TemporaryDirectory(prefix='amr-trial-') as name:
            folder = Path(name)
            try:
                self._run(folder)
                self._enter('done')
            except AmrError as error:
                self._fault(f'{self.found.stage}: {one_line(str(error))}')
            finally:
                self.found = without_path(self.found, f'{folder}/beside/')
                self._keep(self.found)

    def _run(self, folder: Path) -> None:
        beside, own = folder / 'beside', folder / 'own'
        beside.mkdir()
        own.mkdir()
        source = Path(self._job.file)
        file = replaced_copy(source, beside, dict(self._job.replacements))
        self._enter('check')
        self._check(file)
        self._enter('read')
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter('always')
            text = description_at(str(file.absolute()), warn=self._warn)
            given = parameters_of(source, text, self._job.robot, own, self._job.controllers)
            self.found.parameters = [str(each) for each in given.files]
            self.found.parameters_by = given.by
            self._simulate(file, given, text)
        self.found.warnings += [f'WARN: {one_line(str(each.message))}' for each in said]

    # --- the description -----------------------------------------------------------------------

    def _check(self, file: Path) -> None:
        """Run ``check_urdf``, as a user does."""
        given = [word for each in self._job.controllers for word in self._checked_with(each)]
        command = [sys.executable, '-m', 'amr_description.cli', 'check_urdf', '--json', *given]
        try:
            ended = subprocess.run(
                [*command, str(file)],
                capture_output=True,
                text=True,
                errors='replace',
                timeout=self._job.check_timeout,
                check=False,
            )
        except subprocess.TimeoutExpired:
            text = f'check_urdf has not ended within {self._job.check_timeout:g} s'
            self.found.check = Check(failure=text)
            self._fault(text)
            return
        self.found.check = check_of(ended.returncode, ended.stdout, ended.stderr)
        if self.found.check.failure:
            self._fault(f'check_urdf: {self.found.check.failure}')

    def _checked_with(self, given: str) -> list[str]:
        name, separator, file = given.partition('=')
        if separator and name != self._job.robot:
            return []
        return ['--controllers', file or name]

    # --- the simulation ------------------------------------------------------------------------

    def _simulate(self, file: Path, given: TrialParameters, text: str) -> None:
        self._enter('spawn')
        begin = time.monotonic()
        sim = Simulation(file.absolute(), given.told, activate=[])
        try:
            with sim:
                self.found.spawn_seconds = time.monotonic() - begin
                self._enter('rest')
                self._rest(sim)
                self._enter('controllers')
                manager = find_manager(sim, is_promised='<ros2_control' in text)
                if manager is None:
                    self.found.undriven.append('there is no controller manager')
                else:
                    bring_up = BringUp(sim, manager, self_typed(given.files))
                    self._controllers(sim, parse(text), bring_up)
                self._miss_motions(text)
                self._enter('end')
        finally:
            self._read_log(sim)

    def _read_log(self, sim: Simulation) -> None:
        try:
            self.found.warnings += logged(sim.log)
        except AttributeError:  # it was never started
            return

    def _rest(self, sim: Simulation) -> None:
        begin = sim.truth
        fastest, last_moving = 0.0, 0.0
        while sim.time < REST - 1e-6:
            sim.run(_SAMPLE)
            now = sim.truth
            speed, turn = math.hypot(*now.linear), math.hypot(*now.angular)
            if not math.isfinite(speed + turn + now.x + now.y + now.z):
                self._fault('rest: it explodes: its pose is not finite')
                self.found.rest = RestResult(math.inf, math.inf, math.nan, math.nan, math.nan)
                return
            fastest = max(fastest, speed)
            if speed > _STILL_LINEAR or turn > _STILL_ANGULAR:
                last_moving = sim.time
        up = rotate(now.pose.rotation, _STRAIGHT_UP)
        before = rotate(begin.pose.rotation, _STRAIGHT_UP)
        cosine = sum(a * b for a, b in zip(up, before, strict=True))
        rest = RestResult(
            seconds=last_moving if last_moving < REST - 1e-6 else math.inf,
            fastest=fastest,
            drop=begin.z - now.z,
            shift=math.hypot(now.x - begin.x, now.y - begin.y),
            tilt=math.acos(max(-1.0, min(1.0, cosine))),
        )
        self.found.rest = rest
        falls = [line for line in logged(sim.log) if _TOUCHES_NOTHING in line]
        if falls:
            self.found.explained.append(f'rest: it falls at {fastest:.1f} m/s: {falls[0]}')
        elif fastest > _EXPLOSION:
            self._fault(f'rest: it explodes: {fastest:.1f} m/s')
        elif rest.seconds > REST_WITHIN:
            speeds = math.hypot(*now.linear), math.hypot(*now.angular)
            self._fault(f'rest: {unrest(rest, *speeds)}')

    def _controllers(self, sim: Simulation, robot: Robot, bring_up: BringUp) -> None:
        self.found.controllers = bring_up.findings
        bring_up.run()
        self._enter('motion')
        for active in _in_turn(bring_up):
            if not active[-1].claimed:
                self._publishers.add(active[-1].name)
            self._move(sim, robot, active)
            self._keep(self.found)
        for each in bring_up.findings:
            if each.state != 'active':
                self._fault(f'{each.name} ({each.type}) is {each.state}: {one_line(each.reason)}')
        for motion in self.found.motions:
            if motion.is_fine:
                continue
            motion.said = '; '.join(explanations(motion, logged(sim.log)))
            text = f'{describe(motion)}; {cause_of(motion)}'
            if motion.said:
                self.found.explained.append(f'{text}: {motion.said}')
            else:
                self._fault(text)

    def _move(self, sim: Simulation, robot: Robot, active: list[Active]) -> None:
        """Move what can be moved of the active controllers, the last of them."""
        *_, controller = active
        if controller.is_chained:
            self.found.undriven.append(f'{controller.name} is commanded by another controller')
        elif is_moved(controller):
            joints = {each.name: each for each in robot.joints}
            try:
                with closing(JointStates(sim, active)) as states:
                    self.found.motions.append(Mover(sim, controller, joints, states).move())
            except LookupError as error:
                self.found.undriven.append(f'{controller.name}: {error}')
        elif controller.claimed:  # others only publish
            try:
                with closing(DriveTrial(sim, controller)) as drive:
                    self.found.motions += drive.try_all()
            except LookupError as error:
                self.found.undriven.append(f'{error}')

    def _miss_motions(self, text: str) -> None:
        """A robot that says how it is moved, and was not moved at all, is not fine."""
        if self.found.motions:
            return
        drive = _DRIVE_PLUGIN.search(text)
        listed = [
            each
            for each in self.found.controllers
            if each.name not in self._publishers and 'roadcaster' not in each.type
        ]
        if drive or listed:
            what = f'its {drive[1]}' if drive else 'its <ros2_control>'
            why = '; '.join(self.found.undriven) or 'no active controller is one that moves'
            self._fault(f'nothing has moved by {what}: {why}')

    # --- keeping -------------------------------------------------------------------------------

    def _enter(self, stage: str) -> None:
        self.found.stage = stage
        self._keep(self.found)

    def _fault(self, text: str) -> None:
        self.found.faults.append(text)

    def _warn(self, line: str) -> None:
        self.found.warnings.append(f'WARN: {one_line(line)}')


def unrest(rest: RestResult, linear: float, angular: float) -> str:
    """Return how a robot does not rest; its speeds at the end are in m/s and rad/s."""
    what = (
        f'it still moves after {REST_WITHIN:g} s: {linear:.3f} m/s, {angular:.3f} rad/s at the end'
    )
    if rest.tilt < _TIPPED:
        return what
    return (
        f'{what}; it has tipped over, by {math.degrees(rest.tilt):.0f}°, as what is made to be '
        'bolted down does (fixed:=true)'
    )


def _in_turn(bring_up: BringUp) -> Iterator[list[Active]]:
    """Yield the active controllers, each time with another one as the last: all get a turn."""
    active = bring_up.active()
    for each in active:
        yield [*(other for other in active if other != each), each]
    for each in bring_up.turns():
        yield [*(other for other in bring_up.active() if other.name != each.name), each]


def describe(motion: MotionResult) -> str:
    """Return a motion that is not as it should be, in one line."""

    def number(value: float | None) -> str:
        return '?' if value is None else f'{value:.3f}'

    odometry = '' if motion.odometry is None else f', odometry {number(motion.odometry)}'
    line = f'{motion.controller}: {motion.what} {motion.asked:.3f}: truth {number(motion.truth)}'
    return f'{line}{odometry}' + (f' ({motion.note})' if motion.note else '')


def cause_of(motion: MotionResult) -> str:
    """Return what truth and odometry of a motion that is not as it should be have in common."""
    asked, truth, odometry = motion.asked, motion.truth, motion.odometry
    if truth is None or not asked:
        return 'not measured'
    if abs(truth + asked) <= TOLERANCE * asked:
        return 'the other way: wheels are swapped, or an axis is upside down'
    if odometry is None:
        return 'no odometry to compare with'
    if abs(odometry - asked) > TOLERANCE * asked:
        return 'by its odometry, too: a limit, or a wrong radius or separation'
    return 'not by its odometry: wheels slip, or roll otherwise than the parameters say'


def explanations(motion: MotionResult, logged_lines: Sequence[str]) -> list[str]:
    """
    Return what was said of the controller of a motion, or of slip, that explains why it is off.

    What turns a robot the other way does not keep it from going straight on.
    """
    named = re.compile(rf'(?<![\w/]){re.escape(motion.controller)}: ')
    return [
        line
        for line in logged_lines
        if line.startswith('WARN')
        and (named.search(line) or _OF_SLIP.search(line))
        and (motion.what == 'turn' or not _OF_TURNS.search(line))
    ]


def without_path(found: TrialFindings, path: str) -> TrialFindings:
    """Return findings whose texts do not name a folder that is gone with the trial."""
    return from_json(to_json([found]).replace(path, ''))


def check_of(code: int, out: str, err: str) -> Check:
    """Return what ``check_urdf --json`` says, by its exit code and output."""
    if 'Traceback (most recent call last)' in err or code not in (0, 1, 255):
        return Check(code, failure=f'exit code {code}: {(err.strip() or "?").splitlines()[-1]}')
    try:
        said = json.loads(out)
    except ValueError:
        return Check(code, failure=f'exit code {code}, and no JSON: {out[:80]!r}')
    if error := said.get('error'):
        return Check(code, errors=[one_line(error)])
    texts: dict[str, list[str]] = {'error': [], 'warning': []}
    for each in said['findings']:
        text = ', '.join(f'{each[key]}' for key in ('what', 'found', 'expected') if each.get(key))
        texts.setdefault(each['severity'], []).append(one_line(f'{each["line"]}: {text}'))
    return Check(code, texts['error'], texts['warning'])


def main(arguments: Sequence[str]) -> int:
    """Try the robot of a job; the exit code is 0 whatever is found."""
    job_file, result = map(Path, arguments)
    fields = json.loads(job_file.read_text(encoding='utf-8'))
    pairs = tuple((old, new) for old, new in fields.pop('replacements'))
    job = Job(**fields | {'controllers': tuple(fields['controllers'])}, replacements=pairs)

    def keep(found: TrialFindings) -> None:
        part = result.with_suffix('.part')
        part.write_text(to_json([found]), encoding='utf-8')
        os.replace(part, result)  # whoever reads it finds a whole one

    Trial(job, keep).run()
    return 0


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
