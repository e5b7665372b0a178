# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The parameters of any node: listed with their bounds, and set; on the server's thread."""

import asyncio
from collections.abc import Mapping
import math
from typing import Any

from rcl_interfaces.msg import Parameter, ParameterDescriptor, ParameterType, ParameterValue
from rcl_interfaces.srv import (
    DescribeParameters,
    GetParameters,
    ListParameters,
    SetParameters,
)
from rclpy.executors import Executor

from amr_description.errors import ViewerError
from amr_description.text import shorten, unwrap
from amr_description.viewer.backend import Answer
from amr_description.viewer.introspection import ParameterInfo
from amr_description.viewer.requests import ListParameters as ListNodeParameters, SetParameter
from amr_description.viewer.ros.service_clients import ServiceClients, UnansweredError
from amr_description.viewer.ros.threads import on_ros_thread

_TYPES = {
    'list_parameters': ListParameters,
    'describe_parameters': DescribeParameters,
    'get_parameters': GetParameters,
    'set_parameters': SetParameters,
}
_FIELDS: Mapping[int, tuple[str, str]] = {
    ParameterType.PARAMETER_BOOL: ('bool', 'bool_value'),
    ParameterType.PARAMETER_INTEGER: ('integer', 'integer_value'),
    ParameterType.PARAMETER_DOUBLE: ('double', 'double_value'),
    ParameterType.PARAMETER_STRING: ('string', 'string_value'),
    ParameterType.PARAMETER_BYTE_ARRAY: ('byte_array', 'byte_array_value'),
    ParameterType.PARAMETER_BOOL_ARRAY: ('bool_array', 'bool_array_value'),
    ParameterType.PARAMETER_INTEGER_ARRAY: ('integer_array', 'integer_array_value'),
    ParameterType.PARAMETER_DOUBLE_ARRAY: ('double_array', 'double_array_value'),
    ParameterType.PARAMETER_STRING_ARRAY: ('string_array', 'string_array_value'),
}
"""Type -> its name, and the field of ParameterValue that has the value."""
_KINDS = {kind: (number, field) for number, (kind, field) in _FIELDS.items()}
_CONVERTERS: Mapping[str, Any] = {'bool': bool, 'integer': int, 'double': float, 'string': str}
_FIRST_TIMEOUT = 2.0
_TRIES = 3
"""A server that has not discovered a new client yet drops the answer to it: it is asked again."""
_MOST_ELEMENTS = 1000


class ParameterClients:
    """Parameters of one node after the other: clients are kept for the last one alone."""

    def __init__(self, services: ServiceClients, executor: Executor) -> None:
        self._services = services
        self._executor = executor
        self._node: str | None = None
        self._asking = asyncio.Lock()
        """Pages that ask two nodes at once would destroy each other's clients."""

    async def list_all(self, request: ListNodeParameters, _: str) -> Answer:
        """Answer with the parameters of a node, by their names. Raises ViewerError."""
        async with self._asking:
            found = await self._all_of(request.node)
        return Answer(f'{request.node} has {len(found)} parameters', found)

    async def _all_of(self, node: str) -> tuple[ParameterInfo, ...]:
        await self._connect(node)
        listed = await self._ask(node, 'list_parameters', ListParameters.Request())
        names = sorted(listed.result.names)
        if not names:
            return ()
        described = await self._ask(
            node, 'describe_parameters', DescribeParameters.Request(names=names)
        )
        values = await self._values(node, names)
        descriptors = {each.name: each for each in described.descriptors}
        return tuple(
            _info(name, values.get(name, ParameterValue()), descriptors.get(name))
            for name in names
        )

    async def set(self, request: SetParameter, _: str) -> Answer:
        """Set a parameter; answer with what it is then. Raises ViewerError."""
        parameter = Parameter(name=request.name, value=value_of(request.kind, request.value))
        async with self._asking:
            found = await self._set(request.node, parameter)
        return Answer(f'{request.node} has taken {request.name}', found)

    async def _set(self, node: str, parameter: Parameter) -> ParameterInfo:
        name = parameter.name
        await self._connect(node)
        response = await self._ask(
            node, 'set_parameters', SetParameters.Request(parameters=[parameter])
        )
        (result,) = response.results
        if not result.successful:
            reason = shorten(unwrap(result.reason)) or 'it gave no reason'
            raise ViewerError(f'{node} refuses {name}: {reason}')
        described = await self._ask(
            node, 'describe_parameters', DescribeParameters.Request(names=[name])
        )
        values = await self._values(node, [name])
        return _info(name, values.get(name, ParameterValue()), next(iter(described.descriptors)))

    async def _values(self, node: str, names: list[str]) -> dict[str, ParameterValue]:
        answer = await self._ask(node, 'get_parameters', GetParameters.Request(names=names))
        if len(answer.values) == len(names):
            return dict(zip(names, answer.values, strict=True))
        if len(names) == 1:
            return {}
        found: dict[str, ParameterValue] = {}
        for name in names:  # if one has no value, nodes return none at all
            found |= await self._values(node, [name])
        return found

    async def _connect(self, node: str) -> None:
        if node == self._node and f'{node}/list_parameters' in self._services:
            return
        types = {f'{node}/{name}': kind for name, kind in _TYPES.items()}
        await on_ros_thread(self._executor, lambda: self._services.set_more(types))
        self._node = node

    async def _ask(self, node: str, service: str, request: Any) -> Any:
        name = f'{node}/{service}'
        for _ in range(_TRIES - 1):
            try:
                return await self._services.call(name, request, _FIRST_TIMEOUT)
            except UnansweredError:
                continue
            except ViewerError as error:
                raise ViewerError(
                    f'{shorten(node)} has no parameters to be asked for: {error}'
                ) from error
        return await self._services.call(name, request, _FIRST_TIMEOUT)


def value_of(kind: str, value: Any) -> ParameterValue:
    """Return the value of a parameter of a kind. Raises ViewerError: it cannot be one."""
    if kind not in _KINDS:
        raise ViewerError(f'a parameter cannot be of type {shorten(kind)}')
    number, field = _KINDS[kind]
    scalar = kind.removesuffix('_array')
    try:
        if kind == 'byte_array':
            found: Any = [bytes([int(each)]) for each in value]
        elif scalar != kind:
            found = [_scalar(scalar, each) for each in value]
        else:
            found = _scalar(kind, value)
        message = ParameterValue(type=number)
        message._check_fields = True  # as the generated classes check what is set, if told so
        setattr(message, field, found)
    except (AssertionError, TypeError, ValueError, OverflowError):
        raise ViewerError(f'{shorten(repr(value))} is no {kind.replace("_", " ")}') from None
    return message


def _scalar(kind: str, value: Any) -> Any:
    if kind == 'bool' and not isinstance(value, bool):
        raise TypeError
    if kind == 'string' and not isinstance(value, str):
        raise TypeError
    if kind == 'integer' and (isinstance(value, bool) or value != int(value)):
        raise ValueError
    if kind == 'double' and isinstance(value, bool):
        raise TypeError
    return _CONVERTERS[kind](value)


def _info(
    name: str, value: ParameterValue, descriptor: ParameterDescriptor | None
) -> ParameterInfo:
    kind, field = _FIELDS.get(value.type, ('not set', ''))
    found: Any = getattr(value, field) if field else None
    if kind == 'byte_array':
        found = [ord(each) for each in found]
    elif kind.endswith('_array'):
        found = list(found)[:_MOST_ELEMENTS]
    described = descriptor or ParameterDescriptor()
    ranges = [*described.floating_point_range, *described.integer_range]
    lower, upper, step = (
        (float(ranges[0].from_value), float(ranges[0].to_value), float(ranges[0].step))
        if ranges
        else (math.nan, math.nan, math.nan)
    )
    return ParameterInfo(
        name,
        kind,
        found,
        described.read_only,
        described.description,
        described.additional_constraints,
        _finite(lower),
        _finite(upper),
        _finite(step) or None,
    )


def _finite(number: float) -> float | None:
    return number if math.isfinite(number) else None
