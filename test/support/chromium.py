# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A real headless Chromium, asked by its DevTools protocol: what a test of the page needs of it.

https://chromedevtools.github.io/devtools-protocol/ says what the methods mean.
"""

import base64
from contextlib import ExitStack
import itertools
import json
import os
import queue
import re
import shutil
import subprocess
import tempfile
import threading
import weakref

from support.running_programs import PATIENCE
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

NAMES = ('chromium', 'chromium-browser', 'google-chrome')
"""What the browser is called where it is installed."""

_FLAGS = (
    '--headless', '--no-sandbox', '--enable-unsafe-swiftshader', '--disable-gpu',
    # A test's browser asks nobody but the page under test.
    '--disable-quic', '--no-first-run', '--disable-background-networking',
    '--disable-component-update', '--disable-sync', '--disable-default-apps',
    '--disable-dev-shm-usage', '--remote-debugging-port=0',
    # No process for a page that nobody will open, and none for extensions.
    '--disable-features=SpareRendererForSitePerProcess', '--disable-extensions',
)  # fmt: skip
FEW_PIXELS = 0.25
"""Pixels to a CSS pixel, each of them drawn by the processor: for tests that look at none."""
_FEW_FRAMES = """
window.requestAnimationFrame = (draw) => setTimeout(() => draw(performance.now()), 100);
window.cancelAnimationFrame = clearTimeout;
"""
"""Ten frames a second instead of sixty, which the processor draws: to drive a robot by."""
_NO_GAMEPADS = """
{
  const listen = window.addEventListener;
  window.addEventListener = function (kind, ...rest) {
    if (!/^gamepad/.test(kind)) listen.call(this, kind, ...rest);
  };
}
"""
"""Who listens has the browser ask for gamepads 250 times a second: 1.6 % of a processor."""
_NO_WEBGL = """
{
  const getContext = HTMLCanvasElement.prototype.getContext;
  HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
    return /webgl/.test(kind) ? null : getContext.call(this, kind, ...rest);
  };
}
"""
"""What a page finds in a browser without WebGL."""
_CENTRE = """(() => {
  element.scrollIntoView({block: 'nearest', inline: 'nearest'});
  const box = element.getBoundingClientRect();
  return [box.x + box.width / 2, box.y + box.height / 2];
})()"""
_MODIFIERS = {'Alt': 1, 'Control': 2, 'Meta': 4, 'Shift': 8}


def executable():
    """Return the path of a browser on this machine, or None."""
    return next(filter(None, map(shutil.which, NAMES)), None)


OPEN_PAGES = weakref.WeakSet()
"""Those that are open: when a test fails, its pictures are kept."""

_FRAMES_DRAWN = """(async () => {
    const before = amr.now.scene.frames;
    await new Promise((done) => setTimeout(done, 300));
    for (let count = 0; count < 3; count += 1) await new Promise(requestAnimationFrame);
    return amr.now.scene.frames - before;
  })()"""
"""Longer than the page waits for a better picture, and as long as a busy one needs to begin it."""


class BrowserError(AssertionError):
    """The browser refused, or the page threw."""


class Chromium:
    """
    One browser process with a profile of its own; a context manager.

    :param flags: More of its options.
    """

    def __init__(self, *flags):
        self._profile = tempfile.TemporaryDirectory(prefix='amr-browser-')
        profile = f'--user-data-dir={self._profile.name}'
        command = [executable(), *_FLAGS, *flags, profile, 'about:blank']
        self._process = subprocess.Popen(
            command,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
            env=_environment(),
        )
        self._stack = ExitStack()
        self._rest = None
        try:
            self._connection = self._stack.enter_context(
                connect(self._address(), max_size=None, open_timeout=PATIENCE)
            )
        except BaseException:
            self._process.kill()
            self._end()
            raise
        self._ids = itertools.count(1)
        self._answers = {}
        self._pages = {}
        threading.Thread(target=self._read, daemon=True).start()

    def _address(self):
        """Return where it listens; what it says on stderr is read on, so that it never blocks."""
        for line in self._process.stderr:
            if found := re.search(r'DevTools listening on (ws://\S+)', line):
                self._rest = threading.Thread(target=self._process.stderr.read, daemon=True)
                self._rest.start()
                return found[1]
        raise BrowserError(f'the browser ended with {self._process.wait()} before it listened')

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.call('Browser.close')  # it ends its helper processes, too
        self._stack.close()
        self._end()

    def _end(self):
        try:
            self._process.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        if self._rest:
            # Its helper processes have that stream too, and write into the profile to their end.
            self._rest.join(PATIENCE)
        self._profile.cleanup()

    def open(
        self,
        url,
        *,
        pixels=FEW_PIXELS,
        every_frame=False,
        webgl=True,
        is_beside=False,
        **look,
    ):
        """
        Open a page in a tab of its own, and wait until it is loaded.

        :param pixels: To a CSS pixel.
        :param every_frame: Draw as often as the page wants to; else ten times a second.
        :param webgl: Whether there is any: without a scene, loading takes two thirds of the time.
        :param is_beside: In a window of its own, which costs half a second of CPU; else the tabs
            behind this one are hidden, and not drawn, until it is closed.
        :param look: As of :meth:`Page.look_like`.
        """
        target = self.call('Target.createTarget', {'url': 'about:blank', 'newWindow': is_beside})
        attached = self.call(
            'Target.attachToTarget', {'targetId': target['targetId'], 'flatten': True}
        )
        page = Page(self, target['targetId'], attached['sessionId'], pixels)
        self._pages[attached['sessionId']] = page
        for domain in ('Page', 'Runtime', 'Network', 'Log'):
            page.call(f'{domain}.enable')
        page.run_first(_NO_GAMEPADS)
        if not every_frame:
            page.run_first(_FEW_FRAMES)
        if not webgl:
            page.run_first(_NO_WEBGL)
        page.look_like(**look)
        page.go(url)
        return page

    def close_page(self, target, session):
        """Close a tab."""
        self.call('Target.closeTarget', {'targetId': target})
        del self._pages[session]

    def call(self, method, params=None, session=None):
        """Call a method of the protocol and return its result."""
        number = next(self._ids)
        answer = self._answers[number] = queue.Queue()
        message = {'id': number, 'method': method, 'params': params or {}}
        if session:
            message['sessionId'] = session
        self._connection.send(json.dumps(message))
        try:
            reply = answer.get(timeout=PATIENCE)
        except queue.Empty:
            raise BrowserError(f'{method} {params} was not answered') from None
        finally:
            del self._answers[number]
        if 'error' in reply:
            raise BrowserError(f'{method}: {reply["error"]["message"]}')
        return reply['result']

    def _read(self):
        try:
            for text in self._connection:
                message = json.loads(text)
                if 'id' in message:
                    if answer := self._answers.get(message['id']):  # else: it came too late
                        answer.put(message)
                elif page := self._pages.get(message.get('sessionId')):
                    page.hear(message['method'], message['params'])
        except ConnectionClosed:
            pass  # the browser was ended


class Page:
    """A tab: what was loaded, what it complained of, and what a person would do in it."""

    def __init__(self, browser, target, session, pixels):
        self._browser = browser
        self._target = target
        self._session = session
        self._pixels = pixels
        self._keys = {}
        self._pressed = None
        self._loaded = threading.Event()
        self.errors = []
        """What the console shows in red: errors and uncaught exceptions."""
        self.requests = []
        """Every URL that was asked for, WebSockets too."""
        self._snapshot = []
        OPEN_PAGES.add(self)

    def call(self, method, params=None):
        """Call a method of the protocol in this tab."""
        return self._browser.call(method, params, self._session)

    def stands_still(self):
        """Whether the scene is not drawn for some time: robots and camera rest."""
        return self.evaluate(_FRAMES_DRAWN) == 0

    def hear(self, method, params):
        """Take note of an event; called by the thread that reads."""
        if method == 'Page.loadEventFired':
            self._loaded.set()
        elif method == 'Network.requestWillBeSent':
            self.requests.append(params['request']['url'])
        elif method == 'Network.webSocketCreated':
            self.requests.append(params['url'])
        elif method == 'HeapProfiler.addHeapSnapshotChunk':
            self._snapshot.append(params['chunk'])
        elif method == 'Runtime.exceptionThrown':
            self.errors.append(str(params['exceptionDetails'].get('exception')))
        elif method == 'Runtime.consoleAPICalled' and params['type'] in ('error', 'assert'):
            self.errors.append(str([part.get('value') for part in params['args']]))
        elif method == 'Log.entryAdded' and params['entry']['level'] == 'error':
            self.errors.append(f'{params["entry"]["text"]} {params["entry"].get("url", "")}')

    def run_first(self, source):
        """Have a script run in each page that is loaded from now on, before those of the page."""
        self.call('Page.addScriptToEvaluateOnNewDocument', {'source': source})

    def go(self, url):
        """Load a URL."""
        self._loaded.clear()
        self.call('Page.navigate', {'url': url})
        if not self._loaded.wait(PATIENCE):
            raise BrowserError(f'{url} did not load')

    def look_like(self, width=1440, height=900, *, phone=False, dark=False):
        """Be a screen of that size in CSS pixels."""
        self.call(
            'Emulation.setDeviceMetricsOverride',
            {
                'width': width,
                'height': height,
                'deviceScaleFactor': self._pixels,
                'mobile': phone,
            },
        )
        self.call('Emulation.setTouchEmulationEnabled', {'enabled': phone})
        scheme = {'name': 'prefers-color-scheme', 'value': 'dark' if dark else 'light'}
        self.call('Emulation.setEmulatedMedia', {'features': [scheme]})

    def evaluate(self, expression):
        """Return the value of a JavaScript expression, a promise's too, as JSON would carry it."""
        answer = self.call(
            'Runtime.evaluate',
            {'expression': expression, 'returnByValue': True, 'awaitPromise': True},
        )
        if details := answer.get('exceptionDetails'):
            thrown = details.get('exception', {}).get('description') or details['text']
            raise BrowserError(f'{expression}: {thrown}')
        return answer['result'].get('value')

    def held_bytes(self):
        """
        Return what the page holds on to: its script's objects and buffers, and the document.

        Compiled code is left out: the engine adds a megabyte of it in the first minute, as it
        learns what is called often.
        """
        self._snapshot.clear()
        self.call('HeapProfiler.takeHeapSnapshot')  # which collects garbage first
        heap = json.loads(''.join(self._snapshot))
        self._snapshot.clear()
        meta, nodes = heap['snapshot']['meta'], heap['nodes']
        fields, kinds = meta['node_fields'], meta['node_types'][0]
        count, code = len(fields), kinds.index('code')
        types = nodes[fields.index('type') :: count]
        sizes = nodes[fields.index('self_size') :: count]
        return sum(size for kind, size in zip(types, sizes, strict=True) if kind != code)

    def wait_until(self, expression):
        """Wait until a JavaScript expression is true, and return its value."""
        look = f"""
            new Promise((resolve) => {{
              const begin = performance.now();
              const look = () => {{
                let value;
                try {{ value = {expression}; }} catch (error) {{ value = null; }}
                if (value instanceof Node) value = true;
                if (value || performance.now() - begin > {0.9 * PATIENCE * 1000}) resolve(value);
                else setTimeout(look, 20);
              }};
              look();
            }})"""
        value = self.evaluate(look)
        if not value:
            raise BrowserError(f'never true: {expression}; the page says {self.errors}')
        return value

    def key_down(self, code, key=None, modifiers=()):
        """Press a key, by its physical place: ``KeyW``, ``ArrowUp``, ``Space``."""
        self._key('rawKeyDown', code, key, modifiers)

    def key_up(self, code, key=None, modifiers=()):
        """Let a key go."""
        self._key('keyUp', code, key, modifiers)

    def _key(self, kind, code, key, modifiers):
        letter = code.removeprefix('Key').removeprefix('Digit')
        letter = letter.lower() if len(letter) == 1 else letter
        flags = sum(_MODIFIERS[name] for name in modifiers)
        event = {'type': kind, 'code': code, 'key': key or letter, 'modifiers': flags}
        self.call('Input.dispatchKeyEvent', event)
        if kind == 'keyUp':
            self._keys.pop(code, None)
        else:
            self._keys[code] = key

    def let_go(self):
        """Let go of the keys and the mouse button that are held."""
        for code, key in [*self._keys.items()]:
            self.key_up(code, key)
        if self._pressed:
            self.mouse('mouseReleased', *self._pressed)

    def click(self, selector):
        """
        Click with the mouse at the middle of the first element of a CSS selector.

        As a person does, once it stands still, and nothing lies on it: a panel that opens is
        filled when the next state arrives, and what is in it moves.
        """
        x, y = self._place_of(selector, 'element.contains(document.elementFromPoint(x, y))')
        self.mouse('mousePressed', x, y)
        self.mouse('mouseReleased', x, y)

    def centre_of(self, selector):
        """
        Return where the middle of an element is, scrolled into view, in CSS pixels.

        As soon as it stands still: after the size of the page has changed, it is laid out anew.
        """
        return self._place_of(selector, 'true')

    def _place_of(self, selector, condition):
        """Wait until an element is at the same place in two looks, and for a condition."""
        return self.wait_until(
            f"""(() => {{
              const element = document.querySelector({json.dumps(selector)});
              if (!element) return null;
              const [x, y] = {_CENTRE};
              const before = window.placeToClick;
              window.placeToClick = `${{x}} ${{y}}`;
              if (before !== window.placeToClick || !({condition})) return null;
              window.placeToClick = null;
              return [x, y];
            }})()"""
        )

    def mouse(self, kind, x, y, modifiers=()):
        """Move, press or release the left button: ``mouseMoved``, ``mousePressed``, …"""
        is_pressed = kind != 'mouseReleased'
        self.call(
            'Input.dispatchMouseEvent',
            {'type': kind, 'x': x, 'y': y, 'button': 'left', 'buttons': int(is_pressed),
             'clickCount': 1, 'modifiers': sum(_MODIFIERS[name] for name in modifiers)},
        )  # fmt: skip
        if kind == 'mousePressed':
            self._pressed = (x, y)
        elif kind == 'mouseReleased':
            self._pressed = None

    def wheel(self, selector, turn):
        """Turn the wheel over the middle of an element, pixels; towards the user is positive."""
        x, y = self.centre_of(selector)
        parameters = {'type': 'mouseWheel', 'x': x, 'y': y, 'deltaX': 0, 'deltaY': turn}
        self.call('Input.dispatchMouseEvent', parameters)

    def screenshot(self, path):
        """Write what is seen as a PNG."""
        path.write_bytes(self.picture('png'))

    def picture(self, kind, **options):
        """Return what is seen as the bytes of a ``png`` or ``webp`` file."""
        shot = self.call('Page.captureScreenshot', {'format': kind, **options})
        return base64.b64decode(shot['data'])

    def close(self):
        """Close the tab, as a person does: the page is not asked."""
        OPEN_PAGES.discard(self)
        self._browser.close_page(self._target, self._session)


def _environment():
    """Return the environment without what makes a browser's libraries those of the ROS wheels."""
    return {key: value for key, value in os.environ.items() if key != 'LD_LIBRARY_PATH'}
