# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The modules that launch files import, and how they find them while they are read.

A finder of modules gives ``launch``, ``launch_ros`` and the others as long as a file is read, and
takes them back then. A name that is not understood may be imported; where it is used, one line
says so. Of packages that are known, but not installed, ament_index_python gives a folder then.
"""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
import importlib.util
import logging
from pathlib import Path
import sys
from types import ModuleType
from typing import Any, NoReturn

from amr_description.launch_api import (
    actions,
    composition,
    conditions,
    context,
    counterparts,
    descriptions,
    events,
    gazebo_files,
    including,
    lifecycle,
    logic,
    parameters,
    processes,
    rewriting,
    ros_actions,
    service,
    substitutions,
)
from amr_description.launch_api.locations import caller, refusal
from amr_description.text import did_you_mean


def _of(module: ModuleType, *names: str) -> dict[str, Any]:
    return {name: getattr(module, name) for name in names}


_SOURCES = dict.fromkeys(
    (
        'AnyLaunchDescriptionSource',
        'FrontendLaunchDescriptionSource',
        'PythonLaunchDescriptionSource',
    ),
    including.LaunchDescriptionSource,
)
_UTILITIES = {
    'normalize_to_list_of_substitutions': substitutions.normalize_to_list_of_substitutions,
    'perform_substitutions': substitutions.perform_substitutions,
}
_FIND = {
    'FindPackage': substitutions.FindPackagePrefix,
    'FindPackagePrefix': substitutions.FindPackagePrefix,
    'FindPackageShare': substitutions.FindPackageShare,
    'ExecutableInPackage': substitutions.ExecutableInPackage,
}
_PARAMETERS = {
    'Parameter': parameters.Parameter,
    'ParameterFile': parameters.ParameterFile,
    'ParameterValue': parameters.ParameterValue,
}
_LAUNCH_DESCRIPTION = {'LaunchDescription': descriptions.LaunchDescription}
_SERVICE = {'LaunchService': service.LaunchService}
_CONTEXT = {'LaunchContext': context.LaunchContext}
_ENTITY = {'LaunchDescriptionEntity': descriptions.LaunchDescriptionEntity}
_SUBSTITUTION = {'Substitution': substitutions.Substitution}
_SOME_SUBSTITUTIONS = {'SomeSubstitutionsType': substitutions.SomeSubstitutions}

UNDERSTOOD: Mapping[str, Mapping[str, Any]] = {
    'launch': {
        **_LAUNCH_DESCRIPTION,
        **_CONTEXT,
        **_SERVICE,
        **_ENTITY,
        **_SUBSTITUTION,
        **_SOME_SUBSTITUTIONS,
        'Action': descriptions.Action,
        'Condition': conditions.Condition,
        'Event': events.Event,
        'EventHandler': events.Handler,
        'LaunchDescriptionSource': including.LaunchDescriptionSource,
    },
    'launch.action': {'Action': descriptions.Action},
    'launch.actions': {
        **_of(
            actions,
            'AppendEnvironmentVariable',
            'EmitEvent',
            'GroupAction',
            'Log',
            'LogInfo',
            'OpaqueFunction',
            'PopEnvironment',
            'PopLaunchConfigurations',
            'PushEnvironment',
            'PushLaunchConfigurations',
            'RegisterEventHandler',
            'ResetEnvironment',
            'ResetLaunchConfigurations',
            'SetEnvironmentVariable',
            'SetLaunchConfiguration',
            'Shutdown',
            'TimerAction',
            'UnsetEnvironmentVariable',
            'UnsetLaunchConfiguration',
        ),
        'DeclareBooleanLaunchArgument': descriptions.DeclareBooleanLaunchArgument,
        'DeclareLaunchArgument': descriptions.DeclareLaunchArgument,
        'ExecuteLocal': processes.ExecuteLocal,
        'ExecuteProcess': processes.ExecuteProcess,
        'IncludeLaunchDescription': including.IncludeLaunchDescription,
    },
    'launch.condition': {'Condition': conditions.Condition},
    'launch.conditions': _of(
        conditions,
        'IfCondition',
        'InvalidConditionExpressionError',
        'LaunchConfigurationEquals',
        'LaunchConfigurationNotEquals',
        'UnlessCondition',
    ),
    'launch.descriptions': {'Executable': processes.Executable},
    'launch.event_handlers': _of(
        events,
        'OnExecutionComplete',
        'OnProcessExit',
        'OnProcessIO',
        'OnProcessStart',
        'OnShutdown',
    ),
    'launch.events': {
        'IncludeLaunchDescription': events.IncludeRequest,
        'Shutdown': events.Shutdown,
        'matches_action': lifecycle.matches_action,
    },
    'launch.events.process': _of(
        events, 'ProcessExited', 'ProcessIO', 'ProcessStarted', 'ShutdownProcess'
    ),
    'launch.launch_context': _CONTEXT,
    'launch.launch_description': _LAUNCH_DESCRIPTION,
    'launch.launch_description_entity': _ENTITY,
    'launch.launch_service': _SERVICE,
    'launch.launch_description_source': {
        'LaunchDescriptionSource': including.LaunchDescriptionSource
    },
    'launch.launch_description_sources': _SOURCES,
    'launch.logging': {'get_logger': logging.getLogger},
    'launch.some_substitutions_type': _SOME_SUBSTITUTIONS,
    'launch.substitution': _SUBSTITUTION,
    'launch.substitutions': {
        **_of(
            substitutions,
            'AnonName',
            'Command',
            'EnvironmentVariable',
            'FileContent',
            'FindExecutable',
            'LaunchConfiguration',
            'LaunchLogDir',
            'LocalSubstitution',
            'PathJoinSubstitution',
            'PathSubstitution',
            'StringJoinSubstitution',
            'SubstitutionFailure',
            'TextSubstitution',
            'ThisLaunchFile',
            'ThisLaunchFileDir',
        ),
        **_of(
            logic,
            'AllSubstitution',
            'AndSubstitution',
            'AnySubstitution',
            'EqualsSubstitution',
            'IfElseSubstitution',
            'NotEqualsSubstitution',
            'NotSubstitution',
            'OrSubstitution',
            'PythonExpression',
        ),
    },
    'launch.utilities': _UTILITIES,
    'launch_ros': {},
    'launch_ros.actions': {
        'Node': processes.Node,
        'ComposableNodeContainer': composition.ComposableNodeContainer,
        'LifecycleNode': lifecycle.LifecycleNode,
        'LifecycleTransition': lifecycle.LifecycleTransition,
        'LoadComposableNodes': composition.LoadComposableNodes,
        'PushRosNamespace': ros_actions.PushROSNamespace,
        **_of(
            ros_actions,
            'PushROSNamespace',
            'SetParameter',
            'SetParametersFromFile',
            'SetROSLogDir',
            'SetRemap',
            'SetUseSimTime',
        ),
    },
    'launch_ros.actions.node': {'Node': processes.Node},
    'launch_ros.descriptions': {**_PARAMETERS, 'ComposableNode': composition.ComposableNode},
    'launch_ros.event_handlers': _of(lifecycle, 'OnStateTransition'),
    'launch_ros.events': {},
    'launch_ros.events.lifecycle': _of(lifecycle, 'ChangeState'),
    'launch_ros.parameter_descriptions': _PARAMETERS,
    'launch_ros.substitutions': _FIND,
    'launch_xml': {},
    'launch_xml.launch_description_sources': {
        'XMLLaunchDescriptionSource': including.LaunchDescriptionSource
    },
    'launch_yaml': {},
    'launch_yaml.launch_description_sources': {
        'YAMLLaunchDescriptionSource': including.LaunchDescriptionSource
    },
    'nav2_common': {},
    'nav2_common.launch': _of(rewriting, 'HasNodeParams', 'ReplaceString', 'RewrittenYaml'),
    'ros_gz_bridge': {},
    'ros_gz_bridge.actions': _of(gazebo_files, 'RosGzBridge'),
    'ros_gz_sim': {},
    'ros_gz_sim.actions': _of(gazebo_files, 'GzServer'),
}
"""Module -> its names. A module below one of these has the names of that."""

_BESIDE_OURS = 'amr_description.pth'
"""Lies in site-packages, where set-up writes modules that call :func:`provide`."""
_ROOTS = {name.partition('.')[0] for name in UNDERSTOOD}


def _names_in(module: str) -> Mapping[str, Any]:
    """
    Return the names of a module.

    ``launch.actions.execute_process`` and the like, in which the original defines them, have those
    of the module above.
    """
    return UNDERSTOOD.get(module) or UNDERSTOOD.get(module.rpartition('.')[0]) or {}


def _for_the_launch_of_now(module: str) -> dict[str, Any]:
    """Return the names of a module; beside an original ``launch``, substitutions are its, too."""
    names = dict(_names_in(module))
    if module.partition('.')[0] in ('launch', 'launch_ros'):
        return names
    base = importlib.import_module('launch').Substitution
    if base is not substitutions.Substitution:
        for name, each in names.items():
            if issubclass(each, substitutions.Substitution):
                names[name] = type(name, (each, base), {})
    return names


class NotUnderstood:
    """Stands for a name that is not understood, until it is used."""

    def __init__(self, module: str, name: str) -> None:
        """Nothing is wrong yet."""
        self._module, self._name = module, name

    def _refuse(self) -> NoReturn:
        known = list(_names_in(self._module))
        name = f'{self._module}.{self._name}'
        understood = f'; understood are {", ".join(known)}' if known else ''
        raise refusal(
            f'{name} is not understood here{did_you_mean(self._name, known)}{understood}', caller()
        )

    def __call__(self, *_args: Any, **_kwargs: Any) -> NoReturn:
        """Refuse."""
        self._refuse()

    def __mro_entries__(self, _bases: Any) -> NoReturn:
        """Refuse to be a base class."""
        self._refuse()

    def __getattr__(self, name: str) -> 'NotUnderstood':
        """Return another one, which refuses when it is used."""
        if name.startswith('__'):
            raise AttributeError(name)
        return NotUnderstood(self._module, f'{self._name}.{name}')

    def __or__(self, _other: Any) -> 'NotUnderstood':
        """Stand in an annotation."""
        return self

    __ror__ = __or__


class _Finder(MetaPathFinder, Loader):
    """Finds the modules, and those that are not understood."""

    def find_spec(
        self, name: str, _path: Sequence[str] | None = None, _target: ModuleType | None = None
    ) -> ModuleSpec | None:
        if name.partition('.')[0] not in _ROOTS:
            return None
        return ModuleSpec(name, self, is_package=True)

    def exec_module(self, module: ModuleType) -> None:
        name = module.__name__
        vars(module).update(_for_the_launch_of_now(name))
        for other in UNDERSTOOD:  # as launch does: `import launch` gives `launch.actions`
            parent, _, last = other.rpartition('.')
            if parent == name:
                setattr(module, last, importlib.import_module(other))

        def missing(attribute: str) -> NotUnderstood:
            if attribute.startswith('__'):
                raise AttributeError(attribute)
            return NotUnderstood(name, attribute)

        vars(module)['__getattr__'] = missing


def is_installed() -> bool:
    """Return whether the real ``launch`` and ``launch_ros`` can be imported."""
    return all(map(_is_real, ('launch', 'launch_ros')))


def _is_real(name: str) -> bool:
    spec = importlib.util.find_spec(name)
    if spec is None or spec.origin is None:
        return False
    return not Path(spec.origin).parents[1].joinpath(_BESIDE_OURS).exists()


def provide(name: str) -> None:
    """Fill a module that is being imported, one of ``_ROOTS``, for programs such as tests."""
    if not any(isinstance(each, _Finder) for each in sys.meta_path):
        sys.meta_path.append(_Finder())  # behind those that find packages of a workspace
    _Finder().exec_module(sys.modules[name])


@contextmanager
def understood() -> Iterator[None]:
    """Have launch files find the modules within the context."""
    finder = _Finder()
    before = {name: each for name, each in sys.modules.items() if _is_ours(name)}
    for name in before:
        del sys.modules[name]
    sys.meta_path.insert(0, finder)
    including.forget_open_files()
    try:
        with counterparts.folders_of_known_packages():
            yield
    finally:
        sys.meta_path.remove(finder)
        for name in [each for each in sys.modules if _is_ours(each)]:
            del sys.modules[name]
        sys.modules.update(before)


def _is_ours(name: str) -> bool:
    return name.partition('.')[0] in _ROOTS
