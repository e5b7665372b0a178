"""Exercise 8: tests that find what is wrong with a robot."""

from collections import defaultdict
from pathlib import Path

from conftest import expect
import pytest

from amr_description import Simulation
from amr_description.ament_index import resolve_uri

SOUND = 'sound'
WRONG = {  # robot: what stands in its parameter file, and what stands there in place of it
    'short': ('wheel_radius: 0.10', 'wheel_radius: 0.11'),
    'lazy in turns': ('wheel_separation_multiplier: 2.82', 'wheel_separation_multiplier: 2.0'),
    'crossed': ('_left"', '_LEFT"'),
}


def parameters(robot: str) -> str:
    """Return the parameter file of a robot."""
    text = Path(resolve_uri('package://amr_description/config/controllers.yaml')).read_text()
    if robot != SOUND:
        text = text.replace(*WRONG[robot])
    if robot == 'crossed':
        text = text.replace('_right"', '_left"').replace('_LEFT"', '_right"')
    return text


class Robots:
    """A plugin of pytest: each test runs with each of the robots."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self.failed: dict[str, list[str]] = defaultdict(list)
        self.said = ''
        self.count = 0

    @pytest.fixture(scope='module', params=[SOUND, *WRONG])
    def shared(self, request):
        file = self._folder / 'controllers.yaml'
        file.write_text(parameters(request.param))
        with Simulation('package://amr_description/urdf/amr.urdf', file) as sim:
            yield sim

    @pytest.fixture
    def sim(self, shared):
        shared.reset()
        return shared

    def pytest_runtest_logreport(self, report):
        name, _, parameter = report.nodeid.rpartition('::')[2].partition('[')
        self.count += report.when == 'call'
        if report.failed:
            robot = next((each for each in WRONG if each in parameter), SOUND)
            self.failed[robot].append(name)
            if robot == SOUND:
                self.said = report.longreprtext.splitlines()[-1]


@pytest.fixture(scope='module')
def ran(request, tmp_path_factory):
    """What came of the tests of the student."""
    file = Path(request.config.option.work).resolve() / 'test_robot.py'
    if not file.is_file():
        pytest.fail(f'{file.name} is not there', pytrace=False)
    robots = Robots(tmp_path_factory.mktemp('robots'))
    options = ['-q', '-p', 'no:cacheprovider', '--noconftest', f'--rootdir={file.parent}']
    code = pytest.main([*options, str(file)], plugins=[robots])
    if not robots.count:
        pytest.fail(f'{file.name}: pytest finds no test in it, exit code {code:d}', pytrace=False)
    return robots


@pytest.mark.points(2)
def test_sound(ran):
    """They pass on a sound robot."""
    failed = ', '.join(ran.failed[SOUND])
    expect(not failed, f'{failed} fails on a robot that is sound: {ran.said}')


@pytest.mark.points(3)
def test_short(ran):
    """They find a robot that does not go as far as it is told."""
    finds(ran, 'short', 'is told to drive 1 m, and drives 0.91 m')


@pytest.mark.points(3)
def test_lazy(ran):
    """They find a robot that does not turn as it is told."""
    finds(ran, 'lazy in turns', 'is told to turn by 1 rad, and turns by 0.7 rad')


@pytest.mark.points(2)
def test_crossed(ran):
    """They find a robot whose sides are crossed."""
    finds(ran, 'crossed', 'is told to turn left, and turns right')


def finds(ran: Robots, robot: str, fault: str) -> None:
    """Expect a test to fail that passes on the sound robot."""
    if set(ran.failed[robot]) - set(ran.failed[SOUND]):
        return
    pytest.fail(f'no test of yours finds the robot that {fault}', pytrace=False)
