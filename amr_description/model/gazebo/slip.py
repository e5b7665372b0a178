# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Wheels that Gazebo lets slip in proportion to the force: its WheelSlip, ``<slip1>``, ``<slip2>``.

A wheel that is pulled with less than its friction creeps, at a speed in proportion to the force,
and not to its load: WheelSlip takes one ``<wheel_normal_force>`` whatever the wheel bears.
"""

from collections.abc import Iterator

from lxml import etree

from amr_description.model.gazebo.plugins import CLASSIC, plugins_of
from amr_description.model.xml_reader import parse_number

KINDS = ('wheel-slip', f'{CLASSIC}wheel-slip')
_COMPLIANCES = tuple(
    name
    for side in ('lateral', 'longitudinal')
    for name in (f'slip_compliance_{side}', f'{side}_slip_compliance')
)


def slipping_links(xml: etree._Element) -> Iterator[str]:
    """Yield the links that plugins of the kinds :data:`KINDS` let slip."""
    for plugin in plugins_of(xml, []):
        if plugin.kind in KINDS:
            for wheel in plugin.element.iterchildren('wheel'):
                texts = (wheel.get(name) or wheel.findtext(name) or '' for name in _COMPLIANCES)
                if any(parse_number(text) > 0.0 for text in texts):
                    yield wheel.get('link_name', '')
