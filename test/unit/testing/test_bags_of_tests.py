# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Which bags a test leaves, and where, with a simulation that only pretends to record."""

from types import SimpleNamespace

import pytest

from amr_description.testing import bags
from amr_description.testing.failure_logs import file_name


class Recorded:
    """A simulation; it makes ``parts`` files."""

    def __init__(self, parts=1):
        self.is_alive, self.parts, self.folders = True, parts, []

    def record(self, folder):
        folder.mkdir(parents=True)
        self.folders.append(folder)
        for number in range(self.parts):
            (folder / f'bag_{number}.mcap').write_text(str(number))

    def end_recording(self):
        pass


@pytest.fixture
def run(tmp_path):
    """Begins a run of pytest with options; then ends a test, and returns what is printed."""
    options = {'xmlpath': None, 'ros_bag_dir': None}
    config = SimpleNamespace(
        getoption=lambda name, default=None: options.get(name, default),
        getini=lambda name: {'ros_bag': 'never'}.get(name, ''),
        invocation_params=SimpleNamespace(dir=tmp_path),
    )

    def begin(**given):
        options.update(given)
        bags.configure(config)

    def end(nodeid, failed, when='call'):
        report = SimpleNamespace(nodeid=nodeid, failed=failed, when=when, sections=[])
        bags.add_bags(SimpleNamespace(config=config), report)
        return [text for _, text in report.sections]

    yield SimpleNamespace(begin=begin, end=end)
    bags.unconfigure()


def files(folder):
    return sorted(str(each.relative_to(folder)) for each in folder.rglob('*.mcap'))


def test_without_the_option_nothing_is_recorded(run):
    run.begin()
    sim = Recorded()
    bags.begin(sim)
    assert sim.folders == []


def test_a_test_that_fails_leaves_its_bag_and_one_that_passes_none(run, tmp_path):
    run.begin(ros_bag='on-failure')
    sim = Recorded()
    bags.begin(sim)
    assert run.end('test_a.py::test_x', failed=False) == []
    assert files(tmp_path) == []
    assert not sim.folders[0].exists()
    bags.begin(sim)
    assert run.end('test_a.py::test_y[a/b-1.5]', failed=False, when='setup') == []
    (text,) = run.end('test_a.py::test_y[a/b-1.5]', failed=True)
    assert files(tmp_path) == ['ros_bags/test_a.test_y.a.b-1.5.mcap']
    path = tmp_path / 'ros_bags' / 'test_a.test_y.a.b-1.5.mcap'
    assert [line.split() for line in text.splitlines()] == [
        [str(path)],
        f'to look at it: ros2 run amr_description viewer --bag {path}'.split(),
        f'to drive it again: ros2 run amr_description replay {path}'.split(),
    ]


def test_a_test_with_resets_leaves_a_file_for_each_part(run, tmp_path):
    run.begin(ros_bag='always', ros_bag_dir='kept')
    bags.begin(Recorded(parts=2))
    run.end('test_a.py::test_x', failed=False)
    assert files(tmp_path) == ['kept/test_a.test_x_0.mcap', 'kept/test_a.test_x_1.mcap']
    assert (tmp_path / 'kept' / 'test_a.test_x_1.mcap').read_text() == '1'


def test_two_tests_with_equal_file_names_have_a_bag_each(run, tmp_path):
    run.begin(ros_bag='on-failure', xmlpath=str(tmp_path / 'results' / 'report.xml'))
    for name in ('a/b', 'a.b'):
        bags.begin(Recorded())
        run.end(f'test_a.py::test_x[{name}]', failed=True)
    name = 'results/report.test_a.test_x.a.b'
    assert files(tmp_path) == [f'{name}-2.mcap', f'{name}.mcap']


def test_a_simulation_that_begins_again_in_a_test_has_its_last_recording(run, tmp_path):
    run.begin(ros_bag='on-failure')
    sim = Recorded()
    bags.begin(sim)
    bags.begin(sim)
    run.end('test_a.py::test_x', failed=True)
    assert len(files(tmp_path)) == 1
    assert not any(folder.exists() for folder in sim.folders)


def test_a_mode_of_the_settings_that_is_none_is_refused(run):
    with pytest.raises(pytest.UsageError, match="^ros_bag is 'often'; one of never, on-failure"):
        run.begin(ros_bag='often')


def test_long_names_are_shortened_and_stay_different():
    names = [file_name(f'test_a.py::test_x[{"ä" * 200}{end}]') for end in 'ab']
    assert len(set(names)) == 2
    assert all(len(name.encode()) < 170 for name in names)
