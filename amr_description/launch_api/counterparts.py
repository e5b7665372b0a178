# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Packages that are not installed, and what takes their place: as ``ros2 run`` does, and for Gazebo.

A package that is known here, but not installed, has a share folder where nothing is: launch files
of it may be included if there is one of ours in its place (``gazebo_files.py``).
"""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import ament_index_python
from ament_index_python import get_package_prefix
import ament_index_python.packages
from ament_index_python.packages import PackageNotFoundError

from amr_description.ament_index import is_installed, own_share, stands_in
from amr_description.errors import BringupError
from amr_description.launch_api.locations import at, caller, refusal
from amr_description.stand_ins import INSTEAD_OF_PACKAGES, STAND_INS

_FOLDER = 'not_installed'
_NEEDED = ('gazebo_ros', 'ros_gz_sim')
"""Of these packages what is not known is refused: without the simulator there is no robot."""
_ON_THE_PAGE = {
    ('gazebo_ros', 'gzclient'): '',
    ('joint_state_publisher_gui', 'joint_state_publisher_gui'): 'joint_state_publisher',
    ('rviz2', 'rviz2'): '',
}
"""(package, executable) -> our executable beside the page; '': the page alone."""
_KNOWN = {
    *INSTEAD_OF_PACKAGES,
    *(package for package, _ in (*STAND_INS, *_ON_THE_PAGE)),
    'gz_ros2_control',
    'rviz_common',
}
_OPTIONS_OF_SPAWN_ENTITY = {
    '-entity': '-name',
    '-topic': '-topic',
    '-file': '-file',
    '-robot_namespace': '-robot_namespace',
    **{f'-{axis}': f'-{axis}' for axis in 'xyzRPY'},
}
_HARMLESS = ('-b', '-package_to_model', '-spawn_service_timeout', '-timeout', '-unpause')
"""Without these the robot is spawned all the same."""
_FLAGS = ('-b', '-h', '-package_to_model', '-stdin', '-unpause')
"""Options of spawn_entity.py without a value."""


class PackageMissing(BringupError, PackageNotFoundError):  # noqa: N818 - as its base
    """A package is not installed, and nothing is in its place."""

    def __str__(self) -> str:
        """Return the text; a KeyError would put it in quotes."""
        return str(self.args[0])


@dataclass(frozen=True)
class Counterpart:
    """What is started in place of an executable."""

    executable: str = ''
    """One of ours; '': none."""
    has_page: bool = False
    """Whether the page of the viewer takes its place."""
    why: str = ''
    """Why nothing is started."""


def counterpart_of(package: str, executable: str) -> Counterpart | None:
    """Return what takes the place of an executable; None: its package is needed."""
    pair = (package, executable)
    if is_installed(package):
        return None
    if pair in _ON_THE_PAGE:
        return Counterpart(_ON_THE_PAGE[pair], has_page=True)
    if pair == ('gazebo_ros', 'spawn_entity.py'):
        return Counterpart('create')
    if pair in STAND_INS:
        return Counterpart(STAND_INS[pair])
    why = why_left_out(package)
    return Counterpart(why=why) if why else None


def arguments_as_ours(executable: str, arguments: Sequence[str]) -> tuple[list[str], list[str]]:
    """Return the arguments of an executable as our counterpart takes them, and what it lacks."""
    if executable == 'create':
        return ['-name' if word == '-entity' else word for word in arguments], []
    if executable != 'spawn_entity.py':
        return list(arguments), []
    taken: list[str] = []
    lacking: list[str] = []
    rest = [*arguments]
    while rest:
        option = rest.pop(0)
        if option == '--ros-args':
            return [*taken, option, *rest], lacking
        words = [] if option in _FLAGS else rest[:1]
        del rest[: len(words)]
        if option in _OPTIONS_OF_SPAWN_ENTITY:
            taken += [_OPTIONS_OF_SPAWN_ENTITY[option], *words]
        elif option not in _HARMLESS and (option, words) != ('-reference_frame', ['world']):
            lacking.append(' '.join([option, *words]))
    return taken, lacking


def require_package(package: str) -> None:
    """Raise BringupError unless a package is installed."""
    if not is_installed(package):
        raise missing(package)


def missing(package: str) -> PackageMissing:
    """Return the error about a package that is not installed."""
    instead = INSTEAD_OF_PACKAGES.get(package)
    ours = sorted(name for owner, name in STAND_INS if owner == package)
    if ours:
        return PackageMissing(f"package '{package}' not found; of it there are here: {ours}")
    why = f': {instead}' if instead else '; build it and source its workspace first'
    return PackageMissing(f"package '{package}' not found{why}")


def share_of(package: str) -> str:
    """Return the share folder of a package, as ament_index_python does. Raises BringupError."""
    return str(Path(prefix_of(package), 'share', package))


def prefix_of(package: str) -> str:
    """
    Return the prefix of a package; that of a known one that is not installed is an empty folder.

    Raises BringupError: it is not installed, and not known.
    """
    try:
        prefix = str(get_package_prefix(package))
    except (PackageNotFoundError, OSError, ValueError):
        prefix = None
    if prefix is not None and not (package in _KNOWN and stands_in(package, Path(prefix))):
        return prefix
    if package in _KNOWN:
        return str(own_share() / _FOLDER)
    raise missing(package)


def in_package(path: Path) -> tuple[str, str] | None:
    """Return (package, file) of a path in a package that is not installed; None: it is none."""
    root = own_share() / _FOLDER / 'share'
    if not path.is_relative_to(root):
        return None
    package, *below = path.relative_to(root).parts
    return package, '/'.join(below)


def why_left_out(package: str) -> str:
    """Return what to do without a package that stops no robot; '': it is needed, or known."""
    return '' if package in _NEEDED else INSTEAD_OF_PACKAGES.get(package, '')


def not_here(package: str, file: str, known: Sequence[str]) -> BringupError:
    """Return the error about a launch file of a package that is not installed."""
    if not known:
        return missing(package)
    return refusal(
        f"package '{package}' is not installed, and '{file}' of it has nothing in its place here; "
        f'there are {", ".join(known)}',
        '',
    )


@contextmanager
def folders_of_known_packages() -> Iterator[None]:
    """Have ament_index_python know the packages in whose place something is here."""
    folders = {
        'get_package_prefix': prefix_of,
        'get_package_share_directory': share_of,
    }
    modules = (ament_index_python, ament_index_python.packages)
    originals = {name: getattr(ament_index_python.packages, name) for name in folders}

    def replacing(name: str) -> Any:
        def find(package_name: str, **_kwargs: Any) -> str:
            try:
                return folders[name](package_name)
            except PackageMissing as error:
                raise at(error, caller()) from None

        return find

    for module in modules:
        for name in folders:
            setattr(module, name, replacing(name))
    try:
        yield
    finally:
        for module in modules:
            for name in folders:
                setattr(module, name, originals[name])
