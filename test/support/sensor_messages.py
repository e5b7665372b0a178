# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Messages of sensors, as simulators and drivers publish them."""

from array import array

from builtin_interfaces.msg import Time
from gazebo_msgs.msg import ContactsState, ContactState
from geometry_msgs.msg import Vector3, Wrench
from ros_gz_interfaces.msg import Contact, Contacts, JointWrench
from sensor_msgs.msg import Image, LaserScan, PointCloud2, PointField
from std_msgs.msg import Header

STAMP = Time(sec=3, nanosec=5)


def header(frame='laser'):
    return Header(stamp=STAMP, frame_id=frame)


def vector(x, y, z):
    return Vector3(x=x, y=y, z=z)


def wrench(x):
    return Wrench(force=vector(x, 0.0, 0.0))


def gz_contacts(frame='laser', force=3.0):
    contact = Contact()
    contact.collision1.name, contact.collision2.name = 'bumper', 'a wall'
    contact.positions = [vector(1.0, 2.0, 3.0), vector(4.0, 5.0, 6.0)]
    contact.normals = [vector(0.0, 0.0, 1.0)] * 2
    contact.depths = [0.001, 0.002]
    joint = JointWrench()
    joint.header, joint.body_1_wrench, joint.body_2_wrench = (
        header('x'),
        wrench(force),
        wrench(9.0),
    )
    joint.body_1_name.data = 'abc'
    contact.wrenches = [joint, joint]
    return Contacts(header=header(frame), contacts=[contact, contact])


def classic_contacts(frame='laser', force=3.0):
    state = ContactState()
    state.info = 'info'
    state.collision1_name, state.collision2_name = 'bumper', 'a wall'
    state.wrenches = [wrench(force), wrench(force)]
    state.total_wrench = wrench(2 * force)
    state.contact_positions = [vector(1.0, 2.0, 3.0), vector(4.0, 5.0, 6.0)]
    state.contact_normals = [vector(0.0, 0.0, 1.0)] * 2
    state.depths = [0.001, 0.002]
    return ContactsState(header=header(frame), states=[state, state])


def scan(frame='laser', ranges=(1.0, 2.0)):
    return LaserScan(
        header=header(frame), angle_min=-1.0, angle_max=1.0, angle_increment=0.5, range_min=0.25,
        range_max=8.0, ranges=list(ranges), intensities=[7.0],
    )  # fmt: skip


def cloud(frame='laser', data=b'12345678'):
    fields = [PointField(name=name, offset=4 * at, datatype=7) for at, name in enumerate('xy')]
    return PointCloud2(
        header=header(frame), height=1, width=1, fields=fields, point_step=8, row_step=8,
        data=array('B', data),
    )  # fmt: skip


def image(frame='laser', data=b'abcdef'):
    return Image(
        header=header(frame), height=1, width=2, encoding='rgb8', step=6, data=array('B', data)
    )
