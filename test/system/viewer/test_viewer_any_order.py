# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Two robots of one kind, spawned, deleted, renamed, moved to other worlds, in whatever order.

What a page grasps, pushes, places or drives is the robot that it means, and no other one moves.
Robots of a kind have one URDF, so that nothing in it tells them apart; the names of entities are
drawn, so that the name of one may be the namespace of the other.
"""

import math

from hypothesis import Phase, strategies as st
from hypothesis.stateful import (
    precondition,
    rule,
    RuleBasedStateMachine,
    run_state_machine_as_test,
)
import pytest
from support.examples import examples
from test_viewer_simulation import (
    Asker,
    CONTROLLERS,
    distance,
    drive_until,
    entities_of,
    height,
    page_of_walls,
    place,
    robot,
    SIMULATOR,
    simulators,
    states_of,
)

HOMES = {'/': -0.8, '/amr': 0.8}
"""The namespaces of the robots; x of where they are spawned, m."""
NAMES = ('amr', 'robot1', 'robot2')
FAR = 0.05
"""m that one has moved."""
STILL = 0.02
"""m that one may, which nobody moves."""


@pytest.fixture(scope='module')
def page():
    with page_of_walls() as page:
        yield page


class AnyOrder(RuleBasedStateMachine):
    """What a page asks, and what is known of the world: the entity of each namespace."""

    page = ask = None

    def __init__(self):
        super().__init__()
        self.entities = {}

    def teardown(self):
        for namespace in [*self.entities]:
            self.delete(namespace)

    def settled(self):
        """Wait until the page is told of exactly these robots, each with its own entity."""

        def is_told():
            told = {name: each for name, each in entities_of(self.page).items() if each}
            return told == self.entities and all(place(self.page, each) for each in told)

        self.page.wait(is_told)

    def others_stand(self, moved, act):
        """Do something to one robot; nothing happens to the others."""
        others = [each for each in self.entities if each != moved]
        before = {each: self.where(each) for each in others}
        act()
        for each in others:
            assert distance(self.page, each, before[each]) < STILL, each
            assert abs(height(self.page, each)) < STILL, each

    def is_at_home(self, namespace):
        """Whether a robot is where it was spawned, its controllers active."""
        active = dict.fromkeys(CONTROLLERS, 'active')
        is_there = distance(self.page, namespace, (HOMES[namespace], 0.5)) < STILL
        return is_there and states_of(self.page, namespace) == active

    def where(self, namespace):
        return self.page.wait(lambda: place(self.page, namespace))

    def some(self, data):
        return data.draw(st.sampled_from(sorted(self.entities)))

    # --- who is there ----------------------------------------------------------------------------

    @precondition(lambda self: len(self.entities) < len(HOMES))
    @rule(data=st.data())
    def spawn(self, data):
        namespace = data.draw(st.sampled_from(sorted(HOMES.keys() - self.entities.keys())))
        name = data.draw(st.sampled_from(sorted({*NAMES} - {*self.entities.values()})))
        active = f"'{name}' is in the world; active: {', '.join(CONTROLLERS)}"
        assert self.ask.spawn(name, namespace, HOMES[namespace]) == (True, active)
        self.entities[namespace] = name
        self.settled()
        self.page.wait(lambda: robot(self.page, namespace)['command'])

    @precondition(lambda self: self.entities)
    @rule(data=st.data())
    def leave(self, data):
        namespace = self.some(data)
        self.others_stand(namespace, lambda: self.delete(namespace))

    def delete(self, namespace):
        name = self.entities.pop(namespace)
        assert self.ask.simulator('delete', name=name) == (True, f"'{name}' has left the world")
        self.settled()

    @precondition(lambda self: self.entities)
    @rule(world=st.sampled_from(['walls', 'empty']))
    def change_the_world(self, world):
        assert self.ask.simulator('load_world', name=world)[0]
        self.page.wait(lambda: simulators(self.page)[0]['world'] == world)
        self.page.wait(lambda: all(map(self.is_at_home, self.entities)))
        self.settled()

    # --- what is done to one ---------------------------------------------------------------------

    @precondition(lambda self: self.entities)
    @rule(data=st.data())
    def drive(self, data):
        namespace = self.some(data)
        assert self.ask.simulator('reset_entity', name=self.entities[namespace])[0]
        start = (HOMES[namespace], 0.5)
        self.page.wait(lambda: distance(self.page, namespace, start) < STILL)

        def act():
            drive_until(self.page, namespace, lambda: distance(self.page, namespace, start) > FAR)

        self.others_stand(namespace, act)

    @precondition(lambda self: self.entities)
    @rule(data=st.data())
    def push(self, data):
        namespace = self.some(data)
        entity = robot(self.page, namespace)['entity']  # as the page itself does

        def is_lifted():
            force = {'force': [0.0, 0.0, 200.0], 'torque': [0.0] * 3}
            about = {'simulator': entity['simulator'], 'entity': entity['name']}
            self.page.say('push', link='base_link', **about, **force)
            return height(self.page, namespace) > 0.1

        self.others_stand(namespace, lambda: self.page.wait(is_lifted))
        self.page.wait(lambda: height(self.page, namespace) < FAR)

    @precondition(lambda self: self.entities)
    @rule(data=st.data(), y=st.sampled_from([-1.0, 0.5, 1.2]))
    def put(self, data, y):
        namespace = self.some(data)
        there = (HOMES[namespace], y)
        entity = robot(self.page, namespace)['entity']

        def act():
            where = {'position': [*there, 0.0], 'yaw': math.pi / 2}
            assert self.ask('place', **entity, **where)[0]
            self.page.wait(lambda: distance(self.page, namespace, there) < STILL)

        self.others_stand(namespace, act)


def test_what_a_page_does_to_a_robot_is_done_to_that_one(page):
    AnyOrder.page, AnyOrder.ask = page, Asker(page)
    assert page.last('graph')['simulators'][0]['id'] == SIMULATOR
    once = {'phases': [Phase.generate], 'report_multiple_bugs': False}  # time goes on
    run_state_machine_as_test(AnyOrder, settings=examples(1, stateful_step_count=12, **once))
