# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The text of ``amr_description/messages/definitions.txt``; run with ``--write``, this writes it.

The messages of the topics of all shipped controllers, of sensors and of the simulator, what their
services and actions are asked and answer, and the messages in them, as the installed packages have
them.
"""

from pathlib import Path
import sys

from amr_description.bag.schemas import contained_types, schema_text
from amr_description.bag.type_hashes import type_hash
from amr_description.messages import definitions
from amr_description.messages.readers import READERS
from amr_description.messages.writers import WRITERS

OTHERS = (
    'controller_manager_msgs/msg/ControllerManagerActivity',
    'diagnostic_msgs/msg/KeyValue',
    'gazebo_msgs/msg/ContactsState',
    'geometry_msgs/msg/WrenchStamped',
    'lifecycle_msgs/msg/TransitionEvent',
    'ros_gz_interfaces/msg/Contacts',
    'rosgraph_msgs/msg/Clock',
    'sensor_msgs/msg/CameraInfo',
    'sensor_msgs/msg/CompressedImage',
    'sensor_msgs/msg/Image',
    'sensor_msgs/msg/LaserScan',
    'sensor_msgs/msg/PointCloud2',
    'sensor_msgs/msg/Range',
    'std_msgs/msg/String',
    'visualization_msgs/msg/MarkerArray',
)
BETWEEN = '=' * 80 + '\nMSG: '


def text():
    """The file, as it should be."""
    tables = (READERS, WRITERS)
    names = {message for table in tables for _, message in table}
    found = {}
    waiting = sorted({*names, *OTHERS})
    while waiting:
        name = waiting.pop()
        own = schema_text(name).partition(BETWEEN)[0]
        is_known = bool(own) or '/msg/' not in name  # ackermann_msgs may not be installed
        if name not in found and is_known:
            found[name] = f'{own.rstrip()}\n' if own.strip() else ''
            waiting += contained_types(name, own)
    return ''.join(f'=== {mark_of(name)}\n{found[name]}' for name in sorted(found))


def mark_of(name):
    """The type, and the hash of that of a message of its own."""
    return f'{name} {type_hash(name)}' if '/msg/' in name else name


if __name__ == '__main__' and sys.argv[1:] == ['--write']:
    Path(definitions.__file__).with_name('definitions.txt').write_text(text(), encoding='utf-8')
