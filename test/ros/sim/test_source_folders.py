# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Which folders a request to the simulator may have listed."""

import pytest

from amr_description.errors import RequestError
from amr_description.sim.ros.source_folders import folder_of


@pytest.mark.parametrize('name', ['none', 'x' * 3000, 'a\0b'])
def test_a_folder_that_cannot_be_is_none(tmp_path, name):
    with pytest.raises(RequestError):
        folder_of(str(tmp_path / name))


def test_a_folder_is_listed_that_all_may_list(open_path, monkeypatch):
    assert folder_of(str(open_path)) == open_path
    for mode in (0o751, 0o744):
        open_path.chmod(mode)
        with pytest.raises(RequestError, match=f'not everybody may read {open_path};'):
            folder_of(str(open_path))
        monkeypatch.setenv('AMENT_PREFIX_PATH', str(open_path))
        assert folder_of(str(open_path)) == open_path
        monkeypatch.delenv('AMENT_PREFIX_PATH')
