# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Processes of nodes: the ament index, and the command lines that launch builds."""

from fixtures.bringup.running import install_toys
import pytest

from amr_description.bringup import Node, path_of, Stack
from amr_description.bringup.command_line import LaunchPrefix, process_specs
from amr_description.errors import BringupError, ResourceError, UsageError


@pytest.fixture
def prefix(tmp_path, monkeypatch):
    install_toys(tmp_path / 'toys')
    (tmp_path / 'other').mkdir()
    monkeypatch.setenv('AMENT_PREFIX_PATH', f'{tmp_path}/other:{tmp_path}/toys')
    return tmp_path / 'toys'


def test_command_line(prefix, tmp_path):
    yaml = tmp_path / 'my.yaml'
    yaml.touch()
    node = Node(
        'worker',
        package='toys',
        name='w',
        namespace='left',
        parameters=[yaml, {'a': 1}],
        remappings=[('/cmd_vel', 'x/cmd_vel'), ('~/odom', '/odom')],
        arguments=['-z', 0.2],
    )
    plain = Node('step', package='toys')
    first, second = process_specs(Stack([node, plain]), tmp_path)
    assert (first.name, second.name) == ('worker-1', 'step-2')
    assert first.command == [
        f'{prefix}/lib/toys/worker', '-z', '0.2', '--ros-args',
        '-r', '__node:=w', '-r', '__ns:=/left',
        '--params-file', f'{yaml}', '--params-file', f'{tmp_path}/worker-1-parameters-2.yaml',
        '-r', '/cmd_vel:=x/cmd_vel', '-r', '~/odom:=/odom',
    ]  # fmt: skip
    assert second.command == [f'{prefix}/lib/toys/step', '--ros-args']
    assert not (tmp_path / 'worker-1-parameters-2.yaml').exists()
    first.write_parameter_files()
    assert '/left/w:\n' in (tmp_path / 'worker-1-parameters-2.yaml').read_text()
    assert yaml.read_text() == ''


def test_only_executables_of_this_package_start_with_sigint_blocked(prefix):
    (prefix / 'share/ament_index/resource_index/packages/amr_description').touch()
    (prefix / 'lib/amr_description').symlink_to('toys')
    nodes = [
        Node('step'), Node('step', package='toys'), Node('step', prefix='nice'),
    ]  # fmt: skip
    specs = process_specs(Stack(nodes), prefix)
    assert [spec.unblocks_sigint for spec in specs] == [True, False, False]
    (spec,) = process_specs(Stack(nodes[:1]), prefix, LaunchPrefix('nice'))
    assert not spec.unblocks_sigint


def test_the_missing_interpreter_of_a_script_is_named(prefix):
    step = prefix / 'lib/toys/step'
    (spec,) = process_specs(Stack([Node('step', package='toys')]), prefix)
    missing = FileNotFoundError(2, 'No such file or directory', str(step))
    assert spec.explain(missing) == str(missing)
    step.write_text('#!/nowhere/python3\n')
    assert spec.explain(missing) == f'{step} begins with #!/nowhere/python3, which is not there'
    step.unlink()
    assert spec.explain(missing) == str(missing)


def refuses(text, **changes):
    with pytest.raises((BringupError, ResourceError), match=text):
        process_specs(Stack([Node(**{'executable': 'step', 'package': 'toys', **changes})]), None)


def test_what_is_missing_is_reported_before_anything_starts(prefix, monkeypatch):
    libexec = "executable 'wrker' not found on the libexec directory '.*/lib/toys'"
    refuses(f"{libexec}; did you mean 'worker'\\? known: .*, plain, step", executable='wrker')
    refuses(
        "Package 'toyz' not found, searching: .*/other, .*/toys; did you mean toys\\?",
        package='toyz',
    )
    refuses("'no.yaml': no such file: /", parameters=['no.yaml'])
    (prefix / 'lib/toys/step').chmod(0o644)
    refuses("executable 'step' not found")
    monkeypatch.setenv('AMENT_PREFIX_PATH', '')
    refuses("Package 'toys' not found: AMENT_PREFIX_PATH is empty; source scripts/activate")


@pytest.mark.parametrize(
    ('pattern', 'own', 'expected'),
    [
        ('', '', [['env', '-i'], ['env', '-i']]),
        ('work', '', [['env', '-i'], []]),
        ('ork', '', [[], []]),
        ('', 'nice', [['nice'], ['env', '-i']]),
    ],
)
def test_a_prefix_for_all_or_some_of_the_command_lines(prefix, pattern, own, expected):
    stack = Stack([Node('worker', package='toys', prefix=own), Node('step', package='toys')])
    specs = process_specs(stack, None, LaunchPrefix('env -i', pattern))
    folder = f'{prefix}/lib/toys'
    paths = [f'{folder}/worker', f'{folder}/step']
    assert [spec.command for spec in specs] == [
        [*words, path, '--ros-args'] for words, path in zip(expected, paths, strict=True)
    ]


def test_an_invalid_prefix_is_reported_before_anything_starts(prefix):
    refuses("prefix 'no-such-gdb -x': there is no command 'no-such-gdb'", prefix='no-such-gdb -x')
    refuses('No closing quotation', prefix="nice '")
    with pytest.raises(UsageError, match=r"--launch-prefix-filter '\(': missing \)"):
        LaunchPrefix('nice', '(')


def test_files_of_packages_and_others(prefix, tmp_path, monkeypatch):
    share = prefix / 'share/toys'
    share.mkdir()
    (share / 'a.urdf').touch()
    assert path_of('package://toys/a.urdf') == share / 'a.urdf'
    monkeypatch.chdir(share)
    assert path_of('a.urdf') == share / 'a.urdf'
    with pytest.raises(
        ResourceError,
        match="'package://toys/b.urdf': no such file: /.*b.urdf; did you mean a.urdf",
    ):
        path_of('package://toys/b.urdf')
    with pytest.raises(ResourceError, match='it is a folder: /'):
        path_of(str(tmp_path))
