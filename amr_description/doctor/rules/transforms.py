# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Rules of the section ``transforms``."""

from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Iterator
import math
import shlex

from amr_description.clock import NANOSECONDS
from amr_description.doctor.findings import error, Finding, Rule, warning
from amr_description.doctor.observations import Observations
from amr_description.doctor.observations.transforms import Edge, Tree
from amr_description.doctor.rules.wording import right_clock
from amr_description.model.robot import Joint
from amr_description.text import closest_match

_UNIT = 0.01
"""How much the length of a quaternion may differ from 1."""
_SAME_POSE = 1e-6
_LATE = {False: 2 * NANOSECONDS, True: 10 * NANOSECONDS}
"""ns between a stamp and the time of its reception, by whether time is simulated: simulated time
may pass much faster than that of the system. AMCL stamps 1 s into the future."""
_SHOWN = 4


def tf_two_parents(seen: Observations) -> Iterator[Finding]:
    """
    A frame has one parent.

    The usual pair: odometry publishes ``odom -> base_link``, and the URDF has ``base_footprint ->
    base_link``. Odometry moves the root: ``base_frame_id: base_footprint``.
    """
    for child, edges in _children(seen):
        parents = _by(edges, lambda each: each.parent)
        if len(parents) < 2:
            continue
        told = ' and '.join(
            f"'{parent}' (published by {_publishers(found)})" for parent, found in parents.items()
        )
        yield error(
            'tf_two_parents',
            f"the frame '{child}' has {len(parents)} parents: {told}",
            f"a frame can have one parent: '{child}' jumps between them with each message, and "
            'lookups fail now and then',
            _for_two_owners(child, edges),
        )


def tf_two_publishers(seen: Observations) -> Iterator[Finding]:
    """
    A transform has one publisher.

    Mostly a drive controller and an EKF. Set ``enable_odom_tf: false`` for the one, or
    ``publish_tf: false`` for the other.
    """
    for child, edges in _children(seen):
        if len({each.parent for each in edges}) > 1:
            continue  # of that tf_two_parents tells
        moving = [each for each in edges if not each.is_static]
        static = [each for each in edges if each.is_static]
        pair = f"'{edges[0].parent}' -> '{child}'"
        if len(moving) > 1:
            yield error(
                'tf_two_publishers',
                f'the transform {pair} has {len(moving)} publishers: {_publishers(moving)}',
                'the frame jumps between what they say, and tf2 drops what is older '
                '(TF_REPEATED_DATA, TF_OLD_DATA)',
                _for_two_owners(child, moving),
            )
        elif len(static) > 1 and not _are_same(static):
            yield error(
                'tf_two_publishers',
                f'the static transform {pair} is published with different values by '
                f'{_publishers(static)}',
                'which of them holds depends on who was started last',
                f'end all of these nodes but one: {_nodes(static)}',
            )


def tf_static_and_dynamic(seen: Observations) -> Iterator[Finding]:
    """
    A transform is either on /tf or on /tf_static.

    End the publisher that is wrong.
    """
    for child, edges in _children(seen):
        moving = [each for each in edges if not each.is_static]
        static = [each for each in edges if each.is_static]
        if moving and static and len({each.parent for each in edges}) == 1:
            yield error(
                'tf_static_and_dynamic',
                f"the transform '{edges[0].parent}' -> '{child}' is static, published by "
                f'{_publishers(static)}, and moves, published by {_publishers(moving)}',
                'tf2 takes whichever came last: the frame stands still or jumps',
                f'end {_nodes(static)}, if the frame moves; otherwise what publishes it on /tf',
            )


def tf_no_rotation(seen: Observations) -> Iterator[Finding]:
    """
    A rotation is a quaternion of length 1, a translation is finite.

    Nobody has set a rotation of zeros: ``w: 1`` is no rotation.
    """
    for child, edges in _children(seen):
        for each in edges:
            length = math.hypot(*each.rotation)
            numbers = (*each.rotation, *each.translation)
            if all(map(math.isfinite, numbers)) and abs(length - 1.0) <= _UNIT:
                continue
            what = f'is a quaternion of length {length:.3g}'
            if not all(map(math.isfinite, numbers)):
                what = 'has numbers that are none (NaN or infinite)'
            yield error(
                'tf_no_rotation',
                f"the transform '{each.parent}' -> '{child}' of {_publishers([each])} {what}",
                'tf2 drops such a transform, and the frame does not exist for anybody',
                f'normalize the rotation in {_nodes([each])}; that of no rotation is x: 0, y: 0, '
                'z: 0, w: 1',
            )


def tf_leading_slash(seen: Observations) -> Iterator[Finding]:
    """
    Names of frames have no leading slash.

    So it is since ROS 2.
    """
    for tree in _trees(seen):
        for publisher, edges in _by(tree.edges, lambda each: each.publisher).items():
            bad = sorted({each.child for each in edges if each.has_slash})
            if bad:
                yield warning(
                    'tf_leading_slash',
                    f'{publisher or "a node"} publishes frames with a leading slash: '
                    f'{_shortened("/" + each for each in bad)}',
                    'tf2 has none since ROS 2: who asks for the frame by this name gets an error',
                    f"write '{bad[0]}', and its parent, without the slash in the parameters of "
                    f'{publisher or "that node"}',
                )


def tf_future(seen: Observations) -> Iterator[Finding]:
    """
    Stamps are not of the future.

    They are more than 2 s (in a simulation 10 s) later than they come: a node on another clock.
    """
    for tree in _trees(seen):
        latest = _LATE[_is_simulated(seen)]
        early = [e for e in tree.edges if e.oldest is not None and e.oldest < -latest]
        for publisher, edges in _by(early, lambda each: each.publisher).items():
            lead = max(-each.oldest for each in edges if each.oldest is not None)
            yield error(
                'tf_future',
                f'{publisher or "a node"} stamps {_pairs(edges)} {_seconds(lead)} into the future',
                'nobody can transform anything of now with it, and what is right comes too late '
                'for tf2, which drops it (TF_OLD_DATA)',
                _for_other_clock(publisher, is_simulated=_is_simulated(seen)),
            )


def tf_stale(seen: Observations) -> Iterator[Finding]:
    """
    Stamps are not of the past.

    They are that much older than they come: a node without ``use_sim_time``, clocks of two
    machines apart, or a node that repeats old data.
    """
    for tree in _trees(seen):
        latest = _LATE[_is_simulated(seen)]
        late = [e for e in tree.edges if e.youngest is not None and e.youngest > latest]
        for publisher, edges in _by(late, lambda each: each.publisher).items():
            age = min(each.youngest for each in edges if each.youngest is not None)
            yield error(
                'tf_stale',
                f'the stamps of {_pairs(edges)} are {_seconds(age)} old when they come, published '
                f'by {publisher or "a node"}',
                'lookups at the time of a scan or a command fail: "extrapolation into the future"',
                _for_other_clock(publisher, is_simulated=_is_simulated(seen)),
            )


def tf_islands(seen: Observations) -> Iterator[Finding]:
    """
    The frames of one robot are one tree.

    A static transform connects them. Often a name is misspelt.
    """
    for tree in _trees(seen):
        islands = _components(tree)
        if len(islands) < 2 or _has_several_robots(seen) or not tree.is_complete:
            continue
        roots = sorted(islands, key=lambda root: -len(islands[root]))
        main, *others = roots
        # A frame of the same name but for a letter is what was meant.
        for root in others:
            meant = closest_match(root, sorted(islands[main]), 0.8)
            fix = (
                f"write '{meant}' in the place of '{root}' in {_owners(tree, root)}"
                if meant
                else f'ros2 run tf2_ros static_transform_publisher --frame-id {shlex.quote(main)} '
                f'--child-frame-id {shlex.quote(root)}'
            )
            below = islands[root] - {root}
            yield warning(
                'tf_islands',
                f"the frame '{root}', with {_shortened(sorted(below))}, is not connected with "
                f"'{main}' and the {len(islands[main]) - 1} frames below it",
                'nothing can be transformed between the two trees',
                fix,
            )


def joints_without_state(seen: Observations) -> Iterator[Finding]:
    """
    Each joint that moves has a state, or its links have no place.

    A simulation or robot has a ``joint_state_broadcaster``. To look at a URDF alone, use
    ``joint_state_publisher``.
    """
    if seen.description is None or seen.sensors is None or seen.transforms is None:
        return
    for topic in seen.description.topics:
        robot = seen.description.robot_in(topic.namespace)
        tree = seen.transforms.tree_of(topic.topic)
        if robot is None or tree is None or not tree.edges:
            continue
        sources = [each for each in seen.sensors.joints if _is_in(each.topic, topic.namespace)]
        known = {name for each in sources for name in each.names}
        missing = [
            joint
            for joint in robot.joints
            if _needs_state(joint)
            and joint.name not in known
            and joint.child not in tree.frames
            # frame_prefix may end with a slash, or not.
            and not any(frame.endswith(joint.child) for frame in tree.frames)
        ]
        if missing:
            topics = sorted({each.topic for each in sources})
            yield _without_state(seen, missing, topics, topic.namespace)


RULES: tuple[Rule, ...] = (
    tf_two_parents,
    tf_two_publishers,
    tf_static_and_dynamic,
    tf_no_rotation,
    tf_future,
    tf_stale,
    joints_without_state,
    tf_islands,
    tf_leading_slash,
)


def _without_state(
    seen: Observations, missing: list[Joint], topics: list[str], namespace: str
) -> Finding:
    names = _shortened(each.name for each in missing)
    number = f'the joint{"s" if len(missing) > 1 else ""} {names}'
    where = ' and '.join(topics)
    inside = f' --ros-args -r __ns:={namespace}' if namespace else ''
    managers = seen.controllers.managers if seen.controllers else ()
    manager = next((each.name for each in managers if each.namespace == namespace), '')
    if topics:  # joint_state_publisher would make up states of the other joints, too
        fix = (
            'give each a <state_interface name="position"/> in <ros2_control>, which the '
            'joint_state_broadcaster publishes, or type="fixed" where nothing measures it'
        )
    elif manager:
        fix = f'ros2 run controller_manager spawner joint_state_broadcaster -c {manager}'
    else:
        fix = f'ros2 run joint_state_publisher joint_state_publisher{inside}'
    return warning(
        'joints_without_state',
        f'nobody publishes {number} on {where}'
        if topics
        else f'nobody publishes joint states, and the robot has {number}',
        'robot_state_publisher cannot place the links below them: '
        + _shortened(each.child for each in missing),
        fix,
    )


def _needs_state(joint: Joint) -> bool:
    return joint.has_position and joint.is_moving and joint.mimic is None


def _is_in(topic: str, namespace: str) -> bool:
    """Return whether a topic is right below a namespace."""
    return topic.rpartition('/')[0] == namespace


def _trees(seen: Observations) -> tuple[Tree, ...]:
    return () if seen.transforms is None else seen.transforms.trees


def _is_simulated(seen: Observations) -> bool:
    return seen.transforms is not None and seen.transforms.is_simulated


def _has_several_robots(seen: Observations) -> bool:
    return seen.description is not None and len(seen.description.topics) > 1


def _children(seen: Observations) -> Iterator[tuple[str, list[Edge]]]:
    """Yield each frame of each tree with what is said of it."""
    for tree in _trees(seen):
        yield from _by(tree.edges, lambda each: each.child).items()


def _by(edges: Iterable[Edge], key: Callable[[Edge], str]) -> dict[str, list[Edge]]:
    found: dict[str, list[Edge]] = defaultdict(list)
    for each in edges:
        found[key(each)].append(each)
    return found


def _components(tree: Tree) -> dict[str, set[str]]:
    """Return what is connected: all frames, by the root with the most frames below it."""
    joined = {frame: {frame} for frame in tree.frames}
    for each in tree.edges:
        both = joined[each.parent] | joined[each.child]
        joined.update(dict.fromkeys(both, both))
    children = {each.child for each in tree.edges}
    parents = Counter(each.parent for each in tree.edges)
    found = {}
    for frames in {id(each): each for each in joined.values()}.values():
        roots = sorted(frames - children or frames)
        found[max(roots, key=lambda root: parents[root])] = frames
    return found


def _owners(tree: Tree, root: str) -> str:
    return _nodes([each for each in tree.edges if each.parent == root])


def _are_same(edges: list[Edge]) -> bool:
    first = edges[0]
    numbers = (*first.translation, *first.rotation)
    return all(
        math.isclose(one, other, abs_tol=_SAME_POSE)
        for each in edges[1:]
        for one, other in zip(numbers, (*each.translation, *each.rotation), strict=True)
    )


def _for_two_owners(child: str, edges: list[Edge]) -> str:
    """Return which of several publishers should cease, and how."""
    drives = [each for each in edges if _is_drive(each.publisher)]
    others = [each for each in edges if not _is_drive(each.publisher)]
    if not drives or not others:
        return f'end all but one of {_nodes(edges)}'
    drive, other = drives[0], others[0]
    if drive.parent == other.parent:
        return (
            f'set enable_odom_tf: false of {drive.publisher}, or publish_tf: false of '
            f'{_nodes([other])}'
        )
    if other.publisher.endswith('/robot_state_publisher'):
        return (
            f"have {drive.publisher} publish the transform of '{other.parent}' in the place of "
            f"'{child}': base_frame_id: {other.parent}"
        )
    return f"end {_nodes([other])}, or have it publish '{other.parent}' -> '{drive.parent}'"


def _is_drive(node: str) -> bool:
    return 'controller' in node.rpartition('/')[2]


def _for_other_clock(publisher: str, *, is_simulated: bool) -> str:
    if is_simulated:
        node = publisher or 'NODE'
        return f'ros2 param set {node} use_sim_time true, or restart it with -p use_sim_time:=true'
    return right_clock([publisher])


def _publishers(edges: Iterable[Edge]) -> str:
    return ' and '.join(dict.fromkeys(each.publisher or 'a node without a name' for each in edges))


def _nodes(edges: Iterable[Edge]) -> str:
    names = [each.publisher for each in edges if each.publisher]
    return ' and '.join(dict.fromkeys(names)) or 'its publisher'


def _pairs(edges: list[Edge]) -> str:
    return _shortened(f"'{each.parent}' -> '{each.child}'" for each in edges)


def _shortened(names: Iterable[str]) -> str:
    found = [*names]
    more = f' and {len(found) - _SHOWN} more' if len(found) > _SHOWN else ''
    return ', '.join(found[:_SHOWN]) + more


def _seconds(time: int) -> str:
    return f'{time / NANOSECONDS:.1f} s'
