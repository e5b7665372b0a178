# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A page of a graph without robots offers nothing that would act on one."""

from test_page_memory import LongDrive
from test_viewer_pages import serving

from amr_description.viewer.protocol import Graph

OFFERED = """
    [...document.querySelectorAll('.view-tools button')]
      .filter((each) => !each.hidden).map((each) => each.textContent)
"""
EMPTY = "document.querySelector('.view-words h2')?.textContent === 'No robot'"
"""Whether the page has been told so; before that it knows of no robot, but offers all."""
DRIVES = "document.querySelector('.drive-head .chip').textContent"


def test_what_acts_on_a_robot_comes_and_goes_with_it(browser):
    drive = LongDrive()
    with_robot = drive.known
    drive.known = (Graph((), (), None),)
    with serving(drive, rate=20.0) as server:
        page = browser.open(server.url, width=1280, height=760)
        page.wait_until(f"{EMPTY} && {DRIVES} === 'No robot'")
        without = page.evaluate(OFFERED)
        drive.new = with_robot
        page.wait_until(f"{DRIVES} === 'Nobody drives'")
        with_it = page.evaluate(OFFERED)
        drive.new = drive.known
        page.wait_until(f"{DRIVES} === 'No robot'")
        again = page.evaluate(OFFERED)
        page.close()
    assert without == again
    assert set(with_it) - set(without) == {'Follow', 'Trails', 'Contacts', 'Clear trails'}
    assert page.errors == []
