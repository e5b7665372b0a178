# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Which bags a test leaves, and where, with a simulation that only pretends to record."""

from pathlib import Path
from types import SimpleNamespace

import pytest

from amr_description.errors import SimulationError
from amr_description.testing import bags
from amr_description.testing.failure_logs import file_name


class Simulated:
    """A simulation with its one recording, of ``parts`` files; it keeps what it is asked."""

    def __init__(self, parts=1):
        self.is_alive, self.parts, self.calls, self.going, self.error = True, parts, [], None, ''
        self.recording = bags.Recording(self.set_record, lambda: self.is_alive)

    def set_record(self, folder):
        self.calls.append(folder)
        former, self.going = self.going, None
        if self.error and not folder:
            raise SimulationError(self.error)
        if former is not None:
            (former / 'metadata.yaml').write_text('complete')
        if folder:
            self.going = Path(folder)
            self.going.mkdir(parents=True)
            for number in range(self.parts):
                (self.going / f'bag_{number}.mcap').write_text(str(number))

    @property
    def folders(self):
        return [Path(each) for each in self.calls if each]


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

    def end(nodeid, failed, when='call', skipped=False):
        report = SimpleNamespace(
            nodeid=nodeid, failed=failed, skipped=skipped, when=when, sections=[]
        )
        bags.add_bags(SimpleNamespace(config=config), report)
        return [text for _, text in report.sections]

    yield SimpleNamespace(begin=begin, end=end)
    bags.unconfigure()


def files(folder):
    return sorted(str(each.relative_to(folder)) for each in folder.rglob('*.mcap'))


def test_without_the_option_nothing_is_recorded(run):
    run.begin()
    sim = Simulated()
    bags.begin(sim.recording)
    assert sim.folders == []


def test_a_test_that_fails_leaves_its_bag_and_one_that_passes_none(run, tmp_path):
    run.begin(ros_bag='on-failure')
    sim = Simulated()
    bags.begin(sim.recording)
    assert run.end('test_a.py::test_x', failed=False) == []
    assert files(tmp_path) == []
    assert sim.calls == [str(sim.folders[0]), '']
    assert not sim.folders[0].exists()
    bags.begin(sim.recording)
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
    bags.begin(Simulated(parts=2).recording)
    run.end('test_a.py::test_x', failed=False)
    assert files(tmp_path) == ['kept/test_a.test_x_0.mcap', 'kept/test_a.test_x_1.mcap']
    assert (tmp_path / 'kept' / 'test_a.test_x_1.mcap').read_text() == '1'


def test_two_tests_with_equal_file_names_have_a_bag_each(run, tmp_path):
    run.begin(ros_bag='on-failure', xmlpath=str(tmp_path / 'results' / 'report.xml'))
    for name in ('a/b', 'a.b'):
        bags.begin(Simulated().recording)
        run.end(f'test_a.py::test_x[{name}]', failed=True)
    name = 'results/report.test_a.test_x.a.b'
    assert files(tmp_path) == [f'{name}-2.mcap', f'{name}.mcap']


def test_a_simulation_that_begins_again_in_a_test_has_its_last_recording(run, tmp_path):
    run.begin(ros_bag='on-failure')
    sim = Simulated()
    bags.begin(sim.recording)
    bags.begin(sim.recording)
    run.end('test_a.py::test_x', failed=True)
    assert len(files(tmp_path)) == 1
    first, second = sim.folders
    assert sim.calls == [str(first), '', str(second), '']
    assert not any(folder.exists() for folder in sim.folders)


def test_the_recording_of_a_test_that_records_from_the_start_is_left_alone(run, tmp_path):
    run.begin(ros_bag='always')
    sim = Simulated()
    sim.recording.begin_own(tmp_path / 'own')
    bags.begin(sim.recording)
    (text,) = run.end('test_a.py::test_x', failed=False)
    assert text == f'the test itself records to {tmp_path / "own"}'
    assert sim.calls == [str(tmp_path / 'own')]
    sim.recording.end_own()
    assert (tmp_path / 'own' / 'metadata.yaml').exists()
    bags.begin(sim.recording)  # the next test has a recording of the option again
    (text,) = run.end('test_a.py::test_y', failed=False)
    assert files(tmp_path) == ['own/bag_0.mcap', 'ros_bags/test_a.test_y.mcap']


def test_a_recording_within_a_test_ends_that_of_the_option_which_stays(run, tmp_path):
    run.begin(ros_bag='on-failure')
    sim = Simulated()
    bags.begin(sim.recording)
    sim.recording.end_own()
    assert len(sim.calls) == 1, 'it has ended what it has not begun'
    sim.recording.begin_own(tmp_path / 'own')
    (text,) = run.end('test_a.py::test_x', failed=True)
    assert sim.calls[1:] == [str(tmp_path / 'own')]
    assert files(tmp_path) == ['own/bag_0.mcap', 'ros_bags/test_a.test_x.mcap']
    assert text.endswith(f'\nthe test itself records to {tmp_path / "own"}')


def test_a_bag_that_is_not_complete_is_said_to_be_so(run):
    run.begin(ros_bag='on-failure')
    sim = Simulated()
    bags.begin(sim.recording)
    sim.error = 'No space left on device'
    (text,) = run.end('test_a.py::test_x', failed=True)
    assert text.endswith('\nnot complete: No space left on device')


@pytest.mark.parametrize('when', ['setup', 'call', 'teardown'])
def test_a_test_that_is_skipped_leaves_its_recording_to_no_other_one(run, tmp_path, when):
    run.begin(ros_bag='on-failure')
    sim = Simulated()
    bags.begin(sim.recording)
    assert run.end('test_a.py::test_x', failed=False, when=when, skipped=when == 'setup') == []
    assert run.end('test_a.py::test_y', failed=True) == []
    assert files(tmp_path) == []
    assert sim.calls[1:] == ['']


def test_a_mode_of_the_settings_that_is_none_is_refused(run):
    with pytest.raises(pytest.UsageError, match="^ros_bag is 'often'; one of never, on-failure"):
        run.begin(ros_bag='often')


def test_long_names_are_shortened_and_stay_different():
    names = [file_name(f'test_a.py::test_x[{"ä" * 200}{end}]') for end in 'ab']
    assert len(set(names)) == 2
    assert all(len(name.encode()) < 170 for name in names)
