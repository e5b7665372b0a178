# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Tables from a name to a class, imported only when used."""

import sys

import pytest

import amr_description
from amr_description import controllers
from amr_description.controllers import CONTROLLERS
from amr_description.errors import AmrError, ControllerError
from amr_description.hardware import HARDWARE
from amr_description.registry import Registry, resolve

TABLE = {'a/Path': 'pathlib:Path', 'a/Gone': 'pathlib:Gone'}


def test_a_name_of_the_table_is_found():
    assert Registry('thing', TABLE, ControllerError).find('a/Path').__name__ == 'Path'


def test_a_third_party_class_needs_no_entry():
    assert Registry('thing', TABLE, ControllerError).find('numpy/ndarray').__name__ == 'ndarray'


def test_nothing_is_imported_before_it_is_asked_for(monkeypatch):
    monkeypatch.delitem(sys.modules, 'this', raising=False)
    registry = Registry('thing', {'a/This': 'this:s'}, ControllerError)
    assert registry.names == ('a/This',)
    assert 'this' not in sys.modules


@pytest.mark.parametrize(
    'name',
    ['nobody.knows/Me', 'numpy/Nothing', 'numpy', '', '/', '.rel/Me', 'a/b/c', 'broken/C'],
)
def test_an_unknown_name_is_reported_with_the_known_ones(name, tmp_path, monkeypatch):
    (tmp_path / 'broken.py').write_text('this is no Python\n')
    monkeypatch.syspath_prepend(tmp_path)
    with pytest.raises(ControllerError, match=r"thing '.*' is not known.*Known: a/Path, a/Gone"):
        Registry('thing', TABLE, ControllerError).find(name)


def test_a_module_that_cannot_be_imported_is_named_with_its_line(tmp_path, monkeypatch):
    (tmp_path / 'hers.py').write_text('import math\nfrom math import nothing\n')
    monkeypatch.syspath_prepend(tmp_path)
    with pytest.raises(
        ControllerError, match=r"ImportError: cannot import name 'nothing'.*hers.py:2\)"
    ):
        Registry('thing', TABLE, ControllerError).find('hers/Thing')


@pytest.mark.parametrize(
    ('name', 'said'),
    [
        ('numpy/ndarray', "thing 'numpy/ndarray' is no PurePath: derive it from pathlib.PurePath"),
        ('numpy/array', "'numpy/array' is no PurePath"),
        ('pathlib_of_hers/Path', "'pathlib_of_hers/Path' has no size, in bytes$"),
    ],
)
def test_a_class_of_another_kind_is_refused(name, said, tmp_path, monkeypatch):
    (tmp_path / 'pathlib_of_hers.py').write_text(
        'from pathlib import Path\nclass Good(Path): size = 1\n'
    )
    monkeypatch.syspath_prepend(tmp_path)
    registry = Registry(
        'thing', TABLE, ControllerError, base='pathlib:PurePath', needs={'size': 'in bytes'}
    )
    with pytest.raises(ControllerError, match=said):
        registry.find(name)
    assert registry.find('pathlib_of_hers/Good').size == 1
    assert registry.find('a/Path').__name__ == 'Path', 'those of the table are not asked'


def test_of_a_module_without_that_class_the_classes_are_told(tmp_path, monkeypatch):
    (tmp_path / 'of_hers.py').write_text('from pathlib import Path\nclass Good: ...\n')
    monkeypatch.syspath_prepend(tmp_path)
    with pytest.raises(ControllerError, match=r"no attribute 'Goof'; there are Good\)"):
        Registry('thing', TABLE, ControllerError).find('of_hers/Goof')


def test_a_fault_of_the_table_itself_is_not_the_users():
    with pytest.raises(AttributeError, match='Gone'):
        Registry('thing', TABLE, ControllerError).find('a/Gone')


def test_the_shipped_controllers_are_found_by_the_names_of_ros2_controllers():
    found = CONTROLLERS.find('diff_drive_controller/DiffDriveController')
    # By name: reload_controller_libraries makes new classes of the same name.
    assert found.__qualname__ == 'DiffDriveController'
    for name in CONTROLLERS.names:
        assert CONTROLLERS.find(name).parameters_type


@pytest.mark.parametrize(
    ('registry', 'what'), [(CONTROLLERS, 'Controller'), (HARDWARE, 'Hardware')]
)
def test_what_is_no_plugin_is_refused_before_it_stops_a_robot(registry, what):
    with pytest.raises(AmrError, match=f"'numpy/ndarray' is no {what}"):
        registry.find('numpy/ndarray')


@pytest.mark.parametrize('package', [amr_description, controllers])
def test_a_module_of_a_package_of_this_ones_name_is_found(package, tmp_path, monkeypatch):
    known = list(package.__path__)
    monkeypatch.setattr(package, '__path__', [*known])
    below = tmp_path.joinpath(*package.__name__.split('.'))
    below.mkdir(parents=True)
    (below / 'hers.py').write_text('class Mine:\n    pass\n')
    (below / 'errors.py').write_text('class AmrError:\n    pass\n')
    with pytest.raises(ModuleNotFoundError, match='hers'):
        resolve(f'{package.__name__}.hers:Mine')
    monkeypatch.syspath_prepend(tmp_path)
    registry = Registry('thing', TABLE, ControllerError)
    assert registry.find(f'{package.__name__}.hers/Mine').__name__ == 'Mine'
    assert package.__path__[: len(known)] == known  # ours first
    monkeypatch.delitem(sys.modules, f'{package.__name__}.hers')
    with pytest.raises(ModuleNotFoundError, match='nobody'):
        resolve(f'{package.__name__}.nobody:Mine')


def test_resolve_raises_what_import_raises():
    with pytest.raises(ImportError, match='nobody_knows_me'):
        resolve('nobody_knows_me:Class')


@pytest.mark.parametrize(
    'name', ['this/s', 'subprocess/Popen', 'unittest.__main__/main', 'pip.__main__/_main', 'os/x']
)
def test_no_module_is_imported_that_is_a_program_or_pythons_own(name, monkeypatch):
    monkeypatch.delitem(sys.modules, 'this', raising=False)
    with pytest.raises(ControllerError, match='is not known: that module is of Python itself'):
        Registry('thing', TABLE, ControllerError).find(name)
    assert 'this' not in sys.modules


def test_a_module_that_ends_the_process_is_refused(tmp_path, monkeypatch):
    (tmp_path / 'ending.py').write_text('import sys\nsys.exit(3)\n')
    monkeypatch.syspath_prepend(tmp_path)
    with pytest.raises(ControllerError, match=r"thing 'ending/Plugin' .*SystemExit: 3"):
        Registry('thing', TABLE, ControllerError).find('ending/Plugin')


@pytest.mark.parametrize('made', ['theirs.py', 'theirs/__init__.py', 'theirs/deep.py'])
def test_no_module_of_the_present_folder_is_imported_that_others_can_change(
    open_path, monkeypatch, made
):
    path = open_path / made
    path.parent.mkdir(exist_ok=True)
    path.write_text('class deep:\n    Plugin = 3\n\n\nPlugin = 3\n')
    monkeypatch.chdir(open_path)
    monkeypatch.syspath_prepend(open_path)
    monkeypatch.delitem(sys.modules, 'theirs', raising=False)
    monkeypatch.delitem(sys.modules, 'theirs.deep', raising=False)
    changed = open_path / made.partition('/')[0]
    changed.chmod(0o777)
    name = 'theirs.deep/Plugin' if 'deep' in made else 'theirs/Plugin'
    registry = Registry('thing', TABLE, ControllerError)
    with pytest.raises(ControllerError, match=f'others may write to {changed}; a folder'):
        registry.find(name)
    assert 'theirs' not in sys.modules
    changed.chmod(0o755)
    assert registry.find(name) == 3
