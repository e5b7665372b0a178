# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A page of docs/, its fenced blocks as a reader would use them, and the robot that they drive."""

import re
import sys

from support.control_fakes import FakeLog
from support.paths import EXECUTABLES, ROOT
import yaml

from amr_description.clock import NANOSECONDS
from amr_description.control.contracts import ControllerContext
from amr_description.control.controller_manager import ControllerManager
from amr_description.control.resource_manager import ResourceManager
from amr_description.control.switching import Strictness
from amr_description.controllers import CONTROLLERS
from amr_description.hardware import HARDWARE
from amr_description.model import ros2_control_tag, urdf
from amr_description.parameters import build

PERIOD = NANOSECONDS // 100


class Page:
    """The text of a page of docs/ and its blocks; ``../README.md`` is the front page."""

    def __init__(self, name):
        self.name = name
        self.path = ROOT / 'docs' / name
        self.text = self.path.read_text(encoding='utf-8')

    def blocks(self, language=''):
        """The fenced blocks of a language, in their order."""
        return re.findall(rf'^```{language}\n(.*?)^```$', self.text, re.DOTALL | re.MULTILINE)

    def tables(self):
        """The YAML blocks, read."""
        return [yaml.safe_load(block) for block in self.blocks('yaml')]

    def run(self, block):
        """Run a block of Python; return its names."""
        names = {}
        exec(compile(block, self.name, 'exec'), names)
        return names

    def quoted(self):
        """Every piece of text in backticks, on one line."""
        prose = re.sub(r'^```.*?^```$', '', self.text, flags=re.DOTALL | re.MULTILINE)
        return [' '.join(each.split()) for each in re.findall(r'`([^`]+)`', prose)]

    def is_sound(self):
        """Every file and heading that it links to, and every executable it starts, is there."""
        links = re.findall(r'\]\(([^):]+)\)', self.text)
        started = re.findall(r'ros2 run amr_description (\w+)', self.text)
        return (
            bool(links and started)
            and all(self._leads_somewhere(*link.partition('#')[::2]) for link in links)
            and {*started} <= EXECUTABLES.keys()
        )

    def _leads_somewhere(self, path, heading):
        page = ROOT / 'docs' / (path or self.name)
        if not (page.is_file() and heading):
            return page.is_file()
        titles = re.findall(r'^#+ (.*)', page.read_text(), re.MULTILINE)
        return heading in {
            re.sub(r'[^\w -]', '', title.lower()).replace(' ', '-') for title in titles
        }


def install(folder, monkeypatch, **modules):
    """Write my_package with these modules, and let Python find it until the test ends."""
    package = folder / 'my_package'
    package.mkdir()
    for name, text in modules.items():
        (package / f'{name}.py').write_text(text)
    monkeypatch.syspath_prepend(folder)
    for name in [name for name in sys.modules if name.split('.')[0] == 'my_package']:
        monkeypatch.delitem(sys.modules, name)


def mocked(hardware):
    """The text of the shipped robot's URDF with this <hardware> block."""
    text = (ROOT / 'urdf' / 'amr.urdf').read_text()
    return re.sub('<hardware>.*?</hardware>', hardware, text, flags=re.DOTALL)


class Robot:
    """The shipped robot over mock hardware that integrates, with controllers from YAML."""

    def __init__(self, description):
        self.log = FakeLog()
        resources = ResourceManager(self.log)
        for info in ros2_control_tag.hardware_of(urdf.parse(description)):
            resources.load(info, HARDWARE.find, None)
        resources.start_components()
        self.manager = ControllerManager(resources, 100, self.log)
        self.controllers = {}
        self.time = 0

    def load(self, table):
        """Load and configure every controller of a YAML file, for a manager or for a spawner."""
        entries = table.get('controller_manager', table)
        for name, entry in entries.get('ros__parameters', entries).items():
            own = table.get(name, {}).get('ros__parameters', {})
            kind_name = own.get('type') or (isinstance(entry, dict) and entry.get('type'))
            if kind_name:
                kind = CONTROLLERS.find(kind_name)
                controller = kind(ControllerContext(name, self.log))
                self.manager.load(controller, kind_name, own.get('fallback_controllers', ()))
                self.manager.configure(name, build(kind.parameters_type, flat(own)))
                self.controllers[name] = controller
        return self

    def switch(self, activate='', deactivate=''):
        """Names in one text; STRICT."""
        names = activate.split(), deactivate.split()
        return self.manager.switch(*names, Strictness.STRICT, self.time)

    def run(self, seconds):
        for _ in range(round(100 * seconds)):
            self.time += PERIOD
            self.manager.tick(self.time)

    @property
    def active(self):
        return set(self.manager.snapshot.active_controllers)

    @property
    def wheels(self):
        handles = self.manager.resources.available_commands().items()
        return [handle.value for name, handle in handles if name.startswith('joint_')]


def flat(values, prefix=''):
    """Dotted names for nested ones."""
    found = {}
    for name, value in values.items():
        if isinstance(value, dict):
            found |= flat(value, f'{prefix}{name}.')
        else:
            found[prefix + name] = value
    return found
