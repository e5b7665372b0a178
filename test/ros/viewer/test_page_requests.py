# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What carries out the requests of pages over a ROS graph: none is forgotten."""

import asyncio
from typing import get_args

import pytest
import rclpy
from rclpy.executors import SingleThreadedExecutor

from amr_description.errors import ViewerError
from amr_description.viewer.bags import Playback, ReadOverview, ReadSeries, Seek
from amr_description.viewer.requests import Request, Step
from amr_description.viewer.ros.backend import GraphBackend

OF_A_BAG = {Playback, ReadOverview, ReadSeries, Seek}


@pytest.fixture
def backend(tmp_path):
    context = rclpy.Context()
    rclpy.init(context=context)
    node = rclpy.create_node('viewer', context=context)
    executor = SingleThreadedExecutor(context=context)
    yield GraphBackend(node, executor, pytest.fail, pytest.fail, tmp_path)
    executor.shutdown()
    node.destroy_node()
    context.shutdown()


def test_each_request_has_its_handler_but_those_of_a_bag_that_is_shown(backend):
    assert set(get_args(Request)) - backend.handlers._handlers.keys() == OF_A_BAG


@pytest.mark.parametrize(
    ('request_', 'reason'),
    [
        (Seek(1, 0.5), r'no bag is shown here; `viewer --bag PATH` shows one'),
        (Step(1, '/sim', 3), "there is no simulator '/sim'; there are: none"),
    ],
)
def test_what_cannot_be_carried_out_is_refused(backend, request_, reason):
    with pytest.raises(ViewerError, match=reason):
        asyncio.run(backend.handlers.carry_out(request_, 'page 1'))


@pytest.mark.parametrize(
    ('action', 'is_refused'),
    [('/robot1/dock', True), ('/dock', False), ('/robot10/dock', False)],
)
def test_no_goal_is_sent_by_a_form_into_the_namespace_of_a_robot_that_is_stopped(
    backend, monkeypatch, action, is_refused
):
    monkeypatch.setattr(GraphBackend, '_robots', dict.fromkeys(['/', '/robot1', '/robot10']))
    backend._ros.held = frozenset({'/robot1'})
    refusal = backend._goal_refusal(action)
    wanted = f'/robot1 is stopped: no goal is sent to {action} until it is released'
    assert refusal == (wanted if is_refused else None)
