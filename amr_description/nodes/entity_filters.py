# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Which entities a ``simulation_interfaces/msg/EntityFilters`` means."""

from collections.abc import Collection, Iterable
import math

from simulation_interfaces.msg import Bounds, EntityFilters, Result, TagsFilter

from amr_description.errors import RequestError, UsageError
from amr_description.nodes.posix_regex import PosixRegex
from amr_description.nodes.robots import Entity
from amr_description.sim.entity_state import Box


def chosen(entities: Iterable[Entity], filters: EntityFilters) -> list[Entity]:
    """
    Those that meet name, categories and tags; bounds are another matter.

    Raises RequestError: the name is no regular expression.
    """
    categories = [each.category for each in filters.categories]
    try:
        with PosixRegex(filters.filter) as names:
            return [
                entity
                for entity in entities
                if (not filters.filter or names.is_in(entity.name))
                and (not categories or entity.info.category in categories)
                and has_tags(entity.info.tags, filters.tags)
            ]
    except UsageError as error:
        raise RequestError(f'filter: {error}', Result.RESULT_OPERATION_FAILED) from error


def has_tags(tags: Collection[str], wanted: TagsFilter) -> bool:
    """Whether one of the wanted tags is there, or all of them, as it says; none: always."""
    if not wanted.tags:
        return True
    found = [tag in tags for tag in wanted.tags]
    return all(found) if wanted.filter_mode == TagsFilter.FILTER_MODE_ALL else any(found)


def check_bounds(bounds: Bounds) -> None:
    """Raises RequestError: a kind that is not known here, or points that make none."""
    if bounds.type not in (Bounds.TYPE_EMPTY, Bounds.TYPE_BOX, Bounds.TYPE_SPHERE):
        raise RequestError(
            f'bounds of type {bounds.type} are asked; EMPTY (0), BOX (1) and SPHERE (3) are known',
            Result.RESULT_FEATURE_UNSUPPORTED,
        )
    if bounds.type != Bounds.TYPE_EMPTY and len(bounds.points) != 2:
        raise RequestError(
            f'bounds have {len(bounds.points)} points; two are needed: opposite corners of a box, '
            'or the centre of a sphere and its radius in x',
            Result.RESULT_OPERATION_FAILED,
        )


def overlaps(box: Box | None, bounds: Bounds) -> bool:
    """Whether a box (in the world) and checked ``bounds`` have a point in common; none: none."""
    if box is None:
        return False
    first, second = ((point.x, point.y, point.z) for point in bounds.points)
    sides = list(zip(box.lower, box.upper, strict=True))
    if bounds.type == Bounds.TYPE_SPHERE:
        nearest = [min(max(c, low), high) for c, (low, high) in zip(first, sides, strict=True)]
        return math.dist(first, nearest) <= second[0]
    return all(
        low <= max(a, b) and min(a, b) <= high
        for (low, high), a, b in zip(sides, first, second, strict=True)
    )
