# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""docs/your_own_messages.md, line by line; and packages of others, built as they are."""

import os
import re
import subprocess
import sys
import sysconfig

import pytest
from support import public_interfaces
from support.doc_pages import Page
from support.needs import need_compiler
from support.paths import ROOT
from support.shells import newcomer

PAGE = Page('your_own_messages.md')
NODE = """\
from my_msgs.msg import Sphere
import rclpy


def main():
    rclpy.init()
    print(f'radius {Sphere(radius=0.25).radius} of {Sphere.__module__}')
"""
PYTHON = (
    'ros2 pkg create my_code --build-type ament_python --node-name my_node --dependencies my_msgs'
)


def write_messages(source):
    """What the page has one write."""
    (fields,) = (block for block in PAGE.blocks('text') if block.startswith('geometry_msgs'))
    (rules,) = PAGE.blocks('cmake')
    tags = PAGE.blocks('xml')[0]
    package = source / 'my_msgs'
    (package / 'msg/Sphere.msg').write_text(fields)
    for file, before, added in (
        ('CMakeLists.txt', 'ament_package()', rules),
        ('package.xml', '  <export>', tags),
    ):
        text = (package / file).read_text()
        assert text.count(before) == 1
        (package / file).write_text(text.replace(before, f'{added}\n{before}'))


@pytest.mark.long
def test_a_message_of_ones_own(tmp_path):
    need_compiler()
    source = tmp_path / 'ros2_ws/src'
    lines = PAGE.text
    with newcomer(f'{lines}\n{PYTHON}\nros2 run my_code my_node', tmp_path) as shell:
        for line in ('mkdir -p ~/ros2_ws/src', 'ros2 pkg create my_msgs', 'mkdir my_msgs', PYTHON):
            shell.run(line)
        write_messages(source)
        (source / 'my_code/my_code/my_node.py').write_text(NODE)
        message = source / 'my_msgs/msg/Sphere.msg'
        right = message.read_text()
        message.write_text(right.replace('float64', 'flaot64'))
        shell.run('cd ~/ros2_ws')
        said = shell.run('colcon build', code=1)
        (line,) = re.findall('.*Sphere.msg:.*', said)
        (wanted,) = re.findall(r'msg:2:1: .*', PAGE.text)
        assert line == f'{message}:{wanted.removeprefix("msg:")}'
        message.write_text(right)
        assert '2 packages finished' in shell.run('colcon build')
        shell.run('source install/setup.bash')
        shown = shell.run('ros2 interface show')
        assert shown.startswith('geometry_msgs/Point center\n\tfloat64 x\n')
        assert 'radius 0.25 of my_msgs.msg._sphere' in shell.run('ros2 run my_code')
        shell.start('ros2 topic pub')
        shell.see('publishing #1')
        other = lines.partition('and in another shell')[2]
        with newcomer(other, tmp_path, activate=False) as second:
            second.run('source ~/ros2_ws/install')
            assert second.run('ros2 topic echo') == (
                'center:\n  x: 1.5\n  y: 0.0\n  z: 0.0\nradius: 0.5\n---\n'
            )
        shell.interrupt()


@pytest.mark.long
def test_a_wheel_without_colcon(tmp_path):
    """The last section; the wheel goes into a prefix, not into the environment of all tests."""
    package = tmp_path / 'ros2_ws/src/my_msgs'
    public_interfaces.write_package(package, 'my_msgs', {'msg/Sphere.msg': 'float64 radius\n'})
    text = (package / 'package.xml').read_text().replace('1.2.3', '0.0.0')
    (package / 'package.xml').write_text(text)
    target = tmp_path / 'target'
    book = PAGE.text.replace('pip install', f'pip install --no-index --prefix {target}')
    with newcomer(book, tmp_path) as shell:
        said = shell.run('ros2 run amr_description build_interfaces')
        assert said.count('.whl') == 2
        shell.run('python -m pip install')
    assert (target / 'share/my_msgs/msg/Sphere.json').exists()
    packages = sysconfig.get_path('purelib').replace(sys.prefix, str(target))
    environment = {
        **os.environ,
        'PYTHONPATH': packages,
        'LD_LIBRARY_PATH': f'{target}/lib:{os.environ.get("LD_LIBRARY_PATH", "")}',
    }
    code = 'from my_msgs.msg import Sphere; Sphere.__import_type_support__(); print(Sphere())'
    done = subprocess.run(
        [sys.executable, '-c', code], env=environment, capture_output=True, text=True
    )
    assert 'radius=0.0' in done.stdout, done.stderr


@pytest.mark.long
def test_packages_of_others_are_built_as_they_are(tmp_path):
    """Short: test/tooling/test_interface_build.py. Nothing changed, nothing is made again."""
    workspace = tmp_path / 'ros2_ws'
    public_interfaces.write_public_packages(workspace / 'src')
    lines = f'source {ROOT}/scripts/activate && cd {workspace} && colcon build'

    def build():
        done = subprocess.run(['bash', '-c', lines], capture_output=True, text=True)
        assert '5 packages finished' in done.stdout, done.stderr

    build()
    found = {}
    for name in public_interfaces.HASHES:
        share = workspace / 'install' / name.split('/')[0] / 'share'
        found[name] = public_interfaces.hash_of(share / f'{name}.json', name)
    assert found == public_interfaces.HASHES
    libraries = {path: path.stat().st_mtime_ns for path in (workspace / 'install').rglob('*.so')}
    assert len(libraries) == 8 * len(public_interfaces.FIELDS)
    build()
    assert {path: path.stat().st_mtime_ns for path in libraries} == libraries
    book = 'ros2 interface show vision_msgs/msg/Detection2DArray\nsource '
    with newcomer(f'{book}{workspace}/install/setup.bash', tmp_path, activate=None) as shell:
        shell.run('source')
        assert 'Detection2D[] detections' in shell.run('ros2 interface show')
