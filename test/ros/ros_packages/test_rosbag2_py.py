# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``rosbag2_py``: what scripts write, and read again."""

import pytest
from rclpy.serialization import deserialize_message, serialize_message
from std_msgs.msg import String

from amr_description.ros_packages import rosbag2_py

CDR = rosbag2_py.ConverterOptions('cdr', 'cdr')
SECOND = 10**9


@pytest.fixture
def bag(tmp_path):
    """A bag: ``/a`` says 0 to 4 at each second, ``/b`` 10 to 14 half a second later."""
    writer = rosbag2_py.SequentialWriter()
    path = str(tmp_path / 'bag')
    writer.open(rosbag2_py.StorageOptions(uri=path, storage_id='mcap'), CDR)
    for number, name in enumerate(('/a', '/b')):
        writer.create_topic(
            rosbag2_py.TopicMetadata(
                id=number, name=name, type='std_msgs/msg/String', serialization_format='cdr'
            )
        )
    for second in range(5):
        for topic, first, late in (('/a', 0, 0), ('/b', 10, SECOND // 2)):
            message = serialize_message(String(data=str(first + second)))
            writer.write(topic, message, second * SECOND + late)
    with pytest.raises(
        RuntimeError, match=r"Failed to write on topic '/c'. Call create_topic\(\)"
    ):
        writer.write('/c', b'', 0)
    writer.close()
    return path


@pytest.fixture
def reader(bag):
    made = rosbag2_py.SequentialReader()
    made.open(rosbag2_py.StorageOptions(uri=bag, storage_id='mcap'), CDR)
    yield made
    made.close()


def rest(reader):
    found = []
    while reader.has_next():
        _, data, _ = reader.read_next()
        found.append(int(deserialize_message(data, String).data))
    return found


def test_a_bag_is_read_as_it_was_written(reader):
    topics = reader.get_all_topics_and_types()
    assert {each.name: each.type for each in topics} == dict.fromkeys(
        ('/a', '/b'), 'std_msgs/msg/String'
    )
    topic, data, stamp = reader.read_next()
    assert (topic, deserialize_message(data, String).data, stamp) == ('/a', '0', 0)
    assert rest(reader) == [10, 1, 11, 2, 12, 3, 13, 4, 14]
    with pytest.raises(RuntimeError, match='No next message'):
        reader.read_next()


def test_topics_are_chosen_from_here_on(reader):
    reader.read_next()
    reader.set_filter(rosbag2_py.StorageFilter(topics=['/b']))
    assert rest(reader) == [10, 11, 12, 13, 14]
    reader.reset_filter()
    reader.seek(3 * SECOND)
    assert rest(reader) == [3, 13, 4, 14]
    reader.set_filter(rosbag2_py.StorageFilter(topics_regex='/[ab]', exclude_topics=['/b']))
    reader.seek(0)
    assert rest(reader) == [0, 1, 2, 3, 4]


def test_it_is_read_backwards(reader):
    order = rosbag2_py.ReadOrder(rosbag2_py.ReadOrderSortBy.ReceivedTimestamp, reverse=True)
    assert reader.set_read_order(order)
    assert rest(reader) == [14, 4, 13, 3, 12, 2, 11, 1, 10, 0]
    reader.seek(SECOND)
    assert rest(reader) == [1, 10, 0]


def test_what_a_bag_is_made_of(bag, reader):
    told = rosbag2_py.Info().read_metadata(bag, 'mcap')
    assert told == reader.get_metadata()
    assert (told.message_count, told.storage_identifier) == (10, 'mcap')
    assert told.duration.nanoseconds == 4 * SECOND + SECOND // 2
    counts = {
        each.topic_metadata.name: each.message_count for each in told.topics_with_message_count
    }
    assert counts == {'/a': 5, '/b': 5}
    assert {'mcap', 'sqlite3'} <= rosbag2_py.get_registered_readers()


def test_a_preset_that_the_storage_does_not_have_is_told(tmp_path):
    every = {'mcap': 'none, fastwrite, zstd_fast, zstd_small', 'sqlite3': 'none'}
    for storage, known in every.items():
        wanted = rosbag2_py.StorageOptions(
            uri=str(tmp_path / 'bag'), storage_id=storage, storage_preset_profile='x'
        )
        with pytest.raises(RuntimeError, match=f'{storage}: want one of {known}, not "x"'):
            rosbag2_py.SequentialWriter().open(wanted, rosbag2_py.ConverterOptions('cdr', 'cdr'))
        assert not (tmp_path / 'bag').exists()


def test_what_cannot_be_opened_says_why(tmp_path):
    reader = rosbag2_py.SequentialReader()
    with pytest.raises(RuntimeError, match='Bag is not open'):
        reader.has_next()
    with pytest.raises(RuntimeError, match='No such bag'):
        reader.open_uri(str(tmp_path / 'none'))
    writer = rosbag2_py.SequentialWriter()
    with pytest.raises(RuntimeError, match='format cdr'):
        writer.open(
            rosbag2_py.StorageOptions(str(tmp_path / 'x')), rosbag2_py.ConverterOptions('json')
        )
