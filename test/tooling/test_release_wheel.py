# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The wheels of this package: nothing that colcon installs is missing, and they work where they lie.

Unpacked as pip does over links to the packages of ``.venv``, which costs a second; installed by
pip in an environment of its own: test/system/docs/test_docs_pip.py.
"""

from configparser import ConfigParser
import email
import os
from pathlib import Path
import subprocess
import sys
import sysconfig

from ament_index_python.packages import get_package_prefix
from environment import launchers
from environment.locks import pinned_versions
import pytest
from releasing import archives, package_wheel
from support.needs import need_program
from support.paths import PROJECT, ROOT
from support.running_programs import Program

NAME = 'amr_description'
pytestmark = pytest.mark.skipif(Path(sys.prefix) != ROOT / '.venv', reason='needs .venv')
SITE = str(Path(sysconfig.get_path('purelib')).relative_to(sys.prefix))
DATA = f'{NAME}-{{}}.data/data'
# What colcon writes for itself, of no use to pip.
OF_COLCON = (
    'share/colcon-core',
    f'share/{NAME}/hook',
    f'share/{NAME}/package.',
    SITE.rpartition('/')[0],
)


@pytest.fixture(scope='module')
def wheels(tmp_path_factory):
    """The files of the wheels without ROS and of ROS, by their paths in them."""
    need_program('git', 'git')
    folder = tmp_path_factory.mktemp('release')
    built = package_wheel.build(ROOT, ROOT / '.venv', folder, 1700000000, os.environ)
    assert [path.name.partition('-')[0] for path in built] == [NAME, f'{NAME}_ros']
    return [archives.read(path) for path in built]


@pytest.fixture(scope='module')
def members(wheels):
    """Their files by their paths once they are installed."""
    return {name: member for each in wheels for name, member in installed(each).items()}


def installed(wheel):
    """The files of a wheel by their paths once it is installed."""
    base = archives.dist_info(wheel).removesuffix('.dist-info')
    places = {f'{base}.data/data/': '', f'{base}.data/scripts/': 'bin/'}

    def place(name):
        for beginning, folder in places.items():
            if name.startswith(beginning):
                return folder + name.removeprefix(beginning)
        return f'{SITE}/{name}'

    return {place(name): member for name, member in wheel.items()}


def entry_points_of(wheel):
    parser = ConfigParser(delimiters=('=',))
    text = wheel[f'{archives.dist_info(wheel)}/entry_points.txt'].content.decode()
    parser.read_string(text)
    return parser


def test_without_ros_nothing_of_it_is_there(wheels):
    """Neither its commands, nor modules under its names, nor what pytest and colcon load."""
    own, _ = wheels
    tops = {name.split('/')[0] for name in installed(own)}
    assert tops == {'lib', 'share'}  # of the environment; amr is made by who installs
    modules = {name.split('/')[0] for name in own if not name.startswith(f'{NAME}-')}
    assert modules == {NAME}
    entry_points = entry_points_of(own)
    assert entry_points.sections() == ['amr_description.executables', 'console_scripts']
    assert dict(entry_points['console_scripts']) == dict(PROJECT['scripts']) != {}


def test_the_one_of_ros_requires_what_is_locked(wheels):
    own, of_ros = (
        email.message_from_bytes(each[f'{archives.dist_info(each)}/METADATA'].content)
        for each in wheels
    )
    version = own['Version']
    assert f"amr-description-ros =={version} ; extra == 'ros'" in own.get_all('Requires-Dist')
    required = of_ros.get_all('Requires-Dist')
    assert required[:2] == [
        f'amr-description=={version}', f'amr-description-interfaces=={version}'
    ]  # fmt: skip
    locked = pinned_versions((ROOT / 'scripts/requirements.lock').read_text())
    pins = dict(each.split('==') for each in required[2:])
    assert pins.items() <= locked.items()
    assert {name for name in locked if name.startswith('ros-')} < pins.keys()
    assert own['Requires-Python'] == of_ros['Requires-Python']


def test_all_that_colcon_installs_is_in_it(members):
    prefix = Path(get_package_prefix(NAME))
    installed = {
        str(path.relative_to(prefix)): path for path in prefix.rglob('*') if path.is_file()
    }
    wanted = {name for name in installed if not name.startswith(OF_COLCON)}
    wanted |= {f'share/{NAME}/package.xml', f'share/{NAME}/pyproject.toml'}
    assert wanted - {*members} == set()
    for name in wanted:
        if name.startswith('share/'):
            assert members[name].content == installed[name].read_bytes()
        else:
            assert members[name].executable


def test_all_modules_are_in_it_and_nothing_else(members):
    git = ['git', '-C', ROOT, 'ls-files', '--cached', '--others', '--exclude-standard', NAME]
    listed = subprocess.run(git, capture_output=True, text=True, check=True).stdout.splitlines()
    here = {name for name in listed if (ROOT / name).is_file()}
    assert any('viewer/static/' in name for name in here)
    found = {name.removeprefix(f'{SITE}/') for name in members}
    assert {name for name in found if name.startswith(f'{NAME}/')} == here
    for name in here:
        assert members[f'{SITE}/{name}'].content == (ROOT / name).read_bytes()


def test_all_that_setup_writes_into_an_environment_is_in_it(wheels, members, tmp_path):
    venv = tmp_path / '.venv'
    written = launchers.files(venv, venv, launchers.Checkout(ROOT))
    wanted = {
        str(path.relative_to(venv)) for path in written if '.dist-info' not in path.parts[-2]
    }
    of_a_checkout = {f'{SITE}/{NAME}.pth', str(launchers.HOME)}
    assert wanted - of_a_checkout - {*members} == set()
    assert all(members[f'bin/{name}'].executable for name in (*launchers.COMMANDS, 'bringup'))
    parser = entry_points_of(wheels[1])
    assert 'ament_copyright' in parser['pytest11']
    assert 'amr_description' in parser['colcon_core.package_selection']


@pytest.fixture
def prefix(members, tmp_path):
    """An environment as pip would make it, in a folder with a space."""
    folder = tmp_path / 'my ros'
    theirs = ROOT / '.venv'
    for name in (SITE, 'bin', 'share/ament_index/resource_index/packages'):
        (folder / name).mkdir(parents=True)
    (folder / 'pyvenv.cfg').write_text((theirs / 'pyvenv.cfg').read_text())
    (folder / 'bin/python').symlink_to(theirs.joinpath('bin/python').resolve())
    ours = {name.split('/')[3] for name in members if name.startswith(SITE)}
    for path in (theirs / SITE).iterdir():
        if path.name not in ours and not path.name.startswith((NAME + '.', 'ament_copyright')):
            (folder / SITE / path.name).symlink_to(path)
    for path in (theirs / 'lib').glob('*.so*'):
        (folder / 'lib' / path.name).symlink_to(path)
    for name, member in members.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(member.content)
        (folder / name).chmod(0o755 if member.executable else 0o644)
    return folder


def fresh(home):
    """The variables of a shell that has sourced nothing."""
    return {
        'PATH': '/usr/bin:/bin',
        'HOME': str(home),
        'ROS_DOMAIN_ID': os.environ['ROS_DOMAIN_ID'],
    }


def test_commands_need_nothing_sourced_and_start_its_executables(prefix, tmp_path):
    (tmp_path / 'ros2').symlink_to(prefix / 'bin/ros2')
    clean = ['env', '-i', *(f'{name}={value}' for name, value in fresh(tmp_path).items())]
    with Program(*clean, tmp_path / 'ros2', 'run', NAME, 'talker') as talker:
        talker.expect(r'\[minimal_publisher\]: Publishing: "Hello World: 0"')


COMPLETION = """
source "$1/setup.bash"
_python_argcomplete_at_first_tab || echo $?
complete -p ros2
"""


def test_its_setup_file_completes_at_the_first_tab(prefix, tmp_path):
    done = subprocess.run(
        ['bash', '--norc', '-i', '-c', COMPLETION, 'bash', prefix],
        env=fresh(tmp_path),
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        start_new_session=True,
    )
    looks_again, complete = done.stdout.splitlines()
    assert looks_again == '124', done.stderr
    assert complete.endswith(' -F _python_argcomplete ros2')


SHELL = """
source "$1/setup.bash"
printf '%s|' "$ROS_DISTRO" "$AMENT_PREFIX_PATH" "$(command -v ros2)"
printf '%s|' "${_amr_prefix-}" "${_amr_root-}"
python -c 'import tf2_ros, amr_description; print(tf2_ros.Buffer.__module__)'
"$1/lib/amr_description/bringup" --help | head -n 1
cd "$1/lib" && amr_description/xacro --help | head -n 1
"$CMAKE_COMMAND" --version | head -n 1
"""


def test_its_setup_file_makes_it_an_underlay(prefix, tmp_path):
    done = subprocess.run(
        ['bash', '-c', SHELL, 'bash', prefix], env=fresh(tmp_path), capture_output=True, text=True
    )
    first, *usages, cmake = done.stdout.splitlines()
    expected = f'jazzy|{prefix}|{prefix}/bin/ros2|||amr_description.tf2_ros.buffer'
    assert (done.stderr, first) == ('', expected)
    assert [line.split()[0].lower() for line in usages] == ['usage:', 'usage:']
    assert cmake.startswith('cmake version 3.28.')
    # As the setup.sh of a workspace does it, for any shell.
    command = 'COLCON_CURRENT_PREFIX=$1 . "$1/local_setup.sh"; command -v ros2'
    other = subprocess.run(
        ['sh', '-c', command, 'sh', prefix], env=fresh(tmp_path), capture_output=True, text=True
    )
    assert (other.stderr, other.stdout) == ('', f'{prefix}/bin/ros2\n')
