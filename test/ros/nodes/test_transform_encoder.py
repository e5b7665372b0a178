# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The bytes of transforms against rclpy's serialization of the message."""

from hypothesis import given, strategies as st
import pytest
from rclpy.serialization import deserialize_message
from support.examples import examples
from tf2_msgs.msg import TFMessage

from amr_description.model.frames import Transform
from amr_description.nodes.robot_state_publisher import transforms
from amr_description.nodes.robot_state_publisher.robot_state import LinkTransform
from amr_description.nodes.robot_state_publisher.transforms import TransformEncoder

NUMBERS = st.floats(allow_nan=False)
NAMES = st.text(st.characters(exclude_categories=['Cs', 'Cc']), max_size=9)
POSES = st.builds(
    Transform, st.tuples(NUMBERS, NUMBERS, NUMBERS), st.tuples(NUMBERS, NUMBERS, NUMBERS, NUMBERS)
)
LINKS = st.lists(
    st.builds(LinkTransform, NAMES, NAMES, POSES),
    min_size=1,
    max_size=4,
    unique_by=lambda link: link.child,
)
STAMPS = st.integers(-(2**31) * 10**9, 2**31 * 10**9 - 1)


@examples(60)
@given(NAMES, LINKS, POSES, STAMPS, STAMPS)
def test_the_bytes_are_those_of_the_message_whatever_has_changed(
    prefix, links, pose, stamp, later
):
    encoder = TransformEncoder(prefix)
    moved = [LinkTransform(link.parent, link.child, pose) for link in links]
    for each, time in ((links, stamp), (moved, later)):
        data = encoder.encode(each, time)
        assert isinstance(data, bytes)
        assert deserialize_message(data, TFMessage) == encoder.message(each, time)


def test_sets_of_links_are_told_apart_however_many_there_are():
    encoder = TransformEncoder()
    links = [LinkTransform('base', f'link{index}', Transform()) for index in range(100)]
    for _ in range(2):
        for link in links:
            data = encoder.encode([link], 5)
            assert deserialize_message(data, TFMessage) == encoder.message([link], 5)


def test_messages_are_sent_where_the_middleware_writes_other_bytes(monkeypatch):
    monkeypatch.setattr(transforms.Template, 'has_made', lambda *_: False)
    encoder = TransformEncoder()
    links = [LinkTransform('base', 'wheel', Transform((1.0, 2.0, 3.0)))]
    assert encoder.encode(links, 7) == encoder.message(links, 7)


@pytest.mark.parametrize('prefix', ['', 'robot1/'])
def test_frames_have_the_prefix(prefix):
    (transform,) = (
        TransformEncoder(prefix)
        .message([LinkTransform('base', 'wheel', Transform())], 0)
        .transforms
    )
    assert transform.header.frame_id == f'{prefix}base'
    assert transform.child_frame_id == f'{prefix}wheel'
