# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The elements and attributes that URDF and ros2_control know, as one table.

Readers pass over what they do not know; the checker looks here whether it was meant.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True, slots=True)
class Element:
    """
    What an element may hold.

    ``children`` by tag; of those in ``single`` only the first counts. An ``open`` element may hold
    anything: other programs read it.
    """

    attributes: tuple[str, ...] = ()
    children: Mapping[str, 'Element'] = field(default_factory=dict)
    single: tuple[str, ...] = ()
    open: bool = False


_ANYTHING = Element(open=True)
_ORIGIN = Element(('xyz', 'rpy'))
_GEOMETRY = Element(
    children={
        'box': Element(('size',)),
        'cylinder': Element(('radius', 'length')),
        'sphere': Element(('radius',)),
        'mesh': Element(('filename', 'scale')),
    }
)
_MATERIAL = Element(
    ('name',),
    {'color': Element(('rgba',)), 'texture': Element(('filename',))},
    ('color', 'texture'),
)
_LINK = Element(
    ('name', 'type'),
    {
        'inertial': Element(
            children={
                'origin': _ORIGIN,
                'mass': Element(('value',)),
                'inertia': Element(('ixx', 'ixy', 'ixz', 'iyy', 'iyz', 'izz')),
            },
            single=('origin', 'mass', 'inertia'),
        ),
        'visual': Element(
            ('name',),
            {'origin': _ORIGIN, 'geometry': _GEOMETRY, 'material': _MATERIAL},
            ('origin', 'geometry', 'material'),
        ),
        'collision': Element(
            ('name',),
            # Contact parameters of Bullet and of old Gazebo stand beside them.
            {'origin': _ORIGIN, 'geometry': _GEOMETRY, 'verbose': _ANYTHING}
            | dict.fromkeys(('material', 'contact_coefficients'), _ANYTHING),
            ('origin', 'geometry'),
        ),
        'contact': _ANYTHING,
    },
    ('inertial',),
)
_JOINT = Element(
    ('name', 'type'),
    {
        'origin': _ORIGIN,
        'parent': Element(('link',)),
        'child': Element(('link',)),
        'axis': Element(('xyz',)),
        'limit': Element(
            ('lower', 'upper', 'effort', 'velocity', 'acceleration', 'deceleration', 'jerk')
        ),
        'dynamics': Element(('damping', 'friction')),
        'mimic': Element(('joint', 'multiplier', 'offset')),
        'calibration': Element(('rising', 'falling', 'reference_position')),
        'safety_controller': Element(
            ('soft_lower_limit', 'soft_upper_limit', 'k_position', 'k_velocity')
        ),
    },
)
_PARAM = Element(('name',))
_LIMITS = Element(('enable',))
_INTERFACE = Element(
    ('name', 'data_type', 'size'), {'param': _PARAM, 'limits': _LIMITS}, ('limits',)
)
_COMPONENT = Element(
    ('name', 'mimic'),
    {
        'command_interface': _INTERFACE,
        'state_interface': _INTERFACE,
        'param': _PARAM,
        'limits': _LIMITS,
    },
    ('limits',),
)
_ROS2_CONTROL = Element(
    ('name', 'type', 'rw_rate', 'is_async'),
    {
        'hardware': Element(
            children={'plugin': Element(), 'group': Element(), 'param': _PARAM},
            single=('plugin', 'group'),
        ),
        'properties': _ANYTHING,
        'joint': _COMPONENT,
        'sensor': _COMPONENT,
        'gpio': _COMPONENT,
        'transmission': _ANYTHING,
    },
    ('hardware',),
)

ROBOT = Element(
    ('name', 'version'),
    {
        'material': _MATERIAL,
        'link': _LINK,
        'joint': Element(_JOINT.attributes, _JOINT.children, tuple(_JOINT.children)),
        'ros2_control': _ROS2_CONTROL,
    }
    | dict.fromkeys(('gazebo', 'transmission', 'mujoco', 'sensor'), _ANYTHING),
)
"""``<robot>`` and all below it."""
