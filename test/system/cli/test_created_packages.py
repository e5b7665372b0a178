# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What ``ros2 pkg create`` writes is built, run, tested, and overlaid by a second workspace.

Compiling takes its time: with ``--long``. In every run test/system/docs types a package of Python
and one of files, and test/unit/cli/test_cli_pkg_create.py reads what is written for the others.
"""

import subprocess

import pytest
from support.paths import ROOT

FIRST = """
mkdir -p src && cd src
for kind in ament_python ament_cmake cmake; do
    ros2 pkg create my_$kind --build-type $kind --node-name n --library-name l_$kind --license MIT
done
ros2 pkg create files --license MIT
cd ..
colcon build --symlink-install
source install/setup.bash
colcon test
colcon test-result --all
ros2 run my_ament_python n
ros2 run my_ament_cmake n
"""
SECOND = """
mkdir -p src && cd src
ros2 pkg create user --node-name u --dependencies my_ament_cmake files rcutils --license MIT
cat > user/src/u.cpp << END
#include <my_ament_cmake/l_ament_cmake.hpp>
#include <rcutils/types.h>
#include <cstdio>

int main()
{
  my_ament_cmake::LAmentCmake made;
  std::puts("linked");
}
END
cd ..
colcon build --merge-install
source install/setup.bash
ros2 run user u
ros2 pkg prefix files
"""


def bash(folder, lines, source):
    """Run lines in a fresh shell of a user whose home is empty, until one fails."""
    done = subprocess.run(
        ['bash', '--norc', '--noprofile', '-c', f'source {source}\nset -e\n{lines}'],
        cwd=folder,
        env={'HOME': str(folder), 'PATH': '/usr/bin:/bin', 'TERM': 'dumb'},
        capture_output=True,
        text=True,
    )
    assert (done.returncode, done.stderr) == (0, ''), done.stdout + done.stderr
    return done.stdout


@pytest.mark.long
def test_all_kinds(tmp_path):
    first, second = tmp_path / 'first', tmp_path / 'second'
    first.mkdir()
    second.mkdir()
    said = bash(first, FIRST, ROOT / 'scripts/activate')
    assert 'Summary: 4 packages finished' in said
    assert '3 tests, 0 errors, 0 failures, 1 skipped\n' in said
    assert said.endswith('Hi from my_ament_python.\nhello world my_ament_cmake package\n')
    said = bash(second, SECOND, first / 'install/setup.bash')
    assert said.endswith(f'linked\n{first}/install/files\n')
