# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The parameters of another node."""

from argparse import Namespace
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any, TypeVar

from rcl_interfaces.msg import (
    Parameter,
    ParameterDescriptor,
    ParameterType,
    ParameterValue,
    SetParametersResult,
)
from rcl_interfaces.srv import GetParameters, SetParameters

from amr_description.cli import graph
from amr_description.cli.param.requests import ask_all, describe_all, list_all
from amr_description.cli.param.values import advice, to_message, typed, Value
from amr_description.cli.session import open_session, Session
from amr_description.errors import AmrError
from amr_description.text import did_you_mean, shorten

Response = TypeVar('Response')


@contextmanager
def remote_parameters(args: Namespace) -> 'Iterator[RemoteParameters]':
    """Yield the parameters of ``args.node_name``. Raises AmrError if it is not there."""
    with open_session(use_sim_time=args.use_sim_time) as session:
        yield RemoteParameters(
            session,
            graph.find_node(session, args.node_name, max(args.timeout, args.spin_time or 0.0)),
        )


class RemoteParameters:
    """The parameters of one node. Every method raises AmrError if the node does not answer."""

    def __init__(self, session: Session, node: str) -> None:
        self.node = node
        """The node's full name."""
        self._session = session

    def names(self) -> list[str]:
        """Return the names of all parameters, sorted."""
        return self._answer(list_all(self._session, [self.node]))

    def values(self, names: Sequence[str]) -> dict[str, ParameterValue]:
        """Return the values of the parameters that are declared and have one."""
        response = self._ask('get_parameters', GetParameters, GetParameters.Request(names=names))
        if len(response.values) == len(names):
            return dict(zip(names, response.values, strict=True))
        # If one has no value, nodes return none at all.
        each = [self.values([name]) for name in names] if len(names) > 1 else []
        return {name: value for found in each for name, value in found.items()}

    def descriptors(self, names: Sequence[str]) -> dict[str, ParameterDescriptor]:
        """Return the descriptors of the parameters that are declared."""
        known = sorted(set(self.names()) & set(names))
        return self._answer(describe_all(self._session, {self.node: known}))

    def set(self, values: Mapping[str, Value]) -> dict[str, SetParametersResult]:
        """Set parameters one by one; return the result of each."""
        empty = [name for name, value in values.items() if value == []]
        types = {k: d.type for k, d in self.descriptors(empty).items()} if empty else {}
        return self._set({name: to_message(v, types.get(name, 0)) for name, v in values.items()})

    def delete(self, name: str) -> SetParametersResult:
        """Undeclare a parameter."""
        return self._set({name: ParameterValue()})[name]

    def absence(self, name: str) -> str:
        """Return why a parameter has no value."""
        names = self.names()
        if name in names:
            return f"'{name}' of {self.node} is declared, but was given no value"
        return f"{self.node} has no parameter '{shorten(name)}'{did_you_mean(name, names)}"

    def explain(self, name: str, text: str) -> str:
        """
        Return what the node's error about setting a parameter omits, or ''.

        Args:
            name: of the parameter.
            text: the value as YAML.
        """
        descriptor = self.descriptors([name]).get(name)
        if descriptor is None:
            return f'; {self.absence(name)}'
        if descriptor.type in (ParameterType.PARAMETER_NOT_SET, to_message(typed(text)).type):
            return ''
        return f'; {advice(text, descriptor.type)}'

    def _set(self, values: Mapping[str, ParameterValue]) -> dict[str, SetParametersResult]:
        parameters = [Parameter(name=name, value=value) for name, value in values.items()]
        request = SetParameters.Request(parameters=parameters)
        response = self._ask('set_parameters', SetParameters, request, changes=True)
        return dict(zip(values, response.results, strict=True))

    def _ask(self, service: str, service_type: Any, request: Any, *, changes: bool = False) -> Any:
        requests = {self.node: request}
        return self._answer(
            ask_all(self._session, service, service_type, requests, changes=changes)
        )

    def _answer(self, responses: Mapping[str, Response]) -> Response:
        if self.node not in responses:
            raise AmrError(no_answer(self.node))
        return responses[self.node]


def no_answer(node: str) -> str:
    """Return the line for a node whose parameter services do not answer."""
    return (
        f'Wait for service timed out waiting for parameter services for node {node}: it has none, '
        'or is busy'
    )
