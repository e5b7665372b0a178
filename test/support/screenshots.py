# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Make the pictures of the README: the page in a real browser, over a robot that really drives."""

from contextlib import contextmanager
from pathlib import Path
import signal
import sys
from tempfile import TemporaryDirectory

from ament_index_python.packages import get_package_prefix
from support import chromium
from support.animation import animation
from support.paths import ROOT
from support.running_programs import Program

from amr_description.testing.program import own_domain

BRINGUP = Path(get_package_prefix('amr_description'), 'lib', 'amr_description', 'bringup')
IMAGES = ROOT / 'docs' / 'images'


@contextmanager
def page_of(browser, *words, **look):
    """A page over a stack of its own that is up."""
    with own_domain(), Program(BRINGUP, *words) as stack:
        url = stack.expect(r'The page is at (http://\S+)')[1]
        page = browser.open(url, pixels=1.0, every_frame=True, **look)
        page.wait_until("amr.now.link === 'open' && amr.now.states > 5 && amr.now.robot")
        yield page
        page.close()
        stack.end(signal.SIGINT)


def drive(page, *holds):
    """Hold keys, each for some simulated seconds."""
    for code, seconds in holds:
        begin = page.evaluate('amr.now.time')
        page.key_down(code)
        page.wait_until(f'amr.now.time > {begin + seconds}')
        page.key_up(code)


FRAME = 0.2
"""s of simulated time between two frames of the film."""


def film(page, holds):
    """Drive as :func:`drive` does, and return a picture for each FRAME of simulated time."""
    pictures = []
    for code, seconds in holds:
        begin = page.evaluate('amr.now.time')
        if code:
            page.key_down(code)
        for frame in range(1, round(seconds / FRAME) + 1):
            page.wait_until(f'amr.now.time >= {begin + frame * FRAME}')
            pictures.append(page.picture('webp', quality=38))
        if code:
            page.key_up(code)
    return pictures


def write_film(browser):
    """Write the picture at the top of the README; slowly, as each frame takes its time to draw."""
    words = ('simulation', 'world:=warehouse', 'rtf:=0.2')
    with page_of(browser, *words, width=1100, height=640) as page:
        course = [('KeyW', 1.5), ('KeyA', 1.0), ('KeyW', 1.5), ('KeyD', 1.5), ('KeyW', 1.0)]
        pictures = film(page, [*course, (None, 0.5)])
        moving = animation(pictures, round(1000 * FRAME))
        (IMAGES / 'driving.webp').write_bytes(moving)


def write_sensors(browser, name='sensors', **look):
    """Write the picture of the page with sensors; slowly, as the camera takes its time as well."""
    words = ('simulation', 'world:=warehouse', 'sensors:=true', 'rtf:=0.2')
    look = {'width': 1280, 'height': 800, **look}
    with page_of(browser, *words, **look) as page:
        page.click('#tab-sensors')
        page.click('[aria-label="Show /camera/image/compressed"]')
        page.click('[aria-label="Show /camera/points"]')
        drive(page, ('KeyW', 1.5), ('KeyA', 0.5), ('KeyW', 1.0))
        drag(page, 'canvas.scene', 40, 25)
        for _ in range(6):  # away from the robot, so that the shelves come into view
            page.wheel('canvas.scene', 240)
        drawn = page.evaluate("amr.now.pictures['/camera/image/compressed']")
        page.wait_until(f"amr.now.pictures['/camera/image/compressed'] > {drawn}")
        page.wait_until("amr.now.scene.sensors['/scan'].points > 100")
        frames = page.evaluate('amr.now.scene.frames')
        page.wait_until(f'amr.now.scene.frames > {frames} + 10')  # finely drawn again
        (IMAGES / f'{name}.webp').write_bytes(page.picture('webp', quality=72))


def write_navigation(browser):
    """Write the picture of a robot on its way to a goal."""
    with page_of(browser, 'navigation', 'rtf:=0.5', width=1280, height=800) as page:
        page.wait_until("amr.now.scene.navigation.maps['/map']")
        page.wait_until("document.querySelector('.navigation [aria-keyshortcuts=G]')")
        drag(page, 'canvas.scene', 60, 60)
        for _ in range(12):  # away from the robot, so that the shelves come into view
            page.wheel('canvas.scene', 240)
        frames = page.evaluate('amr.now.scene.frames')
        page.wait_until(f'amr.now.scene.frames > {frames} + 20')  # the camera has come to rest
        page.click('.navigation [aria-keyshortcuts=G]')
        x, y = page.centre_of('.scene')
        page.mouse('mousePressed', x + 140, y - 110)
        page.mouse('mouseMoved', x + 190, y - 110)
        page.mouse('mouseReleased', x + 190, y - 110)
        page.wait_until("document.querySelector('.goal-words').textContent.match('to go')")
        begin = page.evaluate('amr.now.time')
        page.wait_until(f'amr.now.time > {begin + 2.0}')
        (IMAGES / 'navigation.webp').write_bytes(page.picture('webp', quality=72))


def write_recording(browser):
    """Write the picture of a recorded drive, at a time of it, with all that was measured then."""
    words = ('simulation', 'world:=warehouse', 'sensors:=true', 'rtf:=0.5')
    with TemporaryDirectory() as folder:
        bag = Path(folder, 'tour')
        with page_of(browser, *words, f'record:={bag}', width=1280, height=800) as page:
            drive(page, ('KeyW', 2.0), ('KeyA', 0.7), ('KeyW', 3.0), ('KeyD', 0.7), ('KeyW', 2.0))
        with Program.module('viewer', '--bag', bag, '--ros-args', '-p', 'port:=0') as viewer:
            url = viewer.expect(r'The page is at (http://\S+)')[1]
            page = browser.open(url, pixels=1.0, every_frame=True, width=1280, height=800)
            page.wait_until('amr.now.samples > 100')
            page.click('#tab-sensors')
            for topic in ('/camera/depth_image', '/camera/image/compressed', '/camera/points'):
                page.click(f'[aria-label="Show {topic}"]')
            for key in ('End', *['ArrowLeft'] * 3):
                page.key_down(key, key)
                page.key_up(key, key)
            page.wait_until("amr.now.pictures['/camera/image/compressed'] > 1")
            frames = page.evaluate('amr.now.scene.frames')
            page.wait_until(f'amr.now.scene.frames > {frames} + 10')  # finely drawn again
            (IMAGES / 'recording.webp').write_bytes(page.picture('webp', quality=60))
            page.close()
            viewer.end(signal.SIGINT)


def drag(page, selector, right, down):
    """Drag from the middle of an element, pixels."""
    x, y = page.centre_of(selector)
    page.mouse('mousePressed', x, y)
    for share in (0.5, 1.0):
        page.mouse('mouseMoved', x + share * right, y + share * down)
    page.mouse('mouseReleased', x + right, y + down)


def main():
    """Write all of them."""
    IMAGES.mkdir(exist_ok=True)
    with chromium.Chromium() as browser:
        write_film(browser)
        write_sensors(browser)
        write_navigation(browser)
        write_recording(browser)
        with page_of(browser, 'simulation', 'world:=warehouse') as page:
            drive(page, ('KeyW', 2.0), ('KeyA', 1.0), ('KeyW', 2.0), ('KeyD', 1.5), ('KeyW', 1.0))
            page.screenshot(IMAGES / 'simulation.png')
            page.look_like(1440, 900, dark=True)
            page.wait_until("matchMedia('(prefers-color-scheme: dark)').matches")
            drive(page, ('KeyW', 1.0))
            page.screenshot(IMAGES / 'simulation_dark.png')
        with page_of(browser, 'simulation', width=390, height=844, phone=True) as page:
            drive(page, ('KeyW', 1.0), ('KeyA', 1.0))
            page.screenshot(IMAGES / 'phone.png')
        with page_of(browser, 'display') as page:
            page.click('[role=tab]:nth-child(2)')
            page.screenshot(IMAGES / 'display.png')


if __name__ == '__main__':
    sys.exit(main())
