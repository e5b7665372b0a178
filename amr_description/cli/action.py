# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Various action related sub-commands."""

from argparse import ArgumentParser, Namespace
from collections.abc import Callable
import contextlib
import sys
from typing import Any, TYPE_CHECKING

from amr_description import streams
from amr_description.cli.arguments import positive_float
from amr_description.errors import AmrError
from amr_description.text import did_you_mean

if TYPE_CHECKING:
    from rclpy.action import ActionClient
    from rclpy.action.client import ClientGoalHandle
    from rclpy.task import Future

    from amr_description.cli.session import Session

_GRACE = 5.0  # s for a server to answer once we are asked to stop
# By the numbers of action_msgs/msg/GoalStatus and action_msgs/srv/CancelGoal.
_STATUSES = (
    'UNKNOWN', 'ACCEPTED', 'EXECUTING', 'CANCELING', 'SUCCEEDED', 'CANCELED', 'ABORTED'
)  # fmt: skip
_REFUSALS = {2: 'the server does not know it', 3: 'it has ended'}


class SendGoalVerb:
    """
    Send an action goal.

    The exit code is 0 if the goal succeeded, and 1 if it was rejected, aborted or canceled. Ctrl-C
    cancels the goal.

    examples:
      ros2 action send_goal /steps simulation_interfaces/action/SimulateSteps "{steps: 10}" --feedback
    """  # noqa: E501 - a line to copy

    @staticmethod
    def add_arguments(parser: ArgumentParser) -> None:
        """Add the arguments of the verb."""
        parser.add_argument('action_name', help="Name of the ROS action (e.g. '/fibonacci')")
        parser.add_argument(
            'action_type',
            help="Type of the ROS action (e.g. 'example_interfaces/action/Fibonacci')",
        )
        source = parser.add_mutually_exclusive_group()
        source.add_argument(
            'goal',
            nargs='?',
            default='{}',
            help="Goal request values in YAML format (e.g. '{order: 10}')",
        )
        source.add_argument('--stdin', action='store_true', help='Read goal from standard input')
        parser.add_argument(
            '-f', '--feedback', action='store_true', help='Echo feedback messages for the goal'
        )
        parser.add_argument(
            '-t',
            '--timeout',
            metavar='N',
            type=positive_float,
            help='Longest time in seconds to wait for the action server, for its acceptance, and '
            'for the result, without which the goal is canceled; without it the wait is endless',
        )

    @staticmethod
    def main(args: Namespace) -> int:
        """Print goal, feedback and result; 0 if it succeeded."""
        from rclpy.action import ActionClient

        from amr_description.cli import actions
        from amr_description.cli.discovery import explained_absence
        from amr_description.cli.names import full_name
        from amr_description.cli.session import open_session
        from amr_description.cli.yaml_input import read_value
        from amr_description.ros.message_fields import set_fields
        from amr_description.ros.message_types import action_type
        from amr_description.ros.service_calls import ActionReadiness

        action_class = action_type(args.action_type)
        goal = action_class.Goal()
        stamps = set_fields(goal, read_value(sys.stdin.read() if args.stdin else args.goal))
        with open_session() as session:
            name = full_name(session.node, args.action_name, 'an action')
            client = ActionClient(session.node, action_class, name)
            print('Waiting for an action server to become available...')
            is_ready = ActionReadiness(session.node, client, action_class, name)

            def explain() -> str:
                others = actions.actions(session.node)
                guess = did_you_mean(name, (each for each, _ in others if each != name))
                return f'there is no action {name}{guess}' if guess else ''

            reason = explained_absence(session, is_ready, args.timeout, explain)
            if reason is not None:
                raise AmrError(
                    f'Action server is not available after waiting {args.timeout:g} seconds.'
                    + (f' {reason[0].upper()}{reason[1:]}' if reason else '')
                )
            now = session.node.get_clock().now().to_msg()
            for stamp in stamps:
                stamp(now)
            return _pursue(session, client, goal, feedback=args.feedback, timeout=args.timeout)


def _pursue(
    session: 'Session', client: 'ActionClient', goal: Any, *, feedback: bool, timeout: float | None
) -> int:
    """Send a goal and see it through to its result or its cancellation; return the exit code."""
    from amr_description.ros.message_text import to_yaml

    print(f'Sending goal:\n     {to_yaml(goal)}')
    with session.finishing() as stopped:
        try:
            sent = client.send_goal_async(goal, _print_feedback if feedback else None)
            handle = _accepted(session, sent, timeout, stopped)
            if not handle.accepted:
                print('Goal was rejected.')
                return 1
            print(f'Goal accepted with ID: {bytes(handle.goal_id.uuid).hex()}\n')
            result = handle.get_result_async()
            session.serve(lambda: result.done() or stopped(), timeout)
            if result.done():
                return _report(result.result())
            _cancel(session, handle)
        except BrokenPipeError:  # nobody reads on, so nobody could stop it any more
            streams.abandon_stdout()
            with contextlib.suppress(AmrError):
                _cancel(session, _accepted(session, sent, _GRACE, stopped))
            raise
        finally:
            client.destroy()
    raise AmrError(f'No result within {timeout:g} s: the goal was canceled')


def _report(response: Any) -> int:
    """Print the result of a goal; return the exit code."""
    from amr_description.ros.message_text import to_yaml

    status = _STATUSES[response.status]
    print(f'Result:\n    {to_yaml(response.result)}')
    print(f'Goal finished with status: {status}')
    return 0 if status == 'SUCCEEDED' else 1


def _print_feedback(message: Any) -> None:
    from amr_description.ros.message_text import to_yaml

    print(f'Feedback:\n    {to_yaml(message.feedback)}')


def _accepted(
    session: 'Session', sent: 'Future', timeout: float | None, stopped: Callable[[], bool]
) -> 'ClientGoalHandle':
    """Return the handle of a goal, accepted or rejected. Raises AmrError: neither."""
    session.serve(lambda: sent.done() or stopped(), timeout)
    if stopped():  # what is on its way has to be known to be canceled
        session.serve(sent.done, _GRACE)
    if not sent.done():
        waited = _GRACE if timeout is None or stopped() else timeout
        raise AmrError(f'The server neither accepted nor rejected the goal within {waited:g} s')
    return sent.result()


def _cancel(session: 'Session', handle: 'ClientGoalHandle') -> None:
    """Cancel a goal. Raises AmrError: the server does not."""
    print('Canceling goal...')
    canceled = handle.cancel_goal_async()
    session.serve(canceled.done, _GRACE)
    if not canceled.done():
        raise AmrError(f'Failed to cancel goal: no response within {_GRACE:g} s')
    response = canceled.result()
    if handle.goal_id not in [info.goal_id for info in response.goals_canceling]:
        reason = _REFUSALS.get(response.return_code, 'the server refuses')
        raise AmrError(f'Failed to cancel goal: {reason}')
    print('Goal canceled.')


VERBS = {
    'info': 'amr_description.cli.graph_verbs:ActionInfo',
    'list': 'amr_description.cli.graph_verbs:ACTION_LIST',
    'send_goal': f'{__name__}:SendGoalVerb',
    'type': 'amr_description.cli.graph_verbs:ACTION_TYPE',
}
