# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Which topics the flags of a command line mean."""

import pytest

from amr_description.bag.storage import TopicMetadata
from amr_description.bag.topic_selection import TopicSelection
from amr_description.errors import UsageError

TOPICS = [
    TopicMetadata('/scan', 'sensor_msgs/msg/LaserScan'),
    TopicMetadata('/scan_raw', 'sensor_msgs/msg/LaserScan'),
    TopicMetadata('/tf', 'tf2_msgs/msg/TFMessage'),
    TopicMetadata('/add/_service_event', 'example_interfaces/srv/AddTwoInts_Event'),
]


@pytest.mark.parametrize(
    ('flags', 'meant'),
    [
        ({}, ['/scan', '/scan_raw', '/tf', '/add/_service_event']),
        ({'topics': ['scan', '/none']}, ['/scan']),
        ({'services': ['/add']}, ['/add/_service_event']),
        ({'topics': ['/tf'], 'regex': '/scan'}, ['/scan', '/tf']),
        ({'regex': '/scan.*'}, ['/scan', '/scan_raw']),
        ({'exclude_regex': '/scan'}, ['/scan_raw', '/tf', '/add/_service_event']),
        ({'exclude_topics': ['tf', '/scan']}, ['/scan_raw', '/add/_service_event']),
        ({'exclude_services': ['add']}, ['/scan', '/scan_raw', '/tf']),
        ({'topics': ['/scan', '/tf'], 'exclude_topics': ['/tf']}, ['/scan']),
    ],
)
def test_flags_mean_these_topics(flags, meant):
    selection = TopicSelection(**flags)
    assert [topic.name for topic in TOPICS if selection.holds(topic)] == meant


def test_an_expression_that_is_none_is_named():
    with pytest.raises(UsageError, match=r'--exclude-regex: "\*" is no regular expression: '):
        TopicSelection(exclude_regex='*')
