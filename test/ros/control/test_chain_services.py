# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A chain as others on the network see it: lists, modes and refusals of a manager's services."""

from controller_manager_msgs import srv
import pytest
from support.doc_pages import install, Page
from support.manager_host import Host, ros_in_this_process, YAML

from amr_description.ros.service_calls import call

DRIVE = 'diff_drive_controller'
CLASS, _ = Page('chain_a_controller.md').blocks('python')
TABLE, _ = Page('chain_a_controller.md').blocks('yaml')


@pytest.fixture(scope='module')
def host(tmp_path_factory):
    """A manager that has the circle of the page and diff_drive_controller, configured."""
    folder = tmp_path_factory.mktemp('chain')
    file = folder / 'controllers.yaml'
    entry = '    circle: {type: my_package.circle/Circle}\n'
    file.write_text(YAML.replace('    slow:', f'{entry}    slow:') + TABLE)
    with pytest.MonkeyPatch.context() as patch, ros_in_this_process():
        install(folder, patch, circle=CLASS)
        host = Host(file)
        host.start()
        try:
            for name in (DRIVE, 'circle'):
                assert host.client.load(name)
                assert host.client.configure(name)
            yield host
        finally:
            host.close()


@pytest.fixture
def manager(host):
    """Asks the manager; afterwards both controllers are inactive."""

    def ask(kind, **fields):
        name = ''.join(f'_{c.lower()}' if c.isupper() else c for c in kind).strip('_')
        service = getattr(srv, kind)
        request = service.Request(**fields)
        return call(host.client_node, service, f'/controller_manager/{name}', request)

    yield ask
    ask('SwitchController', deactivate_controllers=['circle', DRIVE], strictness=1)


def listed(manager, name):
    return next(c for c in manager('ListControllers').controller if c.name == name)


def test_a_chain_is_listed_as_ros2_control_lists_it(manager):
    assert manager('SwitchController', activate_controllers=['circle', DRIVE], strictness=2).ok
    names = [controller.name for controller in manager('ListControllers').controller]
    assert names.index('circle') < names.index(DRIVE)
    circle, drive = listed(manager, 'circle'), listed(manager, DRIVE)
    assert (circle.is_chainable, circle.is_chained) == (False, False)
    assert (drive.is_chainable, drive.is_chained) == (True, True)
    (link,) = circle.chain_connections
    assert (link.name, link.reference_interfaces) == (
        DRIVE, ['linear/velocity', 'angular/velocity']
    )  # fmt: skip
    assert drive.reference_interfaces == ['linear/velocity', 'angular/velocity']
    assert (drive.chain_connections, drive.exported_state_interfaces) == ([], [])
    assert circle.claimed_interfaces == [f'{DRIVE}/{name}' for name in drive.reference_interfaces]


@pytest.mark.parametrize(
    ('active', 'available', 'claimed'),
    [([], False, False), ([DRIVE], True, False), ([DRIVE, 'circle'], True, True)],
)
def test_references_are_among_the_hardware_interfaces(manager, active, available, claimed):
    manager('SwitchController', activate_controllers=active, strictness=2)
    found = [
        (interface.name, interface.data_type, interface.is_available, interface.is_claimed)
        for interface in manager('ListHardwareInterfaces').command_interfaces
        if interface.name.startswith(DRIVE)
    ]
    assert found == [
        (f'{DRIVE}/{axis}/velocity', 'double', available, claimed)
        for axis in ('angular', 'linear')
    ]


def test_what_a_chain_forbids_is_answered(manager):
    answer = manager('SwitchController', activate_controllers=['circle'], strictness=2)
    assert (answer.ok, answer.message) == (
        False,
        "Unable to activate controller with name 'circle' because following controller with name "
        f"'{DRIVE}' is not active and will not be activated.",
    )
    manager('SwitchController', activate_controllers=['circle', DRIVE], strictness=2)
    answer = manager('SwitchController', deactivate_controllers=[DRIVE], strictness=2)
    assert (answer.ok, answer.message) == (
        False,
        f"Unable to deactivate controller with name '{DRIVE}' because preceding controller with "
        "name 'circle' is currently active and will not be deactivated.",
    )
