# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Which entities a filter means."""

from geometry_msgs.msg import Vector3
from hypothesis import given
from hypothesis.strategies import integers, tuples
import pytest
from simulation_interfaces.msg import Bounds, EntityCategory, EntityFilters, TagsFilter

from amr_description.errors import RequestError
from amr_description.sim.entity_state import BoundingBox
from amr_description.sim.ros.entities import Category, Entity, EntityRecord
from amr_description.sim.ros.entity_services import check_bounds, has_tags, matching, overlaps

ENTITIES = [
    Entity('amr_1', EntityRecord(Category.ROBOT, tags=('fast', 'red')), None, None),
    Entity('amr_2', EntityRecord(Category.ROBOT, tags=('red',)), None, None),
    Entity('crate', EntityRecord(Category.DYNAMIC_OBJECT), None, None),
]
UNIT = BoundingBox((0.0, 0.0, 0.0), (1.0, 1.0, 1.0))
eighths = integers(-24, 24).map(lambda n: n / 8)  # sums of their squares are exact
coordinates = tuples(*[eighths] * 3)


def names(**fields):
    return [entity.name for entity in matching(ENTITIES, EntityFilters(**fields))]


def bounds(kind, *points):
    return Bounds(type=kind, points=[Vector3(x=x, y=y, z=z) for x, y, z in points])


def test_no_filter_means_all():
    assert names() == ['amr_1', 'amr_2', 'crate']


def test_filters_apply_together():
    robots = [EntityCategory(category=EntityCategory.CATEGORY_ROBOT)]
    assert names(filter='[12c]') == ['amr_1', 'amr_2', 'crate']
    assert names(filter='[12c]', categories=robots) == ['amr_1', 'amr_2']
    assert names(filter='[1c]', categories=robots, tags=TagsFilter(tags=['red'])) == ['amr_1']


def test_tags_any_or_all():
    both = ['fast', 'red']
    assert names(tags=TagsFilter(tags=both)) == ['amr_1', 'amr_2']
    assert names(tags=TagsFilter(tags=both, filter_mode=TagsFilter.FILTER_MODE_ALL)) == ['amr_1']
    assert has_tags((), TagsFilter(filter_mode=TagsFilter.FILTER_MODE_ALL))


def test_an_invalid_expression_is_rejected():
    with pytest.raises(
        RequestError, match="filter: '\\(' is no POSIX extended regular"
    ) as refusal:
        names(filter='(')
    assert refusal.value.code == 4


@given(coordinates, coordinates)
def test_a_box_overlaps_another_whichever_corners_are_given(a, b):
    far = any(max(p, q) < 0 or min(p, q) > 1 for p, q in zip(a, b, strict=True))
    assert overlaps(UNIT, bounds(Bounds.TYPE_BOX, a, b)) is not far
    assert overlaps(UNIT, bounds(Bounds.TYPE_BOX, b, a)) is not far


@given(coordinates, eighths.map(abs))
def test_a_sphere_overlaps_where_the_nearest_point_of_the_box_is_in_it(centre, radius):
    gaps = [max(0.0 - c, 0.0, c - 1.0) for c in centre]
    inside = sum(gap * gap for gap in gaps) <= radius * radius
    assert overlaps(UNIT, bounds(Bounds.TYPE_SPHERE, centre, (radius, 0.0, 0.0))) is inside


def test_an_entity_without_geoms_overlaps_nothing():
    assert not overlaps(None, bounds(Bounds.TYPE_SPHERE, (0.0, 0.0, 0.0), (9.0, 0.0, 0.0)))


def test_bounds_that_are_unknown_or_no_bounds_are_refused():
    check_bounds(Bounds())
    with pytest.raises(RequestError, match='bounds of type 2 are asked') as refusal:
        check_bounds(Bounds(type=Bounds.TYPE_CONVEX_HULL))
    assert refusal.value.code == 0
    with pytest.raises(RequestError, match='bounds have 1 points; two are needed'):
        check_bounds(bounds(Bounds.TYPE_SPHERE, (0.0, 0.0, 0.0)))
