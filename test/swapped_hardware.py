# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The shipped robot on other hardware: only ``<hardware>`` of its description is another."""

from pathlib import Path
import re

AMR = (Path(__file__).parents[1] / 'urdf' / 'amr.urdf').read_text()
SIDES = {
    'left_joints': 'joint_wheel_front_left joint_wheel_back_left',
    'right_joints': 'joint_wheel_front_right joint_wheel_back_right',
}
SERIAL_BASE = 'amr_description/SerialBaseSystem'


def on_hardware(plugin, urdf=AMR, **parameters):
    """The text of ``urdf`` with this plugin, and these parameters, in its one <hardware>."""
    texts = (f'<param name="{name}">{value}</param>' for name, value in parameters.items())
    block = f'<hardware><plugin>{plugin}</plugin>{"".join(texts)}</hardware>'
    swapped, count = re.subn('<hardware>.*?</hardware>', lambda _: block, urdf, flags=re.DOTALL)
    assert count == 1
    return swapped


def on_motor_board(port, urdf=AMR, **parameters):
    """The text of the shipped description, driven by a motor board on a serial port."""
    return on_hardware(SERIAL_BASE, urdf, **{'port': port, **SIDES, **parameters})
