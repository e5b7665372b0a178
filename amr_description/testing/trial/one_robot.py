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
import os
from pathlib import Path
import shlex
import subprocess
import sys
import tempfile
import time
import warnings

from amr_description.errors import AmrError
from amr_description.model.gazebo.translation import translate
from amr_description.model.robot import JointType, Robot
from amr_description.model.urdf import parse
from amr_description.simulation.given import GivenDescription
from amr_description.testing.simulation import Simulation
from amr_description.testing.trial.bring_up import Active, BringUp, find_manager, logged
from amr_description.testing.trial.driving import DriveTrial
from amr_description.testing.trial.findings import (
    Check,
    from_json,
    MotionResult,
    to_json,
    TrialFindings,
)
from amr_description.testing.trial.inputs import (
    declared_drives,
    DeclaredDrives,
    parameters_of,
    replaced_copy,
    self_typed,
    TrialParameters,
)
from amr_description.testing.trial.moving import is_moved, JointStates, Mover
from amr_description.testing.trial.parts import split
from amr_description.testing.trial.posture import Posture, spreading_joints, stands_on_legs
from amr_description.testing.trial.verdict import cause_of, describe, explanations
from amr_description.text import one_line, quote_all

_PLANAR = 'GazeboPlanarMove'


@dataclass(frozen=True)
class Job:
    """What is asked of a process."""

    robot: str
    file: str
    controllers: tuple[str, ...] = ()
    replacements: tuple[tuple[str, str], ...] = ()
    xacro_args: str = ''
    is_fixed: bool = False
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
            given_description = GivenDescription(
                str(file.absolute()), self._job.xacro_args, self._job.is_fixed
            )
            text = given_description.text(self._warn)
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
                [*command, str(file), *shlex.split(self._job.xacro_args)],
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
        declared = declared_drives(text)
        self.found.has_drive = declared.is_any
        self._enter('spawn')
        begin = time.monotonic()
        sim = Simulation(
            file.absolute(),
            given.told,
            activate=[],
            xacro_args=self._job.xacro_args,
            fixed=self._job.is_fixed,
        )
        try:
            with sim:
                self.found.spawn_seconds = time.monotonic() - begin
                self._enter('rest')
                posture = self._rest(sim, parse(text))
                self._enter('controllers')
                manager = find_manager(sim, is_promised=declared.is_controlled)
                if manager is None:
                    self.found.undriven.append('there is no controller manager')
                else:
                    bring_up = BringUp(sim, manager, self_typed(given.files), given.files)
                    self._controllers(sim, parse(text), bring_up, posture)
                self._miss_motions(declared)
                self._enter('end')
        finally:
            self._read_log(sim)

    def _read_log(self, sim: Simulation) -> None:
        try:
            self.found.warnings += logged(sim.log)
        except AttributeError:  # it was never started
            return

    def _rest(self, sim: Simulation, robot: Robot) -> Posture:
        rolls = any(joint.type is JointType.CONTINUOUS for joint in robot.joints)
        posture = Posture(sim, rolls=rolls)
        self.found.rest, faults = posture.rest()
        self.found.posture += [f'at rest {each}' for each in faults]
        return posture

    def _controllers(
        self, sim: Simulation, robot: Robot, bring_up: BringUp, posture: Posture
    ) -> None:
        self.found.controllers = bring_up.findings
        bring_up.run()
        self._enter('motion')
        moved: set[str] = set()
        for active in _in_turn(bring_up):
            if not active[-1].claimed:
                self._publishers.add(active[-1].name)
            count = len(self.found.motions)
            self._move(sim, robot, active)
            if len(self.found.motions) > count:
                moved |= {part for each in active[-1].claimed for part in each.split('/')}
            self._look(posture, self.found.motions[count:])
            self._keep(self.found)
        joints = [each.name for each in robot.joints if each.has_position]
        lacking, spare = split(bring_up.findings, joints, moved)
        for each in lacking:
            self._fault(f'{each.name} ({each.type}) is {each.state}: {one_line(each.reason)}')
        self.found.spare = [f'{each.name} ({each.type}): {each.without}' for each in spare]
        for motion in self.found.motions:
            if motion.is_fine:
                continue
            motion.said = '; '.join(explanations(motion, logged(sim.log)))
            if motion.said:
                self.found.explained.append(f'{describe(motion)}: {motion.said}')
            else:
                self._fault(f'{describe(motion)}; {cause_of(motion)}')

    def _look(self, posture: Posture, motions: Sequence[MotionResult]) -> None:
        """Say how the robot is there after motions, unless that was said before."""
        if motions and not self.found.posture:
            after = f'after {motions[-1].controller}: {motions[-1].what}'
            self.found.posture += [f'{after} {each}' for each in posture.faults()]

    def _move(self, sim: Simulation, robot: Robot, active: list[Active]) -> None:
        """Move what can be moved of the active controllers, the last of them."""
        *_, controller = active
        if controller.is_chained:
            self.found.undriven.append(f'{controller.name} is commanded by another controller')
        elif is_moved(controller):
            joints = {each.name: each for each in robot.joints}
            try:
                with closing(JointStates(sim, active)) as states:
                    on_legs, held = stands_on_legs(robot), spreading_joints(robot)
                    mover = Mover(sim, controller, joints, states, on_legs=on_legs, held=held)
                    self.found.motions.append(mover.move())
            except LookupError as error:
                self.found.undriven.append(f'{controller.name}: {error}')
        elif plugin := mover_of_body(active):
            self.found.undriven.append(
                f'{controller.name} turns wheels only: the body is moved by {plugin}'
            )
        elif controller.claimed:  # others only publish
            try:
                wheelbase = wheelbase_of(robot, controller.name)
                with closing(DriveTrial(sim, controller, active, wheelbase)) as drive:
                    self.found.motions += drive.try_all()
            except LookupError as error:
                self.found.undriven.append(f'{error}')

    def _miss_motions(self, declared: DeclaredDrives) -> None:
        """What says how it is moved, and was not moved at all, is not as it should be."""
        why = '; '.join(self.found.undriven) or 'no active controller is one that moves'
        has_driven = any(each.what in ('forward', 'turn') for each in self.found.motions)
        if declared.plugins and not has_driven:
            self._fault(f'nothing has driven by its {quote_all(declared.plugins)}: {why}')
        elif not self.found.motions and declared.joint_plugins:
            self._fault(f'nothing has moved by its {quote_all(declared.joint_plugins)}: {why}')
        elif not self.found.motions and declared.has_commands:
            listed = [each for each in self.found.controllers if each.name not in self._publishers]
            named = 'its controllers' if listed else 'its <ros2_control>, without controllers'
            self._fault(f'nothing has moved by {named}: {why}')
        elif not declared.is_any and not self.found.motions:
            self.found.undriven.insert(0, 'its description has nothing that drives it')

    # --- keeping -------------------------------------------------------------------------------

    def _enter(self, stage: str) -> None:
        self.found.stage = stage
        self._keep(self.found)

    def _fault(self, text: str) -> None:
        self.found.faults.append(text)

    def _warn(self, line: str) -> None:
        self.found.warnings.append(f'WARN: {one_line(line)}')


def _in_turn(bring_up: BringUp) -> Iterator[list[Active]]:
    """Yield the active controllers, each time with another one as the last: all get a turn."""
    active = bring_up.active()
    for each in active:
        yield [*(other for other in active if other != each), each]
    for each in bring_up.turns():
        yield [*(other for other in bring_up.active() if other.name != each.name), each]


def mover_of_body(active: Sequence[Active]) -> str:
    """
    Return the plugin that moves the body beside the last of some controllers; '': none does.

    It holds the body where it moves it not, as in Gazebo, so that wheels alone move nothing.
    """
    *others, last = active
    if not last.claimed or last.type.endswith(_PLANAR):
        return ''
    return next((each.name for each in others if each.type.endswith(_PLANAR)), '')


def wheelbase_of(robot: Robot, controller: str) -> float:
    """Return that of a car of Classic, m, whose twist has the angle of its tyres; 0: of others."""
    for each in translate(robot).controllers:
        if each.name == controller and each.parameters.get('angular_is_steering'):
            return float(each.parameters['wheelbase'])
    return 0.0


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
