# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The file ``--output-options`` of ``ros2 bag convert``: what bags are written, and how."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from amr_description.bag import yaml_text
from amr_description.bag.mcap_writer import WriterOptions
from amr_description.bag.reader import STORAGES
from amr_description.bag.rewriting import RewrittenBag
from amr_description.bag.storage import TopicMetadata
from amr_description.bag.topic_filter import TopicFilter
from amr_description.bag.topic_selection import full_name
from amr_description.bag.yaml_text import shown
from amr_description.errors import BagError
from amr_description.text import did_you_mean, quote

_DEFAULTS: dict[str, Any] = {
    'uri': '',
    'storage_id': '',
    'max_bagfile_size': 0,
    'max_bagfile_duration': 0,
    'storage_preset_profile': '',
    'custom_data': {},
    'start_time_ns': -1,
    'end_time_ns': -1,
    'all': False,
    'all_topics': False,
    'all_services': False,
    'topics': [],
    'topic_types': [],
    'services': [],
    'regex': '',
    'exclude_regex': '',
    'exclude_topics': [],
    'exclude_topic_types': [],
    'exclude_services': [],
    'include_hidden_topics': True,
    'rmw_serialization_format': '',
    'compression_mode': '',
    'compression_format': '',
}
_NAMES = ('topics', 'services', 'exclude_topics', 'exclude_services')
_AS_THEY_ARE = (
    'topic_types',
    'exclude_topic_types',
    'regex',
    'exclude_regex',
    'include_hidden_topics',
)
# Of the original, and without a meaning here: about recording, threads and caches.
_WITHOUT_EFFECT = {
    'max_cache_size', 'storage_config_uri', 'snapshot_mode', 'is_discovery_disabled',
    'topic_polling_interval', 'node_prefix', 'compression_queue_size', 'compression_threads',
    'compression_threads_priority', 'topic_qos_profile_overrides',
    'include_unpublished_topics', 'ignore_leaf_topics', 'start_paused', 'use_sim_time',
    'disable_keyboard_controls',
}  # fmt: skip


def read_outputs(path: str) -> list[RewrittenBag]:
    """Return the bags that a file asks for. Raises BagError, which begins with ``path``."""
    try:
        text = Path(path).read_text()
    except OSError as error:
        raise BagError(f'{path}: {error.strerror}') from error
    except UnicodeDecodeError as error:
        raise BagError(f'{path}: {error}') from error
    node = yaml_text.load(text, path)
    bags = node.get('output_bags') if isinstance(node, Mapping) else None
    if not isinstance(bags, list) or not bags:
        raise BagError(f'{path}: want a sequence of bags under the only key, output_bags')
    return [_output(bag, f'{path}: output_bags[{number}]') for number, bag in enumerate(bags)]


def _output(bag: Any, what: str) -> RewrittenBag:
    values = _values(bag, what)
    if not values['uri']:
        raise BagError(f'{what}: uri is missing: the folder of the bag')
    for name in ('storage_id', 'rmw_serialization_format', 'compression_format'):
        known = {'storage_id': [*STORAGES], 'compression_format': ['zstd']}.get(name, ['cdr'])
        if values[name] not in ('', *known):
            raise BagError(
                f'{what}: {name}: {" or ".join(known)} is written, not {quote(values[name])}'
            )
    mode = values['compression_mode'].lower()
    if mode not in ('', 'none', 'file'):
        raise BagError(
            f'{what}: compression_mode: want none or file, not {quote(mode)}: MCAP has no '
            'messages that are compressed one by one; see storage_preset_profile: zstd_fast'
        )
    try:
        writer = WriterOptions(
            storage=values['storage_id'] or 'mcap',
            preset=values['storage_preset_profile'] or 'none',
            max_bag_size=values['max_bagfile_size'],
            max_bag_duration=values['max_bagfile_duration'] * 10**9,
            compress_files=mode == 'file',
            custom_data={str(key): str(each) for key, each in values['custom_data'].items()},
        )
    except BagError as error:
        raise BagError(f'{what}: {error}') from error
    return RewrittenBag(
        Path(values['uri']),
        holds=_selection(values, what),
        start=values['start_time_ns'] if values['start_time_ns'] >= 0 else None,
        end=values['end_time_ns'] if values['end_time_ns'] >= 0 else None,
        writer=writer,
    )


def _values(bag: Any, what: str) -> dict[str, Any]:
    if not isinstance(bag, Mapping):
        raise BagError(f'{what}: want a mapping with uri and others, not {shown(bag)}')
    values = dict(_DEFAULTS)
    for name, value in bag.items():
        if name in _WITHOUT_EFFECT:
            continue
        if name not in values:
            known = [*_DEFAULTS, *sorted(_WITHOUT_EFFECT)]
            raise BagError(
                f'{what}: there is no option {quote(str(name))}{did_you_mean(str(name), known)}'
            )
        wanted = type(_DEFAULTS[name])
        if type(value) is not wanted:
            raise BagError(f'{what}: {name}: want a {wanted.__name__}, not {shown(value)}')
        words = value.values() if wanted is dict else value if wanted is list else ()
        if not all(isinstance(each, str) for each in words):
            raise BagError(f'{what}: {name}: want texts in it, not {shown(value)}')
        values[name] = value
    return values


def _selection(values: Mapping[str, Any], what: str) -> Callable[[TopicMetadata], bool]:
    """Return whether a topic is asked for: as the recorder chooses, but hidden ones, too."""
    includes = ('all', 'all_topics', 'all_services', 'topics', 'topic_types', 'services', 'regex')
    if not any(values[name] for name in includes):
        raise BagError(
            f'{what}: no topic is asked for: say all_topics: true, or topics: [/scan, /tf]'
        )
    full: dict[str, Any] = {name: [full_name(each) for each in values[name]] for name in _NAMES}
    given = {name: values[name] for name in _AS_THEY_ARE}
    try:
        wanted = TopicFilter(
            all_topics=values['all'] or values['all_topics'],
            all_services=values['all'] or values['all_services'],
            **full,
            **given,
        )
    except BagError as error:
        raise BagError(f'{what}: {error}') from error
    return lambda topic: wanted.wants(topic.name, topic.type)
