# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What scripts/setup says of a machine it cannot work on, and leaves out of a shell."""

import os
from pathlib import Path

from environment import SetupError
from environment.checkout import cache_folder, Checkout
from environment.host import check_host, clean_environment, foreign_ros, foreign_settings
import pytest


@pytest.fixture
def sourced(tmp_path):
    """The variables of a shell that sourced a ROS in tmp_path."""
    index = tmp_path / 'share/ament_index/resource_index/packages'
    index.mkdir(parents=True)
    (index / 'rclpy').touch()
    return {
        'AMENT_PREFIX_PATH': str(tmp_path),
        'PYTHONPATH': f'{tmp_path}/lib/python3.12/site-packages',
        'LD_LIBRARY_PATH': f'{tmp_path}/lib',
        'ROS_DISTRO': 'jazzy',
        'HOME': '/home/me',
    }


@pytest.mark.parametrize('version', ['2.28', '2.36', '3.0'])
def test_a_host_that_the_wheels_are_built_for(version):
    check_host('Linux', 'x86_64', ('glibc', version))


@pytest.mark.parametrize(
    ('host', 'found'),
    [
        (('Linux', 'aarch64', ('glibc', '2.36')), 'this is Linux on aarch64'),
        (('Darwin', 'x86_64', ('', '')), 'this is Darwin on x86_64'),
        (('Linux', 'x86_64', ('glibc', '2.27')), 'this has glibc 2.27'),
        (('Linux', 'x86_64', ('', '')), r'this has another C library \(musl\?\)'),
    ],
)
def test_a_host_that_they_cannot_be_loaded_on(host, found):
    with pytest.raises(SetupError, match=f'need Linux on x86_64 with glibc 2.28.*{found}.*docker'):
        check_host(*host)


def test_a_sourced_ros_is_found_and_left_out(sourced, tmp_path):
    assert foreign_ros(sourced) == str(tmp_path)
    assert foreign_settings(sourced) == [f'the sourced {tmp_path}']
    kept = clean_environment(sourced)
    assert kept.pop('PIP_USER') == '0'
    assert kept.keys() == {'HOME', 'PIP_DISABLE_PIP_VERSION_CHECK'}


def test_our_own_environment_is_not_foreign(sourced, tmp_path):
    (tmp_path / 'pyvenv.cfg').touch()
    assert foreign_ros(sourced) is None


def test_single_settings_are_named():
    found = foreign_settings({'PYTHONPATH': '/x', 'CONDA_PREFIX': '/opt/conda', 'PATH': '/bin'})
    assert found == ['PYTHONPATH', 'the conda environment /opt/conda']


def test_pip_keeps_its_index_but_not_another_target():
    kept = clean_environment({'PIP_INDEX_URL': 'https://mirror', 'PIP_TARGET': '/elsewhere'})
    assert kept['PIP_INDEX_URL'] == 'https://mirror'
    assert 'PIP_TARGET' not in kept


def test_guard_of_the_wheels_does_not_reach_another_environment():
    assert '_ROS_WHEELS_BOOTSTRAP_COMPLETE' not in clean_environment(
        {'_ROS_WHEELS_BOOTSTRAP_COMPLETE': '1'}
    )


def test_a_path_with_a_colon_is_refused():
    with pytest.raises(SetupError, match="'/a:b' contains a colon"):
        Checkout(Path('/a:b')).check()
    Checkout(Path('/a b')).check()


def test_cache_is_the_users_or_temporary(tmp_path):
    assert cache_folder({'XDG_CACHE_HOME': f'{tmp_path}/x'}) == tmp_path / 'x' / 'amr_description'
    assert cache_folder({'HOME': f'{tmp_path}'}) == tmp_path / '.cache' / 'amr_description'
    (tmp_path / 'file').touch()
    unusable = cache_folder({'XDG_CACHE_HOME': f'{tmp_path}/file'})
    assert unusable == cache_folder({}) != Path('amr_description')
    assert unusable.name == f'amr_description-{os.getuid()}'
