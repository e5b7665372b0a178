# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What launch files may import, that nothing stays of it, --show-args, and the original."""

from pathlib import Path
import sys
from types import ModuleType, SimpleNamespace

import ament_index_python.packages
from fixtures.launch_files.packages import commands, first_in_the_index, install_package
import pytest

from amr_description.errors import BringupError
from amr_description.launch_api.launch_file import launch_by_the_original, LaunchFile
from amr_description.launch_api.modules import is_installed, provide, understood
from amr_description.launch_api.substitutions import is_a_substitution

BEGIN = 'def generate_launch_description():\n    '


@pytest.fixture
def launch(tmp_path):
    """A function: a launch file of this text."""
    install_package(tmp_path, 'toys', 'a')

    def made(text, name='my.launch.py'):
        (tmp_path / name).write_text(text)
        return LaunchFile(tmp_path / name)

    with first_in_the_index(tmp_path):
        yield made


@pytest.mark.parametrize(
    ('text', 'said'),
    [
        (
            f'from launch_ros.actions import SetRemaps\n{BEGIN}return SetRemaps()',
            'my.launch.py:3: launch_ros.actions.SetRemaps is not understood here; did you mean '
            r'SetRemap\?; understood are Node, ',
        ),
        (
            'from launch.actions import DeclareLaunchArgumnt as D\nD("x")',
            'my.launch.py:2: launch.actions.DeclareLaunchArgumnt is not understood here; did you '
            'mean DeclareLaunchArgument',
        ),
        (
            'from launch_ros.event_handlers import OnStateTransitions as O\nclass X(O): pass',
            'my.launch.py:2: launch_ros.event_handlers.OnStateTransitions is not understood here',
        ),
        ('import launch\nlaunch.frontend.Parser()', 'my.launch.py:2: launch.frontend.Parser is n'),
        ('from nav2_commons.launch import X', "No module named 'nav2_commons'.*line 1"),
        (
            'from ament_index_python.packages import get_package_share_directory as share\n\n'
            "share('nope')",
            "my.launch.py:3: package 'nope' not found; build it and source its workspace first",
        ),
        ('x = 1', 'does not contain the required function .generate_launch_description'),
        (f'{BEGIN}return None', 'returned NoneType, which is no LaunchDescription'),
        ('def broken(:', "my.launch.py' failed: SyntaxError: invalid syntax"),
    ],
)
def test_what_is_not_understood_is_told_before_anything_starts(launch, text, said):
    with pytest.raises(BringupError, match=said) as told:
        launch(text).stack({})
    assert '\n' not in str(told.value)


def test_a_name_that_is_not_used_may_be_imported(launch):
    stack = launch(
        'import launch, launch_ros.actions\n'
        'import launch_xml, launch_ros.descriptions, launch.logging\n'
        'from launch.some_substitutions_type import SomeSubstitutionsType\n'
        'from launch_ros.actions import LifecycleNode, ComposableNodeContainer as C, Node\n'
        'from launch.launch_description_sources import AnyLaunchDescriptionSource\n'
        'def helper(x: C | SomeSubstitutionsType, y: LifecycleNode): ...\n'
        "launch.logging.get_logger('x').debug('y')\n"
        f'{BEGIN}return launch.LaunchDescription([\n'
        "        launch_ros.actions.Node(package='toys', executable='a')])"
    ).stack({})
    assert [line for *_, line in commands(stack)] == ['a']


def test_a_name_may_come_from_the_module_that_defines_it(launch):
    stack = launch(
        'from launch.actions.declare_launch_argument import DeclareLaunchArgument\n'
        'from launch.actions.nothing import GroupAktion\n'
        'from launch.substitutions.launch_configuration import LaunchConfiguration\n'
        'from launch_ros.actions.load_composable_nodes import LoadComposableNodes\n'
        'import launch, launch_ros.actions.push_ros_namespace\n'
        'import launch_ros.actions as actions\n'
        f'{BEGIN}return launch.LaunchDescription([\n'
        "        DeclareLaunchArgument('name', default_value='a'),\n"
        "        actions.push_ros_namespace.PushRosNamespace('r1'),\n"
        "        actions.Node(package='toys', executable=LaunchConfiguration('name'))])"
    ).stack({})
    assert [line for *_, line in commands(stack)] == ['a --ros-args -r __ns:=/r1']


def test_what_the_module_that_defines_a_name_has_not_is_said(launch):
    with pytest.raises(
        BringupError, match=r'launch.actions.group_action.GroupAktion is not under'
    ):
        launch('from launch.actions.group_action import GroupAktion as G\nG()').stack({})


def test_a_package_that_may_be_missing(launch):
    """A file that looks first, as many do."""
    stack = launch(
        'from ament_index_python.packages import (\n'
        '    get_package_share_directory as share, PackageNotFoundError)\n'
        'from launch import LaunchDescription\nfrom launch_ros.actions import Node\n'
        "try:\n    share('nope')\nexcept PackageNotFoundError:\n    names = ['a']\n"
        f'{BEGIN}return LaunchDescription([\n'
        "        Node(package='toys', executable=name) for name in names])"
    ).stack({})
    assert len(stack.nodes) == 1


def test_nothing_stays_behind(launch):
    find = ament_index_python.packages.get_package_share_directory
    with pytest.raises(BringupError):
        launch('import launch.actions, launch_ros\n1 / 0').stack({})
    assert not {'launch', 'launch.actions', 'launch_ros'} & set(sys.modules)
    assert ament_index_python.packages.get_package_share_directory is find
    assert not is_installed()  # what scripts/setup has written in their place does not count


def test_modules_of_these_names_that_were_loaded_are_there_again(monkeypatch):
    monkeypatch.setitem(sys.modules, 'launch', before := object())
    with understood():
        import launch

        assert launch is not before
    assert sys.modules['launch'] is before


SHOWN = """\
Arguments (pass arguments as '<name>:=<value>'):

    'gui':
        Start gui. Valid choices are: ['true', 'false']
        (default: 'true')

    'world':
        no description given
        (default: FindPackageShare(pkg='toys') + '/' + LaunchConfig('gui'))

    'needed':
        One of: ['a', 'b']

    'late':*
        no description given
        (default: EnvVar('HOME'))

* argument(s) which are only used if specific conditions occur"""


def test_arguments_are_shown_as_the_original_does(launch):
    file = launch(
        f"""
from launch import LaunchDescription, LaunchDescriptionSource
from launch.actions import *
from launch.conditions import IfCondition
from launch.substitutions import *
from launch_ros.substitutions import FindPackageShare

{BEGIN}
    late = DeclareLaunchArgument('late', default_value=EnvironmentVariable('HOME'))
    inner = LaunchDescription([DeclareLaunchArgument('needed', choices=['a', 'b'])])
    return LaunchDescription([
        DeclareLaunchArgument('gui', default_value='true', description='Start gui.',
            choices=['true', 'false']),
        DeclareLaunchArgument('world',
            default_value=[FindPackageShare('toys'), '/', LaunchConfiguration('gui')]),
        IncludeLaunchDescription(LaunchDescriptionSource(inner)),
        IncludeLaunchDescription([LaunchConfiguration('unknown'), '/x.launch.py']),
        GroupAction([late], condition=IfCondition('true')),
        DeclareLaunchArgument('gui', default_value='twice'),
    ])
"""
    )
    assert file.show_arguments() == SHOWN
    assert launch(
        f'from launch import LaunchDescription\n{BEGIN}return LaunchDescription()'
    ).show_arguments() == ("Arguments (pass arguments as '<name>:=<value>'):\n\n  No arguments.")


def test_the_original_is_used_where_it_is_installed(tmp_path, monkeypatch):
    assert launch_by_the_original(tmp_path / 'my.launch.py', []) is None
    written = tmp_path / 'seen'
    sources = {
        'launch/__init__.py': f"""
class LaunchDescription(list): ...
class LaunchService:
    def __init__(self, argv): ...
    def include_launch_description(self, description):
        open({str(written)!r}, 'w').write(repr(description))
    def run(self): return 7
""",
        'launch/actions.py': 'def IncludeLaunchDescription(*a, **k): return a, k',
        'launch/launch_description_sources.py': 'AnyLaunchDescriptionSource = str',
        'launch_ros/__init__.py': '',
    }
    for name, text in sources.items():
        path = tmp_path / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(text)
    monkeypatch.syspath_prepend(tmp_path)
    for name in ('launch', 'launch.actions', 'launch.launch_description_sources'):
        monkeypatch.setitem(sys.modules, name, None)
        del sys.modules[name]
    assert launch_by_the_original(tmp_path / 'my.launch.py', ['a:=b']) == 7
    assert written.read_text() == (
        f"[(('{tmp_path}/my.launch.py',), {{'launch_arguments': [('a', 'b')]}})]"
    )


def test_an_original_that_cannot_be_imported_is_one_line(tmp_path, monkeypatch):
    for name, text in {'launch': 'import lark', 'launch_ros': ''}.items():
        (tmp_path / name).mkdir()
        (tmp_path / name / '__init__.py').write_text(text)
        monkeypatch.setitem(sys.modules, name, None)
        del sys.modules[name]
    monkeypatch.syspath_prepend(tmp_path)
    with pytest.raises(BringupError, match=r"imported: No module named 'lark': pip install lark"):
        launch_by_the_original(tmp_path / 'my.launch.py', [])


def test_beside_the_original_rewritten_files_are_substitutions_of_it(tmp_path, monkeypatch):
    class Original:
        """What its Node takes."""

    class Configuration(Original):
        def perform(self, context):
            return context.launch_configurations['file']

    (tmp_path / 'p.yaml').write_text('a: {ros__parameters: {x: 1}}')
    launch = ModuleType('launch')
    launch.Substitution = Original
    monkeypatch.setattr(sys, 'meta_path', [*sys.meta_path])
    for module in (launch, ModuleType('nav2_common')):
        monkeypatch.setitem(sys.modules, module.__name__, module)
    monkeypatch.setitem(sys.modules, 'nav2_common.launch', None)
    del sys.modules['nav2_common.launch']
    sys.modules['nav2_common'].__path__ = []
    provide('nav2_common')
    from nav2_common.launch import RewrittenYaml

    made = RewrittenYaml([Configuration()], {'x': '2'}, convert_types=True)
    assert isinstance(made, Original)
    assert is_a_substitution(Configuration()) and is_a_substitution([Configuration()])
    context = SimpleNamespace(launch_configurations={'file': str(tmp_path / 'p.yaml')})
    assert 'x: 2' in Path(made.perform(context)).read_text()
