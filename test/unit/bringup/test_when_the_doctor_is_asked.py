# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Of which failures of a start the doctor is asked for the cause."""

import pytest
from support.doctor_graphs import end, graph, topic

from amr_description.bringup import Node
from amr_description.bringup.diagnosis import Diagnosis, is_unexplained
from amr_description.bringup.scheduler import Failure
from amr_description.doctor.observations import Observations
from amr_description.doctor.observations.graph import STAMPED_TWIST
from amr_description.doctor.rules.topic_names import misnamed_topics
from amr_description.nodes.start_failure import print_first_error

NODE = Node('talker')
FATAL = '[FATAL] [1.2] [create]: Entity creation failed'


@pytest.mark.parametrize(
    ('code', 'lines', 'is_asked'),
    [
        (1, ['Traceback', 'KeyError'], True),
        (102, [], True),
        (1, ['a', FATAL], False),
        (1, ['a', FATAL, ''], False),
        (1, [FATAL, 'Traceback'], True),
        (1, ['[create-3] [ERROR] [1.2] [create]: Entity creation failed'], False),
        (102, ['[ERROR] [1.2] [rcl]: Expected RMW implementation identifier'], True),
        (-9, ['a'], False),
        (126, ['could not be started: step begins with #!/nowhere, which is not there'], False),
    ],
)
def test_it_is_asked_where_nothing_else_explains(code, lines, is_asked):
    failure = Failure(NODE, code, 0)
    assert is_unexplained(failure, {NODE: lines}) is is_asked


def test_no_failure_is_no_question():
    assert not is_unexplained(None, {})


def test_lines_of_libraries_are_left_out():
    class Ended:
        def poll(self):
            return True

        def close(self): ...

    def spawn(_command, on_line):
        for line in ('[rcl]: hm', 'doctor: the domain', 'doctor:   fix: another'):
            on_line(line)
        return Ended()

    diagnosis = Diagnosis(spawn)
    assert diagnosis.is_over()
    diagnosis.close()
    assert diagnosis.text == 'the domain\n    fix: another'


def test_what_cannot_be_started_finds_nothing():
    def spawn(_command, _on_line):
        raise OSError('no memory')

    diagnosis = Diagnosis(spawn)
    assert (diagnosis.is_over(), diagnosis.text) == (True, '')


def test_a_graph_that_is_half_up_is_no_cause(capsys):
    """A mux whose controller never came, beside another one that waits: no name is wrong there."""
    commands = topic('/diff_drive_controller/cmd_vel', [end('/twist_mux', STAMPED_TWIST)])
    waiting = topic('/cmd_vel', [], [end('/bridge', STAMPED_TWIST)])
    seen = Observations(graph=graph(commands, waiting))
    assert [each.severity.name for each in misnamed_topics(seen)] == ['ERROR']
    assert not print_first_error(seen)
    assert capsys.readouterr().out == ''
