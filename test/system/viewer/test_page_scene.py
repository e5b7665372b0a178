# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The page in a real browser: the model, its frames and joints, and who cannot use a mouse."""

import csv
import io
import json
from pathlib import Path
import signal
import time

from ament_index_python.packages import get_package_prefix
import pytest
import rclpy
from rclpy.node import Node
from sensor_msgs.msg import JointState
from support.paths import TESTS
from support.running_programs import PATIENCE, Program
from support.waiting import until
from test_page_memory import LongDrive
from test_viewer_pages import serving

from amr_description.ros.service_calls import wait_until
from amr_description.testing.program import own_domain
from amr_description.viewer.protocol import ControllerInfo, Controllers

BRINGUP = Path(get_package_prefix('amr_description'), 'lib', 'amr_description', 'bringup')
MESHED = TESTS / 'fixtures' / 'urdf_good' / 'meshed.urdf'
JOINT, LOWER, UPPER = 'antenna_joint', -1.0, 1.0
CONTROLS = {
    'button', 'checkbox', 'combobox', 'link', 'menuitem', 'radio', 'slider', 'spinbutton',
    'switch', 'tab', 'textbox',
}  # fmt: skip
TRIANGLES = 1202
"""What is drawn of it, twice for the shadows; 48 are of meshes, which come one after the other."""
MOVED = 'joint_wheel_front_left'
SHOWN = 5
"""s of simulated time after which the page has had one state more; if slow, not many more."""
PAUSE = "document.querySelector('.plot-tools .toggle')"
MOST_TABS = 48
"""Presses of the key until the stop button is reached."""


@pytest.fixture(scope='module')
def display(browser):
    """The page of the stack ``display`` over a robot of meshes, and a node in its domain."""
    with own_domain(), Program(BRINGUP, 'display', f'urdf:={MESHED}') as stack:
        page = browser.open(stack.expect(r'The page is at (http://\S+)')[1])
        page.wait_until("amr.now.link === 'open' && amr.now.states > 5 && amr.now.robot")
        page.wait_until(f'amr.now.scene.triangles >= {TRIANGLES}')
        rclpy.init(args=[])
        yield page
        rclpy.try_shutdown()
        assert page.errors == []
        page.close()
        assert stack.end(signal.SIGINT) == 0


@pytest.fixture(scope='module')
def driven(browser, display):
    """
    The page of a robot that drives in circles, for a minute, and has a joint to be moved.

    In a window beside that of ``display``, which is there first: its tab would hide this one.
    """
    drive = LongDrive()
    claims = (f'{MOVED}/position',)
    movers = (ControllerInfo('mover', 'x/Mecanum', 'active', claims, moves=(MOVED,)),)
    drive.known += (Controllers('/', movers, ()),)
    with serving(drive) as server:
        page = browser.open(server.url, pixels=1.0, is_beside=True)
        page.wait_until('amr.now.scene.frames > 0')
        for drive.end in range(SHOWN, 60 + SHOWN, SHOWN):
            page.wait_until(f'amr.now.time >= {drive.end}')
        page.calls = drive.calls
        yield page
        assert page.errors == []
        page.close()


class Ears(Node):
    """Hears joint_states."""

    def __init__(self):
        super().__init__('ears')
        self.joints = {}
        self.create_subscription(
            JointState,
            '/joint_states',
            lambda message: self.joints.update(zip(message.name, message.position, strict=True)),
            10,
        )

    def wait(self, condition):
        assert wait_until(
            self,
            lambda: (JOINT in self.joints and condition(self.joints[JOINT])) or None,
            every=60.0,
            timeout=PATIENCE,
        )


def press(page, name):
    """Click on the button that is called so."""
    mark = f"""(() => {{
        const found = [...document.querySelectorAll('button:not([role=tab])')]
          .find((each) => [each.innerText.trim(), each.title].includes({json.dumps(name)}));
        document.querySelector('[data-pressed]')?.removeAttribute('data-pressed');
        found.dataset.pressed = '';
        return true;
      }})()"""
    page.wait_until(mark)
    page.click('[data-pressed]')


WRITTEN = """(() => {
    const names = document.querySelector('canvas.scene + canvas');
    const {data} = names.getContext('2d').getImageData(0, 0, names.width, names.height);
    return data.some((value) => value > 0);
  })()"""
"""Whether a name stands in the scene."""


def choose_nothing(page):
    """Click beside the robot."""
    x, y = page.evaluate(
        """(() => {
          const canvas = document.querySelector('canvas.scene');
          const {left, top, height} = canvas.getBoundingClientRect();
          return [left + 8, top + height / 2];
        })()"""
    )
    page.mouse('mousePressed', x, y)
    page.mouse('mouseReleased', x, y)


def test_meshes_are_drawn(display):
    display.wait_until(
        """performance.getEntriesByType('resource').some(
          ({name, responseStatus}) => /mesh.+stl$/.test(name) && responseStatus === 200)"""
    )
    display.wait_until('amr.now.scene.triangles > 0')
    assert display.errors == []


def test_a_click_chooses_a_link_and_shows_where_it_is(display):
    display.click('#tab-frames')
    display.click('canvas.scene')
    name = display.wait_until("document.querySelector('.chosen')?.textContent")
    assert name in ('base_link', 'antenna')
    pressed = display.evaluate("document.querySelector('.frame[aria-pressed=true]').innerText")
    assert pressed == name
    display.wait_until("/\\d\\.\\d{3}/.test(document.querySelector('.facts.numbers').innerText)")


def test_another_frame_is_held_still(display):
    display.click('#tab-frames')
    press(display, 'base_link')
    before = display.evaluate('amr.now.scene.frames')
    options = "[...document.querySelector('#fixed-frame').options].map(({value}) => value)"
    display.wait_until(f"{options}.includes('antenna')")
    for name in ('antenna', ''):
        display.evaluate(
            f"""(() => {{
              const choice = document.querySelector('#fixed-frame');
              choice.value = '{name}';
              choice.dispatchEvent(new Event('change'));
            }})()"""
        )
        display.wait_until(f'amr.now.scene.frames > {before}')
        before = display.evaluate('amr.now.scene.frames')
        found = "[...document.querySelectorAll('.facts.numbers dd')].map((each) => each.innerText)"
        display.wait_until(f"{found}.includes('{name or 'base_footprint'}')")


def test_a_frame_chosen_in_the_tree_is_lit_up_in_the_scene_with_what_its_link_weighs(display):
    display.click('#tab-frames')
    choose_nothing(display)
    display.wait_until(f'!{WRITTEN}')
    before = display.evaluate('amr.now.scene.triangles')
    press(display, 'antenna')
    display.wait_until(WRITTEN)
    display.wait_until(f'amr.now.scene.triangles > {before} + 500')  # the ellipsoid
    titles = "[...document.querySelectorAll('#panel-frames h3')].map((each) => each.innerText)"
    assert 'Link antenna' in display.evaluate(titles)
    choose_nothing(display)
    display.wait_until(f'amr.now.scene.triangles === {before}')


def test_keys_move_the_camera_and_not_the_robot(display):
    display.evaluate("document.querySelector('canvas.scene').focus()")
    assert display.evaluate("document.activeElement.matches('canvas.scene')")
    for code, key, modifiers in (
        ('ArrowLeft', 'ArrowLeft', ('Shift',)),
        ('Equal', '+', ()),
        ('Home', 'Home', ()),
    ):
        before = display.evaluate('amr.now.scene.frames')
        display.key_down(code, key, modifiers)
        display.wait_until(f'amr.now.scene.frames > {before}')
        assert not display.evaluate('amr.now.driving')
        display.key_up(code, key, modifiers)
    display.evaluate('document.activeElement.blur()')


def test_a_picture_that_stands_still_is_drawn_finely_once(display):
    """Finer than the screen, where the processor draws without smoothing edges."""
    fine = """(() => {
        const {width, clientWidth} = document.querySelector('canvas.scene');
        return width > 1.5 * devicePixelRatio * clientWidth;
      })()"""
    # The first picture is fine too, and what comes after it is drawn.
    until(lambda: display.evaluate(fine) and display.stands_still())
    assert display.evaluate(fine)


def test_frames_and_their_names_are_shown_and_hidden(display):
    choose_nothing(display)
    display.wait_until(f'!{WRITTEN}')
    disabled = """[...document.querySelectorAll('.view-tools button')]
        .find((each) => each.innerText === 'Names').disabled"""
    assert display.evaluate(disabled)  # without frames it would do nothing
    before = display.evaluate('amr.now.scene.triangles')
    press(display, 'Frames')
    display.wait_until(f'amr.now.scene.triangles > {before}')
    assert not display.evaluate(disabled)
    assert not display.evaluate(WRITTEN)
    press(display, 'Names')
    display.wait_until(WRITTEN)
    press(display, 'Names')
    display.wait_until(f'!{WRITTEN}')
    press(display, 'Frames')
    display.wait_until(f'amr.now.scene.triangles === {before}')


def test_randomize_and_center_move_the_joints(display):
    ears = Ears()
    display.click('#tab-joints')
    press(display, 'Randomize')
    ears.wait(lambda position: position != 0.0)
    assert LOWER <= ears.joints[JOINT] <= UPPER
    press(display, 'Center')
    ears.wait(lambda position: position == 0.0)
    ears.destroy_node()


def test_samples_are_saved_as_a_table(driven):
    driven.evaluate(
        """(() => {
          const make = URL.createObjectURL.bind(URL);
          URL.createObjectURL = (content) => make(window.saved = content);
        })()"""
    )
    driven.click('.plots .menu summary')
    press(driven, 'CSV')
    driven.wait_until('window.saved instanceof Blob')
    head, *rows = csv.reader(io.StringIO(driven.evaluate('saved.text()')))
    wheel = 'joint_wheel_front_left'
    assert head[:3] == ['time_s', 'command_linear_m_s', 'odometry_linear_m_s']
    assert {'truth_angular_rad_s', f'{wheel}_rad_s', f'{wheel}_commanded_rad_s'} <= {*head}
    assert 'real_time_factor' not in head  # there is no simulator
    assert len(rows) > 1  # a page that is slow is not sent all states
    times = [float(row[0]) for row in rows]
    assert times == sorted(set(times))
    assert times[-1] == 60.0
    last = dict(zip(head, rows[-1], strict=True))
    assert (last['command_linear_m_s'], last['odometry_linear_m_s']) == ('0.5', '0.5')
    assert float(last[f'{wheel}_rad_s']) == pytest.approx(6.0)


def test_plots_are_zoomed_under_one_cursor_shared_and_resized(driven):
    charts = driven.evaluate("document.querySelectorAll('.chart:not([hidden])').length")
    driven.wait_until(f"{PAUSE}.ariaPressed === 'false'")
    driven.wheel('.chart-plot', -200)
    driven.wait_until(f"{PAUSE}.ariaPressed === 'true'")
    x, y = driven.centre_of('.chart-plot')
    driven.mouse('mouseMoved', x, y)
    driven.wait_until(
        "[...document.querySelectorAll('.chart:not([hidden]) .chart-cursor:not([hidden])')]"
        rf'.filter((each) => /^\d+\.\d\d s$/.test(each.innerText)).length === {charts}'
    )
    driven.click('.plot-tools .toggle')
    driven.wait_until(f"{PAUSE}.ariaPressed === 'false'")
    before = driven.evaluate("document.querySelector('.chart-plot canvas').clientHeight")
    driven.evaluate("document.querySelector('.splitter').focus()")
    driven.key_down('ArrowUp')
    driven.key_up('ArrowUp')
    driven.wait_until(f"document.querySelector('.chart-plot canvas').clientHeight > {before}")
    driven.click('.plots .menu summary')
    press(driven, 'Copy link')
    driven.wait_until("location.hash.startsWith('#plots=linear;angular;wheels;factor&tab=')")
    driven.wait_until(r'/&dock=0\.\d+$/.test(location.hash)')
    driven.evaluate("document.querySelector('.splitter').dispatchEvent(new Event('dblclick'))")


def test_a_slider_commands_the_controller_of_its_joint_and_a_button_goes_sideways(driven):
    driven.click('#tab-joints')
    driven.evaluate(
        f"""(() => {{
          const slider = document.querySelector('input[type=range][aria-label^={MOVED}]');
          slider.value = '0.75';
          slider.dispatchEvent(new Event('input'));
        }})()"""
    )
    driven.wait_until("document.body.innerText.includes('Sliders command mover')")
    driven.wait_until("document.querySelectorAll('.joint.slides').length === 1")
    driven.evaluate(
        """(() => {
          const press = (kind) => document.querySelector('.sideways button')
            .dispatchEvent(new PointerEvent(kind, {pointerId: 1}));
          Element.prototype.setPointerCapture = () => {};
          press('pointerdown');
          setTimeout(() => press('pointerup'), 100);
        })()"""
    )
    driven.wait_until('!amr.now.driving && amr.now.driver === null')
    deadline = time.monotonic() + PATIENCE
    while (0.0, 0.0) not in driven.calls:
        assert time.monotonic() < deadline
        driven.evaluate('new Promise(requestAnimationFrame)')
    assert {MOVED: 0.75} in driven.calls
    assert (0.0, 0.0, 0.5) in driven.calls
    driven.click('#tab-model')


def nameless(page):
    """Controls that a screen reader cannot name."""
    page.call('Accessibility.enable')
    nodes = page.call('Accessibility.getFullAXTree')['nodes']
    controls = [
        node for node in nodes if not node['ignored'] and node['role']['value'] in CONTROLS
    ]
    assert len(controls) > 10
    return [node for node in controls if not node.get('name', {}).get('value', '').strip()]


@pytest.mark.parametrize('size', [(1440, 900, False), (390, 844, True)], ids=['desk', 'phone'])
def test_every_control_has_a_name_and_nothing_is_cut_off(driven, size):
    width, height, phone = size
    driven.look_like(width, height, phone=phone)
    driven.wait_until(f'innerWidth === {width}')
    assert nameless(driven) == []
    wide = '[document.documentElement, document.body].some((e) => e.scrollWidth > innerWidth)'
    assert not driven.evaluate(wide)
    if phone:
        press(driven, 'Panels')
        driven.wait_until("document.querySelector('.sheet').dataset.sheet === 'open'")
        assert nameless(driven) == []
        assert not driven.evaluate(wide)
        press(driven, 'Close the panels')
        driven.look_like(1440, 900)
        driven.wait_until('innerWidth === 1440')


def test_the_tab_key_reaches_the_stop_button(driven):
    driven.evaluate('document.activeElement.blur(); getSelection().removeAllRanges()')
    key = {'key': 'Tab', 'code': 'Tab', 'windowsVirtualKeyCode': 9}
    reached = []
    while '.stop' not in reached:
        assert len(reached) < MOST_TABS, reached
        for kind in ('rawKeyDown', 'keyUp'):
            driven.call('Input.dispatchKeyEvent', {'type': kind, **key})
        reached.append(
            driven.evaluate(
                "document.activeElement.matches('.stop:focus-visible') ? '.stop' "
                ': document.activeElement.outerHTML.slice(0, 60)'
            )
        )
