# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``rosidl_runtime_py``: messages as YAML, CSV and dictionaries, and back; classes by name."""

from collections import OrderedDict
from collections.abc import Callable, Iterable, Mapping
import importlib
from pathlib import Path
from typing import Any
import warnings

from ament_index_python import get_resource, get_resources, has_resource
from ament_index_python.packages import get_package_prefix
from rosidl_parser.definition import AbstractNestedType, NamespacedType

from amr_description.ament_index import package_share
from amr_description.errors import AmrError
from amr_description.ros.message_fields import FieldError, set_fields, Words
from amr_description.ros.message_text import Style, to_csv, to_plain, to_yaml


def get_message(identifier: str) -> Any:
    """Return the class of ``package/msg/Name``, or ``package/Name``; it raises as imports do."""
    return _of_kind(get_message_namespaced_type(identifier), is_message, 'a message', identifier)


def get_service(identifier: str) -> Any:
    """As :func:`get_message`, of ``package/srv/Name``."""
    return _of_kind(get_service_namespaced_type(identifier), is_service, 'a service', identifier)


def get_action(identifier: str) -> Any:
    """As :func:`get_message`, of ``package/action/Name``."""
    return _of_kind(get_action_namespaced_type(identifier), is_action, 'an action', identifier)


def _of_kind(
    name: NamespacedType, is_wanted: Callable[[Any], bool], words: str, identifier: str
) -> Any:
    interface = import_message_from_namespaced_type(name)
    if not is_wanted(interface):
        raise ValueError(f"Expected the full name of {words}, got '{identifier}'")
    return interface


def get_interface(identifier: str) -> Any:
    """Return the class of an interface of any kind; it raises as imports do."""
    return import_message_from_namespaced_type(get_namespaced_type(identifier))


_RESOURCE = 'rosidl_interfaces'
"""What the ament index has of each package with interfaces: its files."""


def get_interface_packages() -> dict[str, str]:
    """Return the prefix of each package that has interfaces."""
    found: dict[str, str] = get_resources(_RESOURCE)
    return found


def get_interfaces(package_names: Iterable[str] = ()) -> dict[str, list[str]]:
    """
    Return the interfaces of packages, ``msg/Name``; of none: of all. It leaves out what has none.

    Raises:
        LookupError: a package is not installed.
    """
    found = {}
    for package in [*package_names] or get_interface_packages():
        get_package_prefix(package)
        if has_resource(_RESOURCE, package):
            content, _ = get_resource(_RESOURCE, package)
            files = map(Path, content.splitlines())
            found[package] = sorted(
                {str(file.with_suffix('')) for file in files if file.suffix in _SUFFIXES}
            )
    return found


_SUFFIXES = ('.msg', '.srv', '.action')


def _interfaces_of_kind(kind: str, packages: Iterable[str]) -> dict[str, list[str]]:
    found = {
        package: [name for name in names if name.startswith(f'{kind}/')]
        for package, names in get_interfaces(packages).items()
    }
    return {package: names for package, names in found.items() if names}


def get_message_interfaces(package_names: Iterable[str] = ()) -> dict[str, list[str]]:
    """As :func:`get_interfaces`, of messages alone."""
    return _interfaces_of_kind('msg', package_names)


def get_service_interfaces(package_names: Iterable[str] = ()) -> dict[str, list[str]]:
    """As :func:`get_interfaces`, of services alone."""
    return _interfaces_of_kind('srv', package_names)


def get_action_interfaces(package_names: Iterable[str] = ()) -> dict[str, list[str]]:
    """As :func:`get_interfaces`, of actions alone."""
    return _interfaces_of_kind('action', package_names)


def _namespaced_type(identifier: str, kind: str) -> NamespacedType:
    parts = identifier.split('/')
    if len(parts) == 2 and kind:
        parts.insert(1, kind)
    if len(parts) != 3 or not all(parts):
        raise ValueError(f"'{identifier}' is not written as package/{kind or 'msg'}/Name")
    return NamespacedType(parts[:2], parts[2])


def get_namespaced_type(identifier: str) -> NamespacedType:
    """Return the parts of a name, ``package/msg/Name``. Raises ValueError."""
    return _namespaced_type(identifier, '')


def get_message_namespaced_type(identifier: str) -> NamespacedType:
    """As :func:`get_namespaced_type`, of a message, also ``package/Name``."""
    return _namespaced_type(identifier, 'msg')


def get_service_namespaced_type(identifier: str) -> NamespacedType:
    """As :func:`get_namespaced_type`, of a service, also ``package/Name``."""
    return _namespaced_type(identifier, 'srv')


def get_action_namespaced_type(identifier: str) -> NamespacedType:
    """As :func:`get_namespaced_type`, of an action, also ``package/Name``."""
    return _namespaced_type(identifier, 'action')


def import_message_from_namespaced_type(message_type: NamespacedType | AbstractNestedType) -> Any:
    """Return the class of a type; one of an action's feedback has no name of its own."""
    if isinstance(message_type, AbstractNestedType):
        warnings.warn('pass the type of the elements, not of the array', DeprecationWarning, 2)
        message_type = message_type.value_type
    module = importlib.import_module('.'.join(message_type.namespaces))
    action, found, kind = message_type.name.rpartition('_')
    if found and kind == 'FeedbackMessage':
        return getattr(module, action).Impl.FeedbackMessage
    return getattr(module, message_type.name)


def is_message(interface: Any) -> bool:
    """Return whether a class, or an object, is one of messages."""
    return hasattr(interface, 'get_fields_and_field_types')


def is_service(interface: Any) -> bool:
    """Return whether a class is one of services."""
    return hasattr(interface, 'Request') and hasattr(interface, 'Response')


def is_action(interface: Any) -> bool:
    """Return whether a class is one of actions."""
    return all(hasattr(interface, name) for name in ('Goal', 'Result', 'Feedback'))


def get_interface_path(interface_name: str) -> str:
    """Return the file of an interface, ``package/msg/Name``. Raises LookupError: there is none."""
    package, *rest = interface_name.split('/')
    try:
        path = package_share(package).joinpath(*rest)
    except AmrError as error:
        raise LookupError(str(error)) from error
    if not path.suffix and len(rest) == 2:
        path = path.with_suffix(f'.{rest[0]}')
    if not path.is_file():
        raise LookupError(f"Could not find the interface '{path}'")
    return str(Path(path))


def get_message_slot_types(msg: Any) -> OrderedDict[str, Any]:
    """Return the types of the fields of a message, in their order."""
    return OrderedDict(zip(msg.get_fields_and_field_types(), msg.SLOT_TYPES, strict=True))


def message_to_yaml(
    msg: Any,
    *,
    truncate_length: int | None = None,
    no_arr: bool = False,
    no_str: bool = False,
    flow_style: bool = False,
) -> str:
    """Return the fields of a message as YAML; arrays and texts are cut after a length."""
    return to_yaml(msg, Style(truncate_length, not no_arr, not no_str, flow_style))


def message_to_csv(
    msg: Any, *, truncate_length: int | None = None, no_arr: bool = False, no_str: bool = False
) -> str:
    """Return the values of a message in one line, separated by commas."""
    return to_csv(msg, Style(truncate_length, not no_arr, not no_str))


def message_to_ordereddict(
    msg: Any, *, truncate_length: int | None = None, no_arr: bool = False, no_str: bool = False
) -> OrderedDict[str, Any]:
    """Return a message as a dictionary of dictionaries, lists, numbers and texts."""
    found = _ordered(to_plain(msg, Style(truncate_length, not no_arr, not no_str)))
    assert isinstance(found, OrderedDict), 'as a message is'
    return found


def set_message_fields(
    msg: Any,
    values: Mapping[str, Any],
    expand_header_auto: bool = False,
    expand_time_now: bool = False,
) -> list[Any]:
    """
    Set the fields of a message; those that are not named stay.

    Args:
        msg: The message.
        values: By the names of its fields, as YAML has them.
        expand_header_auto: Whether ``auto`` stands for a header of the time of a publication.
        expand_time_now: Whether ``now`` stands for such a time.

    Returns:
        What is to be called with the time of each publication.

    Raises:
        AttributeError: There is no such field.
        TypeError: What is to have fields is no mapping.
        ValueError: A value is none of its field.
    """
    words = Words(expand_header_auto, expand_time_now)
    try:
        return set_fields(msg, values, words)
    except FieldError as error:
        raise error.kind(error.reason if error.kind is TypeError else str(error)) from error


def _ordered(value: Any) -> Any:
    if isinstance(value, dict):
        return OrderedDict((name, _ordered(each)) for name, each in value.items())
    return [_ordered(each) for each in value] if isinstance(value, list) else value
