# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``map``, ``initialpose``, ``map → odom``, and the footprint of the costmaps."""

from collections.abc import Mapping
from itertools import pairwise
import json
import math

from amr_description.navigation.contract.findings import (
    CheckOutcome,
    failed,
    not_checked,
    outcome,
    passed,
)
from amr_description.navigation.contract.frame_rules import ancestors, parents
from amr_description.navigation.contract.observations import (
    Body,
    ContractObservations,
    ContractTopic,
    GRID_TYPE,
    POSE_TYPE,
)
from amr_description.navigation.contract.series import names_of

DEFAULT_RADIUS = 0.22
"""m: ``robot_radius`` in the costmaps of nav2_bringup's nav2_params.yaml."""

_TOLERANCE = 0.006
"""m: the polygon that is made of collisions is up to 5 mm too large."""
_NO_MAP = 'not there; slam_toolbox or map_server publishes it'


def map_published(seen: ContractObservations) -> CheckOutcome:
    """The static layer and AMCL subscribe reliably with transient local durability."""
    topic = seen.map
    if not topic.publishers:
        return not_checked(_NO_MAP)
    wrong = [each for each in topic.publishers if each.type_name != GRID_TYPE]
    if wrong:
        return failed(f'{names_of(wrong)} publishes {wrong[0].type_name}', f'use {GRID_TYPE}')
    unfit = [each for each in topic.publishers if not (each.is_reliable and each.is_latched)]
    if unfit:
        return failed(
            f'{names_of(unfit)} does not publish it reliable and transient local',
            'publish with QoS(1), reliable, transient_local; or set '
            'map_subscribe_transient_local: false in the static layers',
        )
    grid = seen.map_seen
    if grid is None:
        return failed(
            f'{names_of(topic.publishers)} has published no map in {seen.seconds:.0f} s',
            'activate map_server (lifecycle_manager), or let slam_toolbox get scans',
        )
    is_whole = grid.cells == grid.width * grid.height > 0 and grid.resolution > 0.0
    text = f'{grid.width} x {grid.height} cells of {grid.resolution:g} m in {grid.frame!r}'
    if not is_whole:
        return failed(f'{text}, with {grid.cells} values', 'publish width x height values')
    return outcome(
        grid.frame == seen.frames.map,
        f'{text} by {names_of(topic.publishers)}',
        f"publish it in '{seen.frames.map}', or give --map-frame",
    )


def initial_pose(seen: ContractObservations) -> CheckOutcome:
    """RViz and the page set where the robot is; AMCL waits for it."""
    topic: ContractTopic = seen.initial_pose
    if not topic.subscriptions:
        return not_checked('nobody subscribes; amcl or another localisation does')
    wrong = [each for each in topic.subscriptions if each.type_name != POSE_TYPE]
    return outcome(
        not wrong,
        f'{names_of(wrong)} subscribes to {wrong[0].type_name}'
        if wrong
        else f'{names_of(topic.subscriptions)} on {topic.name}',
        f'use {POSE_TYPE}',
    )


def map_to_odom(seen: ContractObservations) -> CheckOutcome:
    """Who localises publishes it, and goals on the map need it."""
    names, tree = seen.frames, parents(seen)
    way = list(ancestors(tree, names.odom))
    if not way:
        return not_checked('not there; amcl, slam_toolbox or another localisation publishes it')
    if way[-1].parent != names.map and names.map not in {each.parent for each in way}:
        return failed(
            f'{names.odom} is below {way[0].parent}, and {names.map} is not above it',
            f"let the localisation publish '{names.map}' → '{names.odom}', or give --map-frame",
        )
    return passed(' → '.join([*(each.parent for each in reversed(way)), names.odom]))


def footprint(seen: ContractObservations) -> CheckOutcome:
    """What a costmap takes for the robot has to hold all that can collide."""
    body = seen.body
    if body is None or body.radius is None:
        why = body.fault if body else 'no robot_description came that can be read'
        return not_checked(why, 'start robot_state_publisher' if body is None else '')
    polygon = ', '.join(f'[{x:g}, {y:g}]' for x, y in body.polygon)
    advice = f'set footprint: "[{polygon}]" in both costmaps'
    text = f'the collisions reach {body.radius:.3f} m from {seen.frames.base}'
    costmaps = {
        node: values for node, values in seen.parameters.items() if 'robot_radius' in values
    }
    if not costmaps:
        is_wider = body.radius > DEFAULT_RADIUS + _TOLERANCE
        default = f', and robot_radius is {DEFAULT_RADIUS:g} by default' if is_wider else ''
        return not_checked(f'no costmap is there; {text}{default}', advice)
    wrong = [fault for node, values in costmaps.items() if (fault := _fault(node, values, body))]
    return outcome(not wrong, '; '.join([text, *wrong]), advice)


def _fault(node: str, values: Mapping[str, object], body: Body) -> str:
    """Return how a costmap takes the robot for smaller than it is; '' if it does not."""
    text, radius = values.get('footprint'), values['robot_radius']
    assert body.radius is not None, 'it was looked at'
    if not isinstance(text, str) or text.strip() in ('', '[]'):
        is_enough = isinstance(radius, int | float) and radius >= body.radius - _TOLERANCE
        return '' if is_enough else f'{node} has robot_radius {radius}'
    try:
        corners = [(float(x), float(y)) for x, y in json.loads(text)]
    except (TypeError, ValueError):
        return f'{node} has a footprint that is none: {text}'
    outside = max(_distance_outside(point, corners) for point in body.polygon)
    return '' if outside <= _TOLERANCE else f'{outside:.3f} m are outside of that of {node}'


def _distance_outside(point: tuple[float, float], corners: list[tuple[float, float]]) -> float:
    """Return how far a point is from a polygon, m; 0: it is inside, or there is no polygon."""
    x, y = point
    is_inside, nearest = False, math.inf
    for (x1, y1), (x2, y2) in pairwise([*corners, *corners[:1]]):
        if (y1 > y) != (y2 > y) and x < x1 + (y - y1) / (y2 - y1) * (x2 - x1):
            is_inside = not is_inside
        length = math.hypot(x2 - x1, y2 - y1)
        along = ((x - x1) * (x2 - x1) + (y - y1) * (y2 - y1)) / length if length else 0.0
        ratio = min(1.0, max(0.0, along / length)) if length else 0.0
        nearest = min(nearest, math.hypot(x - x1 - ratio * (x2 - x1), y - y1 - ratio * (y2 - y1)))
    return 0.0 if is_inside or not corners else nearest
