# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The same robot on other hardware: a description with another ``<hardware>`` element, and nothing
else changed. The urdf of a robot stays the single source of truth.
"""

from collections.abc import Mapping
import re
from xml.etree import ElementTree
from xml.sax.saxutils import escape, quoteattr

from amr_description.errors import DescriptionError

_HARDWARE = re.compile(r'<hardware>.*?</hardware>', re.DOTALL)


def swap_hardware(urdf: str, plugin: str, parameters: Mapping[str, str] | None = None) -> str:
    """
    Return the description with ``plugin`` and its ``parameters`` as its hardware.

    Raises DescriptionError where it has no ``<ros2_control>`` block with a ``<hardware>``, or more
    than one.
    """
    try:
        blocks = ElementTree.fromstring(urdf).findall('ros2_control/hardware')
    except ElementTree.ParseError as error:
        raise DescriptionError(f'robot description: {error}') from error
    found = _HARDWARE.findall(urdf)
    if len(blocks) != 1 or len(found) != 1:
        raise DescriptionError(
            f'robot description: {len(blocks)} <ros2_control> blocks with a <hardware>; exactly '
            f'one is needed to put {plugin} in its place'
        )
    lines = [f'<plugin>{escape(plugin)}</plugin>']
    for name, value in (parameters or {}).items():
        lines.append(f'<param name={quoteattr(name)}>{escape(value)}</param>')
    inside = ''.join(f'\n      {line}' for line in lines)
    element = f'<hardware>{inside}\n    </hardware>'
    return _HARDWARE.sub(lambda _: element, urdf)
