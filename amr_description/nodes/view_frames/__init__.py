# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``view_frames``: draw the trees of frames that are published.

::

    ros2 run tf2_tools view_frames                # frames_2026-01-31_12.00.00.gv, .pdf and .svg
    ros2 run tf2_tools view_frames -o my_robot    # my_robot.gv, .pdf and .svg

It listens for 5 s (``--wait-time``). Options, texts and file names are those of the original. In
addition, the PDF needs no Graphviz, there is an SVG, the trees are printed, and the authority of a
frame is the nodes that publish on its topic instead of ``default_authority``.
"""

from argparse import ArgumentParser, ArgumentTypeError
from dataclasses import replace
import math
import os
from pathlib import Path
import threading
import time

from amr_description.errors import UsageError
from amr_description.nodes.view_frames.drawing import as_pdf, as_svg, draw
from amr_description.tf2_ros.frame_graph import as_dot, as_tree, FrameRecord
from amr_description.tf2_ros.listener import (
    DEFAULT_STATIC_TF_TOPIC,
    DEFAULT_TF_TOPIC,
    TransformListener,
)
from amr_description.tf2_ros.statistics import broadcaster
from amr_description.tf2_ros.tools import arguments_of, listening, print_now, run_tool


def parser() -> ArgumentParser:
    """Return the parser of the command line, without ROS arguments."""
    made = ArgumentParser(
        prog='view_frames',
        description='Create a diagram of the TF frames being broadcast over ROS',
    )
    made.add_argument(
        '--wait-time',
        '-t',
        type=_seconds,
        default=5.0,
        help='How long to listen before the diagram is made, s (default: 5)',
    )
    made.add_argument('-o', '--output', help='Name of the files, without .gv, .pdf and .svg')
    made.add_argument('--tf_topic', default=DEFAULT_TF_TOPIC, help='Topic for dynamic transforms')
    made.add_argument(
        '--tf_static_topic', default=DEFAULT_STATIC_TF_TOPIC, help='Topic for static transforms'
    )
    return made


def view(args: list[str] | None) -> None:
    """Listen, then write the files. Raises UsageError if they cannot be written."""
    options = parser().parse_args(arguments_of(args))
    name = options.output or time.strftime('frames_%Y-%m-%d_%H.%M.%S')
    _require_folder(Path(name))
    topics = {'tf_topic': options.tf_topic, 'tf_static_topic': options.tf_static_topic}
    with listening('view_frames', args, **topics) as (node, buffer, listener):
        logger = node.get_logger()
        logger.info(f'Listening to tf data for {options.wait_time} seconds...')
        threading.Event().wait(options.wait_time)
        logger.info('Generating graph...')
        records = _with_broadcasters(buffer.records(), listener, **topics)
        now = node.get_clock().now().nanoseconds
        if not records:
            logger.warning(f'No tf data received: is {" or ".join(topics.values())} published?')
        logger.info(f'Exporting graph in {name}.pdf file...')
    print_now(as_tree(records))
    write(name, records, now)


def write(name: str, records: list[FrameRecord], recorded: int) -> None:
    """Write ``name`` .gv, .pdf and .svg; ``recorded`` is in ns. Raises UsageError."""
    drawing = draw(records, recorded)
    try:
        Path(f'{name}.gv').write_text(as_dot(records, recorded), 'utf-8')
        Path(f'{name}.pdf').write_bytes(as_pdf(drawing))
        Path(f'{name}.svg').write_text(as_svg(drawing), 'utf-8')
    except OSError as error:
        raise UsageError(f"-o '{name}': {error.filename}: {error.strerror}") from error


def main(args: list[str] | None = None) -> int:
    """Draw the frames."""
    return run_tool(lambda: view(args))


def _require_folder(name: Path) -> None:
    """Raise UsageError now rather than after listening for seconds."""
    if not name.parent.is_dir():
        raise UsageError(f"-o '{name}': there is no folder '{name.parent}'")
    if not os.access(name.parent, os.W_OK):
        raise UsageError(f"-o '{name}': no permission to write into '{name.parent.resolve()}'")


def _with_broadcasters(
    records: list[FrameRecord], listener: TransformListener, tf_topic: str, tf_static_topic: str
) -> list[FrameRecord]:
    """Return the records with the nodes that publish each frame as its authority."""
    nodes = {topic: broadcaster(names) for topic, names in listener.publishers().items()}
    return [
        replace(record, authority=nodes[tf_static_topic if record.is_static else tf_topic])
        for record in records
    ]


def _seconds(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not 0.0 <= value < math.inf:
        raise ArgumentTypeError(f"'{text}' is no time in s")
    return value
