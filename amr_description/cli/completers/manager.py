# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Completions from the controller manager on the line."""

from argparse import Namespace
from collections.abc import Iterable, Iterator
from contextlib import contextmanager

from amr_description.cli.discovery import is_there_within, lookup_timeout
from amr_description.cli.names import full_name
from amr_description.cli.session import open_session
from amr_description.control.ros.client import ManagerClient
from amr_description.errors import ControllerError

_TIMEOUT = 5.0
"""s, for a manager that is there: Fast DDS repeats what was lost after 3 s."""


@contextmanager
def _manager(args: Namespace) -> Iterator[ManagerClient]:
    with open_session() as session:
        name = full_name(session.node, args.controller_manager, 'a controller manager')
        service = f'{name}/list_controllers'
        if not is_there_within(
            session, lambda: session.node.count_services(service) > 0, lookup_timeout()
        ):
            raise ControllerError(f'nobody has {service}')
        yield ManagerClient(session.node, name, timeout=_TIMEOUT, call_timeout=_TIMEOUT)


def controllers(args: Namespace, _prefix: str) -> Iterable[str]:
    """Return the loaded controllers."""
    with _manager(args) as manager:
        return manager.states()


def active_controllers(args: Namespace, _prefix: str) -> Iterable[str]:
    """Return the controllers that can be deactivated."""
    return _in_state(args, 'active')


def inactive_controllers(args: Namespace, _prefix: str) -> Iterable[str]:
    """Return the controllers that can be activated."""
    return _in_state(args, 'inactive')


def loadable_controllers(args: Namespace, _prefix: str) -> Iterable[str]:
    """Return the controllers that are not loaded and whose type the manager knows."""
    with _manager(args) as manager:
        return set(manager.typed_controllers()) - manager.states().keys()


def hardware_components(args: Namespace, _prefix: str) -> Iterable[str]:
    """Return the hardware components."""
    with _manager(args) as manager:
        return [component.name for component in manager.components()]


def _in_state(args: Namespace, wanted: str) -> Iterable[str]:
    with _manager(args) as manager:
        return [name for name, state in manager.states().items() if state == wanted]
