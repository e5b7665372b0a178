# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What ``ros2 topic echo`` prints of messages that come at once."""

from argparse import ArgumentParser

import pytest
from std_msgs.msg import String

from amr_description.cli.echo_printer import EchoPrinter
from amr_description.cli.topic import echo


@pytest.mark.parametrize(
    ('options', 'printed'),
    [
        ([], 'data: a\n---\ndata: b\n---\ndata: bc\n---\n'),
        (['--once'], 'data: a\n---\n'),
        (['--once', '--filter', "'b' in m.data"], 'data: b\n---\n'),
    ],
)
def test_once_is_one_message_however_many_have_come(capsys, options, printed):
    parser = ArgumentParser()
    echo.add_arguments(parser)
    printer = EchoPrinter(parser.parse_args(['/chatter', *options]), String)
    for text in ('a', 'b', 'bc'):  # as EventsExecutor hands over what has come
        printer.receive(String(data=text))
    assert capsys.readouterr().out == printed
