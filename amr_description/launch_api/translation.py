# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Actions of a launch file -> a stack: its nodes, when each of them starts, and its handlers.

A description is visited once, from top to bottom, as launch does; nothing is started meanwhile.
The actions of an event handler are visited then, too, with the launch configurations that hold
where the handler stands: nodes in it wait for its event.

As in launch, a failure of a process stops nothing, waits have no timeout, and a node with
``on_exit=Shutdown()`` ends the launch when it ends: with its exit code.
"""

import asyncio
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import partial
import math
import os
from pathlib import Path
import re
import shlex
import shutil
import sys
from typing import Any

from amr_description.ament_index import executable_of, OWN_PACKAGE, path_of, world_path
from amr_description.bringup import handlers
from amr_description.bringup.command_line import check_prefix
from amr_description.bringup.conditions import (
    after,
    all_of,
    Condition,
    exited_cleanly,
    is_end_of_node,
    NodeRef,
    settled,
    started,
    walk,
)
from amr_description.bringup.description import Node as StackNode, Respawn, Stack
from amr_description.bringup.graph_conditions import service
from amr_description.bringup.handlers import EventHandler, Level
from amr_description.errors import AmrError, BringupError
from amr_description.launch_api import opened_files
from amr_description.launch_api.actions import (
    EmitEvent,
    Log,
    RegisterEventHandler,
    TimerAction,
)
from amr_description.launch_api.composition import LoadComposableNodes
from amr_description.launch_api.context import LaunchContext, NAMESPACE, PARAMETERS, REMAPPINGS
from amr_description.launch_api.counterparts import (
    arguments_as_ours,
    Counterpart,
    counterpart_of,
    require_package,
)
from amr_description.launch_api.descriptions import Action, LaunchDescription, Occurrence
from amr_description.launch_api.driving import next_steps
from amr_description.launch_api.events import OnProcessExit, Shutdown as ShutdownEvent
from amr_description.launch_api.files_in_place import use_files_of_package
from amr_description.launch_api.gazebo_files import (
    classic_world_of,
    GazeboPage,
    simulator,
    world_of,
)
from amr_description.launch_api.handling import Handling, Listeners, Registered, Started
from amr_description.launch_api.lifecycle import (
    ACTIVATE,
    ChangeState,
    CONFIGURE,
    LifecycleNode,
    LifecycleTransition,
    TRANSITIONS,
)
from amr_description.launch_api.locations import at, refusal
from amr_description.launch_api.parameters import evaluated
from amr_description.launch_api.processes import ExecuteProcess, Node
from amr_description.launch_api.ros_actions import joined_namespace
from amr_description.launch_api.substitutions import (
    perform_substitutions,
    runs_a_command,
    Substitution,
    text_of,
)
from amr_description.stand_ins import INSTEAD_OF_PACKAGES

_STEPS = ('create', 'spawner', 'unspawner', 'hardware_spawner')
"""What ends by itself soon, and is waited for."""
_STAYS = {'-u', '--unload-on-kill'}
"""With these a spawner does not."""
_STEP_OF_ROS2 = re.compile(r'\bros2 +(action|control|lifecycle|param|service) ')
"""So do these commands; ``ros2 bag record`` does not."""
_STEP: Mapping[str, Any] = {'required': False, 'on_exit': 'continue', 'timeout': math.inf}
_READS_KEYS = 'teleop_twist_keyboard'
_SIMULATOR = 'mujoco_sim'
_SOON = 10.0
"""s; what starts later is not waited for until all is ready."""
_LEVELS: Mapping[str, Level] = {
    'DEBUG': 'INFO', 'INFO': 'INFO', 'WARNING': 'WARNING', 'WARN': 'WARNING', 'ERROR': 'ERROR',
    'CRITICAL': 'ERROR', 'FATAL': 'ERROR',
}  # fmt: skip
_PREFIX = 'launch-prefix'


def translated(description: LaunchDescription, context: LaunchContext, file: Path) -> Stack:
    """Return the stack of a description, which a file has. Raises BringupError."""
    translation = Translation(context)
    translation.visit([description])
    translation.handle()
    if text := use_files_of_package(translation.nodes, file):
        translation.notes.append(('WARNING', text))
    return translation.stack()


@dataclass
class _Replaced:
    """What was taken from here, to be said once."""

    names: list[str] = field(default_factory=list)
    pages: list[str] = field(default_factory=list)
    left_out: dict[str, str] = field(default_factory=dict)

    def notes(self) -> Iterator[tuple[Level, str]]:
        if self.names:
            names = ', '.join(dict.fromkeys(self.names))
            yield 'INFO', f'not installed, so those of {OWN_PACKAGE} are started: {names}'
        if self.pages:
            names = ', '.join(dict.fromkeys(self.pages))
            yield 'INFO', f'in place of {names}: the page whose address the viewer prints'
        for name, why in self.left_out.items():
            yield 'INFO', f'{name} is left out: {why}'


class Translation:
    """What was visited so far."""

    def __init__(self, context: LaunchContext) -> None:
        """Begin with nothing."""
        self.context = context
        self.handling = Handling(self)
        self.nodes: list[StackNode] = []
        self.event_handlers: list[EventHandler] = []
        self.notes: list[tuple[Level, str]] = context.notes
        self.started: dict[Action, Started] = {}
        """What has become of each action that starts a process or a timer."""
        self.when: Condition | None = None
        """When the actions that are visited now are to be done; None: at once."""
        self._page_when: Condition | None = None
        self._knows_all = False
        self._asked: list[tuple[EmitEvent | LifecycleTransition, Condition | None]] = []
        """What asks nodes for transitions, which may stand behind it in the file."""
        self._replaced = _Replaced()

    def visit(self, entities: Iterable[object] | None) -> None:
        """Visit entities, in order."""
        for entity in entities or ():
            if isinstance(entity, list | tuple):
                self.visit(entity)
                continue
            try:
                self._visit(entity)
            except BringupError as error:
                raise at(error, getattr(entity, 'where', '')) from None
            except AmrError as error:
                raise refusal(str(error), getattr(entity, 'where', '')) from error

    def handle(self) -> None:
        """Visit what event handlers do; before that, what is asked of nodes of the whole file."""
        self._knows_all = True
        for action, when in self._asked:
            with self.later(when, self.context):
                self._ask(action)
        self.handling.resolve()

    @contextmanager
    def later(self, when: Condition | None, context: LaunchContext) -> Iterator[None]:
        """Have what is visited within the context be done at that time."""
        before = self.when, self.context
        self.when, self.context = when, context
        try:
            yield
        finally:
            self.when, self.context = before

    def stack(self) -> Stack:
        """Return all of it. Raises BringupError."""
        notes = [*self.notes, *self._replaced.notes()]
        if not self.nodes and not self._replaced.pages and not self.event_handlers:
            notes.append(('INFO', 'nothing is started: the launch file starts no process'))
        ready = self._readiness()
        # At once, as the window in whose place it is: it shows what goes wrong with the rest.
        optional: dict[str, Any] = {'required': False, 'respawn': Respawn()}
        page = StackNode('viewer', **optional, start_when=self._page_when, timeout=math.inf)
        return Stack(
            [*self.nodes, *([page] if self._replaced.pages else ())],
            ready_when=ready,
            timeout=math.inf,
            event_handlers=self.event_handlers,
            on_shutdown=self.handling.on_shutdown(),
            notes=notes,
            next_steps=next_steps(self.nodes, has_page=bool(self._replaced.pages)),
        )

    def _add_page(self, name: str) -> None:
        """Have the page in place of a window, which would open now."""
        if not self._replaced.pages or self.when is None:
            self._page_when = self.when
        self._replaced.pages.append(name)

    def _readiness(self) -> Condition | None:
        """Return when all is up: all was started that will be soon, and all steps are over."""
        soon = [node for node in self.nodes if _starts_soon(node)]
        steps = [exited_cleanly(node) for node in soon if _is_step(node)]
        later = [settled(node) for node in soon if node.start_when and not _is_step(node)]
        found = [*later, *steps] or [settled(node) for node in soon]
        return all_of(*found) if found else None

    def _visit(self, entity: object) -> None:
        if isinstance(entity, LaunchDescription):
            self.visit(entity.entities)
            return
        if not isinstance(entity, Action):
            raise refusal(f'{entity!r} is no action', '')
        if entity.condition is not None and not entity.condition.evaluate(self.context):
            return
        match entity:
            case ExecuteProcess():
                self._start(entity)
            case TimerAction():
                self._delay(entity)
            case RegisterEventHandler():
                registered = Registered(entity.event_handler, self.context.copy(), self.when)
                self.handling.add(registered)
            case Log():
                self._log(entity)
            case EmitEvent():
                self._emit(entity)
            case LifecycleTransition():
                self._ask(entity)
            case LoadComposableNodes():
                self._replaced.left_out |= entity.left_out(self.context)
            case Occurrence():
                self._occur(entity)
            case GazeboPage():
                self._add_page('the window of Gazebo')
            case _:
                before = dict(os.environ)
                more = entity.execute(self.context)
                changed = {k: v for k, v in os.environ.items() if before.get(k) != v}
                self.context.environment.update(changed)  # by a file, or a function of it
                self.visit(more)

    def _delay(self, timer: TimerAction) -> None:
        when = after(timer.seconds(self.context), self.when)
        self.started[timer] = Started(None, when)
        with self.later(when, self.context.copy()):
            self.visit(timer.actions)

    def _log(self, action: Log) -> None:
        level = _LEVELS.get(perform_substitutions(self.context, action.level).upper(), 'INFO')
        if self.when is not None and runs_a_command(action.msg):
            later = partial(_logged, self.context.copy(), action.msg, level)
            self.event_handlers.append(EventHandler(self.when, later, 'log what a command prints'))
            return
        text = perform_substitutions(self.context, action.msg)
        if self.when is None:
            self.notes.append((level, text))
            return
        line = handlers.Log(text, level)
        self.event_handlers.append(EventHandler(self.when, lambda _: line, f"log '{text}'"))

    def _occur(self, action: Occurrence) -> None:
        """Have something done once all is started that stands before it and does not wait."""
        waits = [started(node) for node in self.nodes if node.start_when is None]
        when = self.when or (all_of(*waits) if waits else after(0.0))
        occur = partial(_occurs, action, self.context.copy())
        self.event_handlers.append(EventHandler(when, occur, type(action).__name__))

    def _ask(self, action: EmitEvent | LifecycleTransition) -> None:
        """Ask nodes for transitions, once all nodes of the file are known."""
        if not self._knows_all:
            self._asked.append((action, self.when))
            return
        managed = {
            target: made
            for target, made in self.started.items()
            if isinstance(target, LifecycleNode) and isinstance(made.node, StackNode)
        }
        if isinstance(action, EmitEvent):
            event = action.event
            assert isinstance(event, ChangeState), 'of the others there is none to ask'
            for target, made in managed.items():
                if event.lifecycle_node_matcher(target):
                    self._change_state(_full_name(made.node), [event.transition_id], made)
            return
        by_name = {_full_name(made.node): made for made in managed.values()}
        for each in action.lifecycle_node_names:
            name = f'/{text_of(self.context, each).lstrip("/")}'
            self._change_state(name, action.transition_ids, by_name.get(name))

    def _emit(self, action: EmitEvent) -> None:
        event = action.event
        if isinstance(event, ChangeState):
            self._ask(action)
            return
        reason = event.text(self.context)
        stop = handlers.Shutdown(reason)
        when = after(0.0) if self.when is None else self.when
        self.event_handlers.append(EventHandler(when, lambda _: stop, f"shut down: '{reason}'"))

    def _change_state(
        self, name: str, transitions: Iterable[int], of: Started | None = None
    ) -> None:
        """Ask a node for transitions, one after the other, once it can be asked."""
        begin = service(f'{name}/change_state')
        when = begin if self.when is None else all_of(self.when, begin)
        for transition in transitions:
            command = ['ros2', 'lifecycle', 'set', name, str(transition)]
            step = StackNode('ros2', command=command, start_when=when, **_STEP)
            self.nodes.append(step)
            if of is not None:
                of.transitions.append((TRANSITIONS[transition], step))
            when = exited_cleanly(step)

    def _start(self, action: ExecuteProcess) -> None:
        if action in self.started:
            raise refusal('the same action stands twice; make a second one', '')
        if isinstance(action, Node):
            self._start_node(action)
        else:
            self._start_command(action)

    def _start_node(self, action: Node) -> None:
        context = self.context
        package = '' if action.package is None else text_of(context, action.package)
        executable = text_of(context, action.executable)
        other = counterpart_of(package, executable) if package else None
        if not package:
            pass  # a program by its path, or on the PATH
        elif other is None:
            require_package(package)
            executable_of(package, executable)
        else:
            self._note_counterpart(package, executable, other)
        if other is not None and not other.executable:
            self.started[action] = Started(None, self.when)
            return
        arguments = [text_of(context, each) for each in action.arguments]
        if action.truth(context, action.shell, 'shell'):
            arguments = shlex.split(' '.join(arguments))  # an empty one is none
        if other is not None:
            arguments = self._as_ours(package, executable, arguments)
            package, executable = OWN_PACKAGE, other.executable
        if action.ros_arguments:
            arguments += ['--ros-args', *(text_of(context, each) for each in action.ros_arguments)]
        given = context.launch_configurations
        space = str(given.get(NAMESPACE, ''))
        if action.namespace is not None:
            # An empty one is one as well: the full name of the node is known then.
            space = joined_namespace(space, text_of(context, action.namespace)) or '/'
        is_late = self.when is not None
        own_parameters = evaluated(context, action.parameters, '', is_late=is_late)
        parameters = [*given.get(PARAMETERS, ()), *own_parameters]
        for each in parameters:
            if isinstance(each, Path):
                opened_files.note(str(path_of(str(each))))
            elif executable == _SIMULATOR and isinstance(each, Mapping) and 'world' in each:
                world_path(str(each['world']))  # before anything starts
        remappings = [(text_of(context, a), text_of(context, b)) for a, b in action.remappings]
        common = self._common(action)
        if package == OWN_PACKAGE and executable == _READS_KEYS and sys.stdin.isatty():
            common |= {'terminal': True, 'prefix': ''}  # no `xterm -e` is needed
        check_prefix(common['prefix'])
        if not package:
            common |= {'command': [executable], 'is_ros': True}
        node = StackNode(
            executable if package else action.label(context) or os.path.basename(executable),
            package=package or OWN_PACKAGE,
            name=text_of(context, action.name).lstrip('/') or None if action.name else None,
            namespace=space or None,
            parameters=parameters,
            remappings=[*given.get(REMAPPINGS, ()), *remappings],
            arguments=arguments,
            **common,
        )
        self._add(action, node)
        if isinstance(action, LifecycleNode) and action.truth(
            context, action.autostart, 'autostart'
        ):
            made = self.started[action]
            self._change_state(_full_name(made.node), (CONFIGURE, ACTIVATE), made)

    def _as_ours(self, package: str, executable: str, arguments: list[str]) -> list[str]:
        """Return the arguments as ours takes them; note what it does not know."""
        taken, lacking = arguments_as_ours(executable, arguments)
        for words in lacking:
            text = f"'{words}' of {package} {executable} is left out: it is not known here"
            self.notes.append(('WARNING', text))
        return taken

    def _note_counterpart(self, package: str, executable: str, other: Counterpart) -> None:
        name = executable if package == executable else f'{package} {executable}'
        if other.why:
            self._replaced.left_out[name] = other.why
        elif other.has_page:
            self._add_page(name)
        else:
            ours = '' if executable == other.executable else f' ({other.executable})'
            self._replaced.names.append(f'{name}{ours}')

    def _start_command(self, action: ExecuteProcess) -> None:
        context = self.context
        shell = action.truth(context, action.shell, 'shell')
        words = action.words(context)
        if not words or not words[0]:
            raise refusal('ExecuteProcess(cmd=[]): it takes the words of a command', '')
        split = shlex.split(' '.join(words), comments=True) if shell else words
        if self._is_gazebo(split, action):
            return
        label = action.label(context) or os.path.basename(words[0].split()[0])
        command = ['/bin/sh', '-c', ' '.join(words)] if shell else words
        folder = None if action.cwd is None else text_of(context, action.cwd)
        if folder is not None and not Path(folder).is_dir():
            raise refusal(f"cwd='{folder}': there is no such folder", '')
        common = self._common(action)
        check_prefix(common['prefix'])
        node = StackNode(label, command=command, folder=folder, **common)
        self._add(action, node)

    def _is_gazebo(self, words: list[str], action: ExecuteProcess) -> bool:
        """Return whether it is a command of Gazebo, in whose place the simulator was started."""
        program, *rest = words
        name = os.path.basename(program)
        if name not in ('gz', 'ign', 'gazebo', 'gzserver', 'gzclient') or shutil.which(name):
            return False
        if name in ('gz', 'ign'):
            if rest[:1] not in (['sim'], ['gazebo']):
                raise refusal(f"there is no command '{name}': {INSTEAD_OF_PACKAGES['ros_gz_sim']}")
            world = world_of(rest[1:])
        else:
            world = classic_world_of(name, rest)
        before = len(self.nodes)
        self.visit(simulator(world))
        made = self.nodes[before:]
        self._replaced.names.append(f'{name} (mujoco_sim)')
        self.started[action] = Started(made[0] if made else None, self.when)
        return True

    def _common(self, action: ExecuteProcess) -> dict[str, Any]:
        """Return the fields that a stack's node has of any process."""
        context = self.context
        environment = context.changes_of_environment()
        if action.env is not None:
            environment = dict.fromkeys(os.environ) | _texts(context, action.env)
        prefix = str(context.launch_configurations.get(_PREFIX, ''))
        if action.prefix is not None:
            prefix = text_of(context, action.prefix)
        respawn = None
        if action.respawns(context):
            limit = action.respawn_max_retries
            respawn = Respawn(
                delay=max(action.delay(context), 0.01),
                backoff=1.0,
                limit=None if limit < 0 else max(limit, 1),
                steady=math.inf,
            )
        ends_all = _is_shutdown(action.on_exit)
        return {
            'environment': environment | _texts(context, action.additional_env),
            'prefix': prefix,
            'start_when': self.when,
            'timeout': math.inf,
            'required': ends_all,
            'on_exit': 'shutdown' if ends_all else 'continue',
            'respawn': respawn,
            'on_output': Listeners(),
        }

    def _add(self, action: ExecuteProcess, node: StackNode) -> None:
        self.nodes.append(node)
        self.started[action] = Started(node, self.when)
        if action.on_exit is not None and not _is_shutdown(action.on_exit):
            handler = OnProcessExit(target_action=action, on_exit=action.on_exit)
            handler.where = action.where
            self.handling.add(Registered(handler, self.context.copy(), None))


def _logged(
    context: LaunchContext, message: list[Substitution], level: Level, _state: object
) -> handlers.Log:
    """Return a line that could not be known before."""
    try:
        return handlers.Log(perform_substitutions(context, message), level)
    except BringupError as error:
        return handlers.Log(str(error), 'ERROR')


def _occurs(action: Occurrence, context: LaunchContext, _state: object) -> None:
    """Have it done once the processes are there whose start was the reason."""
    asyncio.get_running_loop().call_soon(action.occur, context)


def _full_name(node: NodeRef | None) -> str:
    """Return the name of a managed node, as it is started."""
    assert isinstance(node, StackNode), 'what is managed is a node that is started'
    return f'{(node.namespace or "").rstrip("/")}/{node.name}'


def _texts(context: LaunchContext, table: Mapping[Any, Any]) -> dict[str, str | None]:
    return {text_of(context, key): text_of(context, value) for key, value in table.items()}


def _is_shutdown(on_exit: object) -> bool:
    """Return whether it is ``Shutdown()``, alone or in a list."""
    if isinstance(on_exit, list | tuple) and len(on_exit) == 1:
        return _is_shutdown(on_exit[0])
    return (
        isinstance(on_exit, EmitEvent)
        and isinstance(on_exit.event, ShutdownEvent)
        and on_exit.condition is None
    )


def _is_step(node: NodeRef) -> bool:
    if not isinstance(node, StackNode):
        return node.executable in _STEPS
    if node.executable in _STEPS:
        return _STAYS.isdisjoint(node.arguments)
    return _STEP_OF_ROS2.search(' '.join(node.command or ())) is not None


def _starts_soon(node: StackNode) -> bool:
    """Return whether it starts at once, after some seconds, or after steps."""
    if node.start_when is not None and node.start_when.delay > _SOON:
        return False
    ends = [part for part in walk(node.start_when) if is_end_of_node(part)]
    return all(_is_step(other) for part in ends for other in part.nodes)
