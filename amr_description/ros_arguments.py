# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
ROS arguments as words, and what is a ROS domain.

rcl's grammar of them, between ``--ros-args`` and ``--`` (or the end)::

    -r, --remap [NODE:]FROM:=TO     -p, --param [NODE:]NAME:=VALUE     --params-file FILE
    --log-level LEVEL   --log-config-file FILE   -e, --enclave ENCLAVE
    --enable-… and --disable-… rosout-logs, stdout-logs, external-lib-logs
"""

from collections.abc import Iterator, Sequence

DOMAIN = 'ROS_DOMAIN_ID'
LAST_DOMAIN = 232
"""The ports of the next one would exceed 65535 (DDSI-RTPS 2.5, 9.6.2.3)."""
RANGES = ('SUBNET', 'LOCALHOST', 'OFF', 'SYSTEM_DEFAULT')
"""ROS_AUTOMATIC_DISCOVERY_RANGE, as rcl spells it."""
OF_DOMAINS = f'a ROS domain is an integer from 0 to {LAST_DOMAIN}'

_IDENTITY = ('__node:=', '__name:=', '__ns:=')
_REMAPS = ('-r', '--remap')
_PARAMETERS = ('-p', '--param')
_RULES = (*_REMAPS, *_PARAMETERS)
_WITHOUT_VALUE = ('--enable-', '--disable-')


def is_domain(text: str) -> bool:
    """Return whether a text is the number of a ROS domain."""
    return text.isdecimal() and int(text) <= LAST_DOMAIN


def ros_arguments(words: Sequence[str]) -> list[str]:
    """Return the ROS arguments among the words of a command line, without ``--ros-args``."""
    return [word for word, is_ros in _told_apart(words) if is_ros]


def other_arguments(words: Sequence[str]) -> list[str]:
    """
    Return what :func:`ros_arguments` leaves.

    rclpy's ``remove_ros_args`` also takes ``name:=value`` away, the remapping rules of ROS 1.
    """
    return [word for word, is_ros in _told_apart(words) if not is_ros]


def _told_apart(words: Sequence[str]) -> Iterator[tuple[str, bool]]:
    """Yield each word but those that begin and end ROS arguments, and whether it is one."""
    is_ros = False
    for word in words:
        if word == '--ros-args':
            is_ros = True
        elif is_ros and word == '--':
            is_ros = False
        else:
            yield word, is_ros


def files_in(arguments: Sequence[str]) -> list[str]:
    """Return the parameter files among ROS arguments, in their order."""
    return [value[0] for flag, *value in _flags(arguments) if flag == '--params-file' and value]


def parameters_in(words: Sequence[str]) -> dict[str, str]:
    """Return the parameters that a command line sets for any node, as they are written."""
    pairs = [
        _remapped(value).partition(':=')
        for flag, *value in _flags(ros_arguments(words))
        if flag in _PARAMETERS
    ]
    return {name: value for name, sign, value in pairs if sign}


def inherited(arguments: Sequence[str], *, with_parameters: bool = True) -> list[str]:
    """
    Return what of a node's ROS arguments goes on to the nodes that it makes.

    Not its name and namespace, which would make all of them namesakes. ``with_parameters``: its
    parameters and parameter files too, as a controller manager's go to its controllers, all but
    where it has its ``robot_description`` from.
    """
    own = (*_IDENTITY, 'robot_description:=') if with_parameters else _IDENTITY
    kept: list[str] = []
    for flag, *value in _flags(arguments):
        is_own = flag in _RULES and _remapped(value).startswith(own)
        is_parameter = flag in (*_PARAMETERS, '--params-file')
        if not is_own and (with_parameters or not is_parameter):
            kept += [flag, *value]
    return kept


_KINDS = _TOPIC, _SERVICE = 'rostopic://', 'rosservice://'
"""In front of a rule that is for one kind of names only."""


class NodeNames:
    """
    The full names of what a node calls its topics and services, as rcl expands and remaps them.

    Of the rules of its ROS arguments the first that matches counts.
    """

    def __init__(self, node: str, arguments: Sequence[str]) -> None:
        """
        Take the rules.

        Args:
            node: The full name of the node.
            arguments: Its ROS arguments.
        """
        self._node = node
        self._namespace, _, name = node.rpartition('/')
        self._rules: list[tuple[str, str, str]] = []
        for flag, *value in _flags(arguments):
            if flag not in _REMAPS or not value:
                continue
            kind = next((each for each in _KINDS if each in value[0]), '')
            limit, rule = _limited(value[0].replace(kind, ''))
            before, sign, after = rule.partition(':=')
            if sign and limit in ('', name) and not before.startswith('__'):
                self._rules.append((kind, self.expanded(before), after))

    def resolve(self, topic: str) -> str:
        """Return the full name of a topic."""
        return self._resolve(topic, _TOPIC)

    def resolve_service(self, service: str) -> str:
        """Return the full name of a service; those of actions rcl does not remap."""
        return self._resolve(service, _SERVICE)

    def _resolve(self, name: str, kind: str) -> str:
        full = self.expanded(name)
        for only, before, after in self._rules:
            if before == full and only in ('', kind):
                return self.expanded(after)
        return full

    def expanded(self, topic: str) -> str:
        """Return a name with the node's, or its namespace, in front; not remapped."""
        if topic.startswith('/'):
            return topic
        if topic.startswith('~'):
            return f'{self._node}/{topic[1:].removeprefix("/")}'.rstrip('/')
        return f'{self._namespace}/{topic}'


def parameter_sources(arguments: Sequence[str]) -> Iterator[tuple[str, str, str]]:
    """
    Yield what gives parameters, in order: ('', '', file), or (pattern, name, value as written).

    The pattern is that of the nodes that a value is for, as in a parameter file.
    """
    for flag, *value in _flags(arguments):
        if flag == '--params-file' and value:
            yield '', '', value[0]
        elif flag in _PARAMETERS and value:
            limit, rule = _limited(value[0])
            name, sign, given = rule.partition(':=')
            if sign:
                yield f'/{limit}' if limit else '/**', name, given


def _flags(arguments: Sequence[str]) -> Iterator[list[str]]:
    """Each flag with its value, if it takes one."""
    words = iter(arguments)
    for flag in words:
        value = None if flag.startswith(_WITHOUT_VALUE) else next(words, None)
        yield [flag] if value is None else [flag, value]


def _remapped(value: Sequence[str]) -> str:
    """The rule without the node that it may be limited to."""
    return _limited(value[0])[1] if value else ''


def _limited(rule: str) -> tuple[str, str]:
    """The node that a rule is limited to, or '', and the rest: ``amr:__ns:=/a``."""
    node, colon, rest = rule.partition(':')
    return (node, rest) if colon and not rest.startswith('=') else ('', rule)
