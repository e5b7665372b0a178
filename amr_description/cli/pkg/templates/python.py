# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The files of an ``ament_python`` package."""

from amr_description.cli.pkg.new_package import NewPackage

_SETUP = """\
from setuptools import find_packages, setup

package_name = '{name}'

setup(
    name=package_name,
    version='0.0.0',
    packages=find_packages(exclude=['test']),
    data_files=[
        ('share/ament_index/resource_index/packages',
            ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
    ],
    install_requires=['setuptools'],
    zip_safe=True,
    maintainer={maintainer!r},
    maintainer_email={email!r},
    description={description!r},
    license={license!r},
    extras_require={{
        'test': [
            'pytest',
        ],
    }},
    entry_points={{
        'console_scripts': [
{executables}\
        ],
    }},
)
"""
SETUP_CFG = """\
[develop]
script_dir=$base/lib/{name}
[install]
install_scripts=$base/lib/{name}
"""
NODE = """\
def main():
    print('Hi from {name}.')


if __name__ == '__main__':
    main()
"""
TESTS = {
    'test_copyright.py': """\
from ament_copyright.main import main
import pytest


# Take this line away once the source files say whose they are, and under which license
@pytest.mark.skip(reason='No copyright header has been placed in the generated source file.')
@pytest.mark.copyright
@pytest.mark.linter
def test_copyright():
    assert main(argv=['.', 'test']) == 0, 'Found errors'
""",
    'test_flake8.py': """\
from ament_flake8.main import main_with_errors
import pytest


@pytest.mark.flake8
@pytest.mark.linter
def test_flake8():
    code, errors = main_with_errors(argv=[])
    said = '\\n'.join(errors)
    assert code == 0, f'Found {len(errors)} code style errors / warnings:\\n{said}'
""",
    'test_pep257.py': """\
from ament_pep257.main import main
import pytest


@pytest.mark.linter
@pytest.mark.pep257
def test_pep257():
    assert main(argv=['.', 'test']) == 0, 'Found code style errors / warnings'
""",
}
"""The linters of Jazzy, by the names of the files."""


def setup_py(package: NewPackage) -> str:
    """Return the text of ``setup.py``."""
    name, node = package.name, package.node
    return _SETUP.format(
        name=name,
        maintainer=package.maintainer,
        email=package.email,
        description=package.description,
        license=package.license,
        executables=f"            '{node} = {name}.{node}:main',\n" if node else '',
    )
