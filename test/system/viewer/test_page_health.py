# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The Health tab: what the doctor finds, as a page gets it."""

from test_page_memory import LongDrive
from test_viewer_pages import serving

from amr_description.viewer.introspection import FindingInfo, Findings

FOUND = FindingInfo(
    'error',
    'tf_two_parents',
    "the frame 'base_link' has 2 parents: 'odom' (published by /diff_drive_controller) and "
    "'base_footprint' (published by /robot_state_publisher)",
    "a frame can have one parent: 'base_link' jumps between them with each message",
    '`ros2 param set /diff_drive_controller base_frame_id base_footprint`',
)
DRIVES = "document.querySelector('.drive-head .chip').textContent"
SHOWN = "document.querySelector('.doctor')"


def test_findings_are_shown_with_a_fix_to_copy_until_they_are_gone(browser):
    drive = LongDrive()
    with serving(drive, rate=20.0) as server:
        page = browser.open(server.url, width=1280, height=900, webgl=False)
        page.wait_until(f"{DRIVES} === 'Nobody drives'")
        page.evaluate("document.querySelector('#tab-health').click()")
        drive.new = (Findings((FOUND,)),)
        page.wait_until(f'{SHOWN} !== null')
        assert page.evaluate(f"{SHOWN}.querySelector('code').textContent") == FOUND.fix.strip('`')
        assert page.evaluate(f"{SHOWN}.querySelector('button').title") == 'Copy the command'
        assert page.evaluate(f'{SHOWN}.scrollWidth <= {SHOWN}.clientWidth')
        drive.new = (Findings(()),)
        page.wait_until(f'{SHOWN} === null')
        page.close()
    assert page.errors == []
