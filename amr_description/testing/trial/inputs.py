# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What is tried: the descriptions of a folder, and the parameter file that belongs to each.

The parameter file of a robot is, in this order,

1. what the command line gives it: ``--controllers ROBOT=FILE``, or ``--controllers FILE`` for all,
   each more than once if there are several, one over the other;
2. the file of its name beside it: ``robot.yaml`` for ``robot.urdf``;
3. what the plugin in its ``<gazebo>`` block names: the simulator reads that by itself;
4. the one file in ``config/`` of a package that the description speaks of (its meshes, the name of
   its hardware plugin) that lists controllers, and those of no other robot's joints;
5. for a robot with ``<ros2_control>`` and none of these, parameters of this program's own: a
   joint_state_broadcaster, and a joint_trajectory_controller for its joints with a position
   command.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
import os
from pathlib import Path
import re

import yaml

from amr_description.ament_index import packages, parameter_path
from amr_description.errors import AmrError, UsageError
from amr_description.model.gazebo.plugins import plugins_of
from amr_description.model.xml_reader import parse_xml
from amr_description.parameter_files import KEY, read_parameter_file, sections

_PREFIX_PATH = 'AMENT_PREFIX_PATH'
SUFFIXES = ('.urdf', '.xacro')
DESCRIPTION = 'the description'
_INDEX = Path('share/ament_index/resource_index/packages')
_ROOT = re.compile(r'<robot\b[^>]*\bname\s*=')
_PARAMETERS = re.compile(r'<parameters>([^<]+)</parameters>')
_PACKAGES = (
    re.compile(r'package://([\w-]+)'),
    re.compile(r'\$\(find ([\w-]+)\)'),
    re.compile(r'<plugin>\s*([\w-]+)(?:/|::)'),
)
_JOINT = re.compile(r'<joint\s+name="([^"]+)"\s*>(.*?)</joint>', re.DOTALL)
_NAMED_JOINT = re.compile(r'<joint\s[^>]*?\bname="([^"]+)"')
_LISTED_JOINTS = re.compile(
    r'^\s*\w*(?:joints?|(?:wheels?|joints?|dof)_names?)\s*:((?:[^\n]*\n)(?:\s*-[^\n]*\n)*)',
    re.MULTILINE,
)
"""The values of parameters that name joints."""
_BLOCK = re.compile(r'<ros2_control\b.*?</ros2_control>', re.DOTALL)
_JOINT_PLUGINS = re.compile(
    r'joint.?(?:pose.?)?trajectory|joint.?(?:position.?|velocity.?)?controller', re.IGNORECASE
)
_DRIVES = re.compile(
    r'drive|steering|ackerman|planar.?move|force.?based.?move|velocity.?control', re.IGNORECASE
)
"""Of kind, library or name of a plugin that moves joints, or the robot as a whole."""
_POSITION = re.compile(r'<command_interface\s+name="position"')


@dataclass(frozen=True)
class TrialParameters:
    """Parameter files of a robot."""

    files: tuple[Path, ...]
    by: str
    """How they were found."""

    @property
    def told(self) -> Sequence[Path] | None:
        """Those that the simulator is told; None: it finds them by itself."""
        return None if self.by == DESCRIPTION or not self.files else self.files


def descriptions(paths: Iterable[Path]) -> list[Path]:
    """
    Return the description files of files and folders, in order.

    Of a folder those directly in it that hold a ``<robot name=…>``: files of macros do not.

    Raises:
        UsageError: a path is not there, or a folder holds none.
    """
    found: list[Path] = []
    for path in paths:
        if path.is_file():
            found.append(path)
            continue
        if not path.is_dir():
            raise UsageError(f"'{path}' is not there; name description files, or their folder")
        inside = [each for each in sorted(path.iterdir()) if each.name.endswith(SUFFIXES)]
        named = [each for each in inside if _ROOT.search(_text(each))]
        if not named:
            raise UsageError(f"'{path}' holds no robot description (*.urdf, *.xacro)")
        found += named
    return list(dict.fromkeys(found))


def robot_names(files: Sequence[Path]) -> list[str]:
    """Return a short name for each file; its whole path where that would stand for two."""
    short = [each.name.removesuffix('.xacro').removesuffix('.urdf') for each in files]
    return [
        name if short.count(name) == 1 else str(file)
        for name, file in zip(short, files, strict=True)
    ]


def prefixes(paths: Iterable[Path]) -> list[Path]:
    """Return the folders that are install prefixes: those with packages of their own."""
    folders = (path if path.is_dir() else path.parent for path in paths)
    return [each.resolve() for each in dict.fromkeys(folders) if (each / _INDEX).is_dir()]


def offer_prefixes(own: Iterable[Path], *, last: bool = False) -> None:
    """Have this program, and those that it starts, find packages of install prefixes: first."""
    before = [each for each in os.environ.get(_PREFIX_PATH, '').split(os.pathsep) if each]
    new = [str(each.resolve()) for each in own]
    os.environ[_PREFIX_PATH] = os.pathsep.join([*before, *new] if last else [*new, *before])


def replaced_copy(file: Path, folder: Path, replacements: Mapping[str, str]) -> Path:
    """
    Return a description with texts replaced, in an empty folder; itself if there are none.

    Beside it are links to all that is beside the original, which relative paths may mean.
    """
    text = _text(file)
    changed = text
    for old, new in replacements.items():
        changed = changed.replace(old, new)
    if changed == text:
        return file
    for beside in file.parent.absolute().iterdir():
        if beside.name != file.name:
            (folder / beside.name).symlink_to(beside)
    copy = folder / file.name
    copy.write_text(changed, encoding='utf-8')
    return copy


def parameters_of(
    file: Path, text: str, robot: str, folder: Path, given: Sequence[str] = ()
) -> TrialParameters:
    """
    Return the parameter files of a robot.

    Args:
        file: Its description.
        text: The URDF of that, expanded and with texts replaced.
        robot: Its name in the table.
        folder: For a file of this program's own.
        given: ``--controllers``: ``FILE`` or ``ROBOT=FILE``.

    Raises:
        UsageError: a file that is given is not there.
    """
    if files := _given(robot, given):
        return TrialParameters(files, 'the command line')
    own = file.with_name(f'{Path(robot).name}.yaml')
    if own.is_file():
        return TrialParameters((own.absolute(),), 'the name of the description')
    if named := dict.fromkeys(_PARAMETERS.findall(text)):
        paths = (parameter_path(each.strip(), file.parent) for each in named)
        return TrialParameters(tuple(paths), DESCRIPTION)
    for package in _packages(text):
        listing = [
            each
            for each in sorted((package / 'config').glob('*.yaml'))
            if lists_controllers(each) and not _is_of_another(each, text)
        ]
        if len(listing) == 1:
            return TrialParameters((listing[0],), f'package {package.name}')
    joints = position_joints(text)
    if not _BLOCK.search(text):
        return TrialParameters((), 'nothing')
    path = folder / 'controllers.yaml'
    path.write_text(_own_parameters(joints), encoding='utf-8')
    return TrialParameters((path,), 'this program')


def _is_of_another(file: Path, text: str) -> bool:
    """Return whether a parameter file lists joints, and none of them is of a robot (its URDF)."""
    listed = _LISTED_JOINTS.findall(_text(file))
    words = {word for each in listed for word in re.findall(r'[\w.-]+', each)}
    return bool(words) and words.isdisjoint(_NAMED_JOINT.findall(text))


def _given(robot: str, given: Sequence[str]) -> tuple[Path, ...]:
    pairs = [each.partition('=') for each in given]
    files = [Path(file) for name, separator, file in pairs if separator and name == robot]
    files = files or [Path(name) for name, separator, _ in pairs if not separator]
    for file in files:
        if not file.is_file():
            raise UsageError(f"parameter file '{file}' of {robot} is not there")
    return tuple(file.absolute() for file in files)


def _packages(text: str) -> list[Path]:
    """Return the share folders of the packages that a description speaks of, in order."""
    shares = {name: prefix / 'share' / name for name, prefix in packages().items()}
    names = [name for pattern in _PACKAGES for name in pattern.findall(text)]
    by_path = [name for name, share in shares.items() if f'{share}/' in text]
    return [shares[name] for name in dict.fromkeys([*names, *by_path]) if name in shares]


def lists_controllers(path: Path) -> bool:
    """Return whether a parameter file has a type for a controller."""
    try:
        found = [*sections(read_parameter_file(path))]
    except AmrError:
        return False
    return bool(self_typed([path])) or any(
        isinstance(value, dict) and 'type' in value
        for section in found
        for value in section.parameters.values()
    )


def self_typed(files: Iterable[Path]) -> dict[str, Path]:
    """
    Return the controllers whose type stands in their own section, with their file.

    A manager does not know these: ``spawner NAME --param-file FILE`` tells it.
    """
    return {
        section.pattern.rpartition('/')[2]: file
        for file in files
        for section in sections(read_parameter_file(file))
        if isinstance(section.parameters, dict) and '/' in str(section.parameters.get('type', ''))
    }


@dataclass(frozen=True)
class DeclaredDrives:
    """What a description says that moves the robot."""

    plugins: tuple[str, ...]
    """Plugins of Gazebo that drive it, by their names or libraries, simulated or not."""
    joint_plugins: tuple[str, ...]
    """Those that move joints of it."""
    is_controlled: bool
    """Whether it has ``<ros2_control>``."""
    has_commands: bool
    """Whether that commands something."""

    @property
    def is_any(self) -> bool:
        """Whether it says anything."""
        return bool(self.plugins or self.joint_plugins) or self.has_commands


def declared_drives(text: str) -> DeclaredDrives:
    """Return what a URDF says that moves the robot; what is in comments does not count."""
    xml = parse_xml(text, DESCRIPTION, lambda fault: None)
    if xml is None:
        return DeclaredDrives((), (), is_controlled=False, has_commands=False)
    found: dict[bool, list[str]] = {False: [], True: []}
    for each in plugins_of(xml, []):
        words = f'{each.kind} {each.library} {each.name}'
        moves_joints = _JOINT_PLUGINS.search(words) is not None
        if (moves_joints or _DRIVES.search(words)) and not each.is_world_matter:
            found[moves_joints].append(each.name or each.library)
    blocks = xml.findall('ros2_control')
    has_commands = any(each.find('.//command_interface') is not None for each in blocks)
    drives, joints = (tuple(dict.fromkeys(found[each])) for each in (False, True))
    return DeclaredDrives(drives, joints, bool(blocks), has_commands)


def position_joints(text: str) -> list[str]:
    """Return the joints of ``<ros2_control>`` blocks with a position command interface."""
    blocks = ''.join(_BLOCK.findall(text))
    return [name for name, body in _JOINT.findall(blocks) if _POSITION.search(body)]


def _own_parameters(joints: Sequence[str]) -> str:
    manager: dict[str, object] = {
        'update_rate': 100,
        'joint_state_broadcaster': {'type': 'joint_state_broadcaster/JointStateBroadcaster'},
    }
    content: dict[str, object] = {'/**/controller_manager': {KEY: manager}}
    if joints:
        name = 'trial_trajectory_controller'
        manager[name] = {'type': 'joint_trajectory_controller/JointTrajectoryController'}
        content[f'/**/{name}'] = {
            KEY: {
                'joints': list(joints),
                'command_interfaces': ['position'],
                'state_interfaces': ['position'],
            }
        }
    return yaml.safe_dump(content, sort_keys=False)


def _text(path: Path) -> str:
    try:
        return path.read_text(encoding='utf-8', errors='replace')
    except OSError as error:
        raise UsageError(f"'{path}': {error.strerror}") from error
