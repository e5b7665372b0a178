# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The verbs that only look at the graph: what topics, services, actions and nodes there are.

A verb is an object here: its docstring, ``add_arguments`` and ``main`` are those of
:mod:`~amr_description.cli.lazy_parser`.
"""

from argparse import ArgumentParser, Namespace, SUPPRESS
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
import sys
from typing import Any

from amr_description.cli.arguments import add_graph_arguments
from amr_description.errors import AmrError

NamesAndTypes = list[tuple[str, list[str]]]


@dataclass(frozen=True)
class Kind:
    """Topics, services, or actions: what has a name and types."""

    word: str
    """``topic``"""
    example: str
    """A name."""
    example_type: str
    can_be_hidden: bool = True

    @property
    def name_argument(self) -> str:
        """How the argument is called that has the name."""
        return f'{self.word}_name'

    def there(self, node: Any, *, hidden: bool = True) -> NamesAndTypes:
        """Return name and types of each, sorted; without ``hidden`` none with a ``_``."""
        from amr_description.cli import actions, graph

        if self.word == 'action':
            return actions.actions(node)
        return (graph.topics if self.word == 'topic' else graph.services)(node, hidden=hidden)

    def types(self, node: Any, name: str) -> list[str]:
        """Return the types of an absolute name; none if it is not there."""
        return dict(self.there(node)).get(name, [])

    def add_name_argument(self, parser: ArgumentParser, purpose: str, example: str = '') -> None:
        """Add the name that a verb is about."""
        example = example or self.example
        help_ = f"Name of the ROS {self.word} to get {purpose} (e.g. '{example}')"
        parser.add_argument(self.name_argument, help=help_)

    def add_count_argument(self, parser: ArgumentParser) -> None:
        """Add the flag for how many there are."""
        add_count_argument(parser, f'{self.word}s')

    def add_hidden_argument(self, parser: ArgumentParser) -> None:
        """Add the flag for names with a ``_``; it stands before the verb, too."""
        if self.can_be_hidden:
            parser.add_argument(
                f'--include-hidden-{self.word}s',
                action='store_true',
                default=SUPPRESS,  # or else it would undo the flag of the command
                help=f'Consider hidden {self.word}s as well',
            )

    def listed(self, session: Any, args: Namespace) -> NamesAndTypes:
        """Return what a verb that lists is about."""
        from amr_description.cli.discovery import wait_for_discovery

        wait_for_discovery(session, args.spin_time)
        hidden = getattr(args, f'include_hidden_{self.word}s', False)
        return self.there(session.node, hidden=hidden)

    def named(self, session: Any, args: Namespace) -> tuple[str, list[str]]:
        """Return the absolute name that a verb is about, and its types; none: it is not there."""
        from amr_description.cli.discovery import wait_for_discovery
        from amr_description.cli.names import full_name

        article = 'an' if self.word[0] in 'aeiou' else 'a'
        typed = getattr(args, self.name_argument)
        name = full_name(session.node, typed, f'{article} {self.word}')
        wait_for_discovery(session, args.spin_time, lambda: bool(self.types(session.node, name)))
        return name, self.types(session.node, name)


TOPIC = Kind('topic', '/chatter', 'std_msgs/msg/String')
SERVICE = Kind('service', '/talker/list_parameters', 'rcl_interfaces/srv/ListParameters')
ACTION = Kind('action', '/fibonacci', '', can_be_hidden=False)


def add_count_argument(parser: ArgumentParser, what: str) -> None:
    """Add ``--count-<what>``."""
    parser.add_argument(
        '-c',
        f'--count-{what}',
        action='store_true',
        help=f'Only display the number of {what} discovered',
    )


def _open_session(args: Namespace) -> Any:
    from amr_description.cli.session import open_session

    return open_session(use_sim_time=args.use_sim_time)


class ListVerb:
    """Print the names, or how many there are."""

    def __init__(self, kind: Kind, about: str) -> None:
        self.__doc__, self._kind = about, kind

    def add_arguments(self, parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        kind = self._kind
        add_graph_arguments(parser)
        show = f'Additionally show the {kind.word} type'
        parser.add_argument('-t', '--show-types', action='store_true', help=show)
        kind.add_count_argument(parser)
        kind.add_hidden_argument(parser)

    def main(self, args: Namespace) -> int:
        """Print them; 0."""
        with _open_session(args) as session:
            found = self._kind.listed(session, args)
            if getattr(args, f'count_{self._kind.word}s'):
                print(len(found))
            else:
                self.print_all(session.node, found, args)
        return 0

    def print_all(self, node: Any, found: NamesAndTypes, args: Namespace) -> None:
        """Print a line for each."""
        for name, types in found:
            print(f'{name} [{", ".join(types)}]' if args.show_types else name)


class TopicListVerb(ListVerb):
    """The same, with ``--verbose``."""

    def add_arguments(self, parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        super().add_arguments(parser)
        details = 'List full details about each topic'
        parser.add_argument('-v', '--verbose', action='store_true', help=details)

    def print_all(self, node: Any, found: NamesAndTypes, args: Namespace) -> None:
        """Print a line for each, or who publishes and who subscribes."""
        if not args.verbose:
            super().print_all(node, found, args)
            return
        _print_ends('Published topics:', 'publisher', found, node.count_publishers)
        _print_ends('Subscribed topics:', 'subscriber', found, node.count_subscribers)


def _print_ends(title: str, end: str, topics: NamesAndTypes, count: Callable[[str], int]) -> None:
    """Print how many publishers, or subscribers, the topics have that have any."""
    print(title)
    for name, types in topics:
        number = count(name)
        if number:
            plural = 's' if number > 1 else ''
            print(f' * {name} [{", ".join(types)}] {number} {end}{plural}')
    print()


class FindVerb:
    """Print the names of exactly one type."""

    def __init__(self, kind: Kind) -> None:
        self.__doc__ = f'Output a list of available {kind.word}s of a given type.'
        self._kind = kind

    def add_arguments(self, parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        kind = self._kind
        add_graph_arguments(parser)
        parser.add_argument(
            f'{kind.word}_type',
            help=f"Name of the ROS {kind.word} type to filter for (e.g. '{kind.example_type}')",
        )
        kind.add_count_argument(parser)
        kind.add_hidden_argument(parser)

    def main(self, args: Namespace) -> int:
        """Print them, perhaps none; 0."""
        wanted = getattr(args, f'{self._kind.word}_type')
        with _open_session(args) as session:
            found = [n for n, types in self._kind.listed(session, args) if wanted in types]
        print_names(found, count=getattr(args, f'count_{self._kind.word}s'))
        return 0


class TypeVerb:
    """Print the types of a name."""

    def __init__(self, kind: Kind, about: str, purpose: str = 'type') -> None:
        """``purpose``: what the help of the name says that it gets."""
        self.__doc__, self._kind, self._purpose = about, kind, purpose

    def add_arguments(self, parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        add_graph_arguments(parser)
        self._kind.add_name_argument(parser, self._purpose)

    def main(self, args: Namespace) -> int:
        """Print one type per line; 0, or 1 and nothing if it is not known."""
        with _open_session(args) as session:
            _, types = self._kind.named(session, args)
        print_names(types)
        return 0 if types else 1


class TopicInfo:
    """Print information about a topic."""

    @staticmethod
    def add_arguments(parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        add_graph_arguments(parser)
        TOPIC.add_name_argument(parser, 'info')
        parser.add_argument(
            '-v',
            '--verbose',
            action='store_true',
            help='Prints detailed information like the node name, node namespace, topic type, '
            'topic type hash, GUID, and QoS Profile of the publishers and subscribers to this '
            'topic',
        )

    @staticmethod
    def main(args: Namespace) -> int:
        """Print type, publishers and subscriptions; 0."""
        with _open_session(args) as session:
            node = session.node
            topic, types = TOPIC.named(session, args)
            if not types:
                raise AmrError(f"Unknown topic '{args.topic_name}'")
            blank = '\n' if args.verbose else ''
            print(f'Type: {types[0] if len(types) == 1 else types}', end=f'\n{blank}')
            for title, count, endpoints in (
                ('Publisher', node.count_publishers, node.get_publishers_info_by_topic),
                ('Subscription', node.count_subscribers, node.get_subscriptions_info_by_topic),
            ):
                print(f'{title} count: {count(topic)}', end=f'\n{blank}')
                for endpoint in endpoints(topic) if args.verbose else ():
                    print(endpoint, end='\n\n')
        return 0


class ServiceInfo:
    """Print information about a service."""

    @staticmethod
    def add_arguments(parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        add_graph_arguments(parser)
        SERVICE.add_name_argument(parser, 'info', '/add_two_ints')

    @staticmethod
    def main(args: Namespace) -> int:
        """Print type, clients and servers; 0."""
        with _open_session(args) as session:
            service, types = SERVICE.named(session, args)
            if not types:
                raise AmrError(f"Unknown service '{args.service_name}'")
            print(f'Type: {types[0] if len(types) == 1 else types}')
            print(f'Clients count: {session.node.count_clients(service)}')
            print(f'Services count: {session.node.count_services(service)}')
        return 0


class ActionInfo:
    """Print information about an action."""

    @staticmethod
    def add_arguments(parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        add_graph_arguments(parser)
        ACTION.add_name_argument(parser, 'info')
        show = 'Additionally show the action type'
        parser.add_argument('-t', '--show-types', action='store_true', help=show)
        parser.add_argument(
            '-c',
            '--count',
            action='store_true',
            help='Only display the number of action clients and action servers',
        )

    @staticmethod
    def main(args: Namespace) -> int:
        """Print clients and servers, perhaps none; 0."""
        from amr_description.cli.actions import clients_of, servers_of

        with _open_session(args) as session:
            action, _ = ACTION.named(session, args)
            ends = {
                'clients': clients_of(session.node, action),
                'servers': servers_of(session.node, action),
            }
        print(f'Action: {args.action_name}')
        for title, nodes in ends.items():
            print(f'Action {title}: {len(nodes)}')
            for name, types in nodes if not args.count else ():
                print(f'    {name} [{", ".join(types)}]' if args.show_types else f'    {name}')
        return 0


class NodesVerb:
    """Print the names of nodes."""

    def __init__(self, about: str, found: Callable[[Any, bool], Sequence[str]]) -> None:
        """``found``: ``(node of the verb, whether hidden ones, too)`` -> full names."""
        self.__doc__, self._found = about, found

    def add_arguments(self, parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        add_graph_arguments(parser)
        every = 'Display all nodes even hidden ones'
        parser.add_argument('-a', '--all', action='store_true', help=every)
        add_count_argument(parser, 'nodes')

    def main(self, args: Namespace) -> int:
        """Print them; 0."""
        from amr_description.cli.discovery import wait_for_discovery

        with _open_session(args) as session:
            wait_for_discovery(session, args.spin_time)
            names = self._found(session.node, args.all)
        if not args.count_nodes and any(one == next_one for one, next_one in pairwise(names)):
            print(
                'WARNING: Be aware that there are nodes in the graph that share an exact name, '
                'which can have unintended side effects.',
                file=sys.stderr,
            )
        print_names(names, count=args.count_nodes)
        return 0


def print_names(names: Sequence[str], *, count: bool = False) -> None:
    """Print a name per line, or how many there are."""
    for line in [str(len(names))] if count else names:
        print(line)


def _nodes(node: Any, hidden: bool) -> Sequence[str]:
    from amr_description.cli import graph

    return [each.full_name for each in graph.nodes(node, hidden=hidden)]


def _lifecycle_nodes(node: Any, hidden: bool) -> Sequence[str]:
    from amr_description.cli.lifecycle.managed import lifecycle_nodes

    return lifecycle_nodes(node, hidden=hidden)


TOPIC_LIST = TopicListVerb(TOPIC, 'Output a list of available topics.')
TOPIC_FIND = FindVerb(TOPIC)
TOPIC_TYPE = TypeVerb(TOPIC, "Print a topic's type.")
SERVICE_LIST = ListVerb(SERVICE, 'Output a list of available services.')
SERVICE_FIND = FindVerb(SERVICE)
SERVICE_TYPE = TypeVerb(SERVICE, "Output a service's type.")
ACTION_LIST = ListVerb(ACTION, 'Output a list of action names.')
ACTION_TYPE = TypeVerb(ACTION, "Print an action's type.", 'info')  # as of the original
NODE_LIST = NodesVerb('Output a list of available nodes.', _nodes)
LIFECYCLE_NODES = NodesVerb('Output a list of nodes with lifecycle.', _lifecycle_nodes)
