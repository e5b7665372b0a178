# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Where charts stand, however many there are, and what they are called, in a browser."""

import pytest
from test_page_memory import LongDrive
from test_viewer_pages import serving

PLACES = """
    [...document.querySelectorAll('.charts > .chart')].map((each) => {
      const { left, top, right, height } = each.getBoundingClientRect();
      return { left, top, right, height };
    })
"""
LONG = '/a_robot/joint_state_broadcaster/a_long_name_of_a_topic:position[0]'


@pytest.fixture(scope='module')
def tab(browser):
    page = browser.open('about:blank', webgl=False)
    yield page
    assert page.errors == []
    page.close()


def opened(page, server, plots, **look):
    page.look_like(**look)
    page.go(f'{server.url}#plots={plots}')
    page.wait_until("amr.now.link === 'open' && document.querySelector('.charts > .chart')")
    return page


@pytest.mark.parametrize('count', [1, 4, 5, 7])
def test_every_row_of_charts_is_as_wide_as_the_plots(tab, count):
    plots = ';'.join(f'/odom:pose.pose.position.x@{least}..9' for least in range(count))
    with serving(LongDrive(), rate=20.0) as server:
        page = opened(tab, server, plots, width=1280, height=900)
        places = page.evaluate(PLACES)
        width = page.evaluate("document.querySelector('.charts').clientWidth")
        page.go('about:blank')
    assert len(places) == count
    rows = {each['top']: [] for each in places}
    for each in places:
        rows[each['top']].append(each)
    assert [row[-1]['right'] - row[0]['left'] for row in rows.values()] == [
        pytest.approx(width, abs=1) for _ in rows
    ]
    assert min(each['height'] for each in places) >= 150
    assert page.errors == []


def test_a_title_is_not_cut_where_nothing_can_hover(tab):
    with serving(LongDrive(), rate=20.0) as server:
        page = opened(tab, server, LONG, width=390, height=800, phone=True)
        page.click('.open-panels')
        page.evaluate("document.getElementById('tab-plots').click()")
        page.wait_until("document.querySelector('.chart-title').clientWidth > 0")
        cut = page.evaluate("""(() => {
          const { scrollWidth, clientWidth, textContent } = document.querySelector('.chart-title');
          return [scrollWidth > clientWidth, textContent];
        })()""")
        page.go('about:blank')
    assert cut == [False, '/a_robot/joint_state_broadcaster/a_long_name_of_a_topic position']
