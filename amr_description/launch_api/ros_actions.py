# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The actions of launch_ros that hold for all nodes after them in their scope."""

from typing import Any

from amr_description.launch_api.context import (
    LaunchContext,
    NAMESPACE,
    PARAMETERS,
    REMAPPINGS,
)
from amr_description.launch_api.descriptions import Action
from amr_description.launch_api.parameters import evaluated, ParameterFile
from amr_description.launch_api.substitutions import SomeSubstitutions, text_of


def joined_namespace(outer: str, inner: str) -> str:
    """Return the absolute namespace ``inner`` within ``outer``; '' if there is neither."""
    if inner.startswith('/'):
        return f'/{inner.strip("/")}'
    parts = [part for part in (outer.strip('/'), inner.strip('/')) if part]
    return f'/{"/".join(parts)}' if parts else ''


class PushROSNamespace(Action):
    """A namespace for the nodes after it."""

    def __init__(self, namespace: SomeSubstitutions, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.namespace = namespace

    def execute(self, context: LaunchContext) -> None:
        outer = str(context.launch_configurations.get(NAMESPACE, ''))
        inner = text_of(context, self.namespace)
        # An empty one says as well where the nodes are: at the root.
        context.launch_configurations[NAMESPACE] = joined_namespace(outer, inner) or '/'


class SetParameter(Action):
    """A parameter of the nodes after it."""

    def __init__(self, name: SomeSubstitutions, value: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.name = name
        self.value = value

    def execute(self, context: LaunchContext) -> None:
        _add(context, PARAMETERS, evaluated(context, [{self.name: self.value}], self.where))


class SetUseSimTime(SetParameter):
    """``use_sim_time`` of the nodes after it."""

    def __init__(self, value: Any, **kwargs: Any) -> None:
        super().__init__('use_sim_time', value, **kwargs)


class SetParametersFromFile(Action):
    """A parameter file for the nodes after it."""

    def __init__(self, filename: SomeSubstitutions | ParameterFile, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.filename = filename

    def execute(self, context: LaunchContext) -> None:
        _add(context, PARAMETERS, evaluated(context, [self.filename], self.where))


class SetRemap(Action):
    """A remapping of the nodes after it."""

    def __init__(self, src: SomeSubstitutions, dst: SomeSubstitutions, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.src = src
        self.dst = dst

    def execute(self, context: LaunchContext) -> None:
        pair = (text_of(context, self.src), text_of(context, self.dst))
        _add(context, REMAPPINGS, [pair])


class SetROSLogDir(Action):
    """The folder of log files of the nodes after it."""

    def __init__(self, new_log_dir: SomeSubstitutions, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.new_log_dir = new_log_dir

    def execute(self, context: LaunchContext) -> None:
        context.environment['ROS_LOG_DIR'] = text_of(context, self.new_log_dir)


def _add(context: LaunchContext, name: str, more: Any) -> None:
    """Append to a list of the scope, without changing those of outer ones."""
    before = context.launch_configurations.get(name, [])
    context.launch_configurations[name] = [*before, *more]
