# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Various topic related sub-commands."""

import argparse

VERBS = {
    'bw': 'amr_description.cli.topic.rates:BwVerb',
    'delay': 'amr_description.cli.topic.rates:DelayVerb',
    'echo': 'amr_description.cli.topic.echo',
    'find': 'amr_description.cli.graph_verbs:TOPIC_FIND',
    'hz': 'amr_description.cli.topic.rates:HzVerb',
    'info': 'amr_description.cli.graph_verbs:TopicInfo',
    'list': 'amr_description.cli.graph_verbs:TOPIC_LIST',
    'pub': 'amr_description.cli.topic.pub',
    'type': 'amr_description.cli.graph_verbs:TOPIC_TYPE',
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what every verb of ``ros2 topic`` reads."""
    parser.add_argument(
        '--include-hidden-topics', action='store_true', help='Consider hidden topics as well'
    )
