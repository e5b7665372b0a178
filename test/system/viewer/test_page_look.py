# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Every tab of the page, in every form and theme: nothing overflows, overlaps or is cut off, it is as
accessible as axe-core can tell, and it looks as it did when somebody last looked at it.

The robots are a script; what is drawn on canvases (scene, plots) is not looked at here.
"""

from dataclasses import replace
import gzip
import json
import re

import pytest
from support import looks, scripted_robots
from support.paths import ROOT

AUDIT = (ROOT / 'test' / 'support' / 'page_audit.js').read_text()
AXE = ROOT / 'test' / 'third_party' / 'axe.min.js.gz'
RULES = ('wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa', 'best-practice')
FORMS = {'desk': (1440, 900, False), 'tall': (390, 844, True), 'wide': (844, 390, True)}
THEMES = ('light', 'dark')
SIZES = {
    # What phones, zoomed pages and small windows have: WCAG 1.4.10 asks for 320 px.
    'phone_320': (320, 568, True, 'tall'),
    'phone_landscape': (667, 375, True, 'wide'),
    'zoom_200_of_1440x900': (720, 450, False, 'wide'),
    'zoom_150_of_1280x720': (853, 480, False, 'wide'),
    'zoom_400_of_1280x1024': (320, 256, False, 'wide'),
    'small_window': (700, 600, False, 'wide'),
    'laptop_window': (1366, 620, False, 'wide'),
    'tablet': (820, 1180, True, 'tall'),
    'half_a_screen': (960, 1080, False, 'desk'),
    'small_desk': (1024, 680, False, 'desk'),
    '4k': (3840, 2160, False, 'desk'),
}
USUAL = ('phone_320', 'phone_landscape', 'zoom_200_of_1440x900', 'half_a_screen')
"""Those that are not only looked at in the long run."""
DRAWN = """
    (async () => {
      const after = (ms) => new Promise((done) => setTimeout(done, ms));
      const { states } = amr.now;
      while (amr.now.states === states) await after(5);
      await after(100);  // ten times a second panels take over what has come: by now they have
      for (let frame = 0; frame < 2; frame++) await new Promise(requestAnimationFrame);
      return true;
    })()"""
"""That what is shown now has a state, and is drawn."""
FONTS = """
    (() => {
      const pen = new OffscreenCanvas(1, 1).getContext('2d');
      return ['sans', 'mono'].map((name) => {
        pen.font = `100px ${getComputedStyle(document.body).getPropertyValue(`--${name}`)}`;
        return Math.round(pen.measureText('Robot 0123').width);
      }).concat(navigator.userAgent.match(/Chrome\\/\\d+/)[0]);
    })()"""


@pytest.fixture(scope='module')
def robots():
    with scripted_robots.serving(scripted_robots.simulation()) as found:
        yield found


@pytest.fixture(scope='module')
def page(browser, robots):
    page = browser.open(robots[1], pixels=0.5, every_frame=True)  # each one is waited for
    page.wait_until(f'amr.now.time > {scripted_robots.SECONDS - 0.2}')
    page.evaluate(f'{AUDIT};0')
    page.evaluate(
        """(() => {
          const sheet = new CSSStyleSheet();
          sheet.replaceSync('canvas, [data-pictured] .dock { visibility: hidden }');
          document.adoptedStyleSheets.push(sheet);
        })()"""
    )
    yield page
    assert page.errors == []
    page.close()


def be(page, size, form, *, dark=False):
    """Have the page that size, with its panels open."""
    page.look_like(*size[:2], phone=size[2], dark=dark)
    page.wait_until(f"innerWidth === {size[0]} && document.body.dataset.form === '{form}'")
    scheme = 'dark' if dark else 'light'
    page.wait_until(f"document.documentElement.dataset.theme === '{scheme}'")
    page.evaluate(
        """(() => {
          const isClosed = document.querySelector('.sheet').inert;
          if (isClosed) document.querySelector('.open-panels').click();
          document.activeElement.blur();
        })()"""
    )
    page.evaluate(DRAWN)


def every_combination(request):
    """Whether every tab is looked at in every form and theme; else in one of each, to be quick."""
    return request.config.option.long or looks.IS_RECORDING


def tabs_of(page):
    """The names of the tabs that there are."""
    return page.evaluate(
        "[...document.querySelectorAll('[role=tab]')].filter((tab) => !tab.hidden)"
        '.map((tab) => tab.id.slice(4))'
    )


def show(page, tab):
    page.evaluate("document.querySelector('.tabs').scrollTo(0, 0)")  # whatever was shown before
    page.evaluate(f"document.getElementById('tab-{tab}').click()")
    if tab == 'parameters':
        # A choice that is not there yet cannot be made.
        page.wait_until(
            "[...document.getElementById('parameter-node').options]"
            ".some(({ value }) => value === '/controller_manager')"
        )
        page.evaluate(
            """(() => {
              const node = document.getElementById('parameter-node');
              node.value = '/controller_manager';
              node.dispatchEvent(new Event('change', { bubbles: true }));
            })()"""
        )
        page.wait_until("document.querySelector('#panel-parameters .parameter')")
    elif tab == 'services':
        page.wait_until("document.querySelector('#panel-services .topic')")
        page.evaluate(
            """(() => {
              const last = [...document.querySelectorAll('#panel-services .topic')].at(-1);
              if (last.ariaExpanded !== 'true') last.click();
            })()"""
        )
        page.wait_until("document.getElementById('field-state.state')")
        page.evaluate("document.querySelector('#panel-services .button.primary').click()")
        page.wait_until("document.querySelector('#panel-services .answer')")
    page.evaluate(DRAWN)


def picture(page):
    """What is seen, without what is drawn on canvases, and without the plots of the desk."""
    page.evaluate("document.body.dataset.pictured = ''; 0")
    jpeg = page.picture('jpeg', quality=85)
    page.evaluate('delete document.body.dataset.pictured')
    return jpeg


@pytest.mark.parametrize('form', FORMS)
def test_every_tab_is_as_it_was_when_somebody_looked(page, request, form):
    kinds, faults = {}, []
    fonts = page.evaluate(FONTS)
    for theme in THEMES:
        be(page, FORMS[form], form, dark=theme == 'dark')
        tabs = tabs_of(page)
        if theme == 'dark' and not every_combination(request):
            tabs = tabs[[*FORMS].index(form) :: len(FORMS)]
        for tab in tabs:
            show(page, tab)
            name = f'{form}_{theme}_{tab}'
            share, most = looks.compare_picture(name, picture(page), fonts)
            if share > most:
                faults.append(f'{name}: {share:.0%} of the picture differs; {looks.AGAIN}')
            if theme == 'light':  # in the other one the colours are others, by the same names
                faults += [f'{name}: {each}' for each in page.evaluate('auditPage.faults()')]
                for kind, seen in page.evaluate('auditPage.styles()').items():
                    kinds.setdefault(kind, set()).update(seen)
    merged = {kind: sorted(seen) for kind, seen in kinds.items()}
    different = looks.compare_styles(form, merged)
    faults += [f'{form}: {each}; {looks.AGAIN}' for each in different]
    assert faults == []


@pytest.mark.parametrize(
    'name',
    [pytest.param(each, marks=[pytest.mark.long] * (each not in USUAL)) for each in SIZES],
)
def test_nothing_overflows_or_overlaps(page, name):
    *size, form = SIZES[name]
    be(page, size, form)
    show(page, 'health')
    assert page.evaluate('auditPage.faults()') == []
    if form != 'desk':
        page.evaluate("document.querySelector('.sheet-head .button:last-child').click()")
        page.evaluate(DRAWN)
        assert page.evaluate('auditPage.faults()') == []


def test_a_low_window_is_for_the_view(page):
    be(page, (667, 375, True), 'wide')
    page.evaluate("document.querySelector('.sheet-head .button:last-child').click()")
    page.evaluate(DRAWN)
    high = "document.querySelector('.view').getBoundingClientRect().height"
    assert page.evaluate(high) > 0.8 * 375
    stick = "document.querySelector('.joystick').getBoundingClientRect()"
    assert page.evaluate(f'{stick}.width >= 88 && {stick}.bottom <= 375')


def test_an_open_panel_leaves_robot_and_stop_in_sight(page):
    be(page, (390, 844, True), 'tall')
    show(page, 'joints')
    view, panel = (
        page.evaluate(f"document.querySelector('{each}').getBoundingClientRect().toJSON()")
        for each in ('.view', '.panel:not([hidden])')
    )
    assert view['height'] > 0.25 * 844
    assert view['bottom'] < panel['top']
    assert page.evaluate('auditPage.faults()') == []


SELECTED = "document.querySelector('[role=tab][aria-selected=true]').id"


def test_display_opens_on_its_sliders_whatever_was_looked_at_in_a_simulation(page, robots):
    backend, _ = robots
    be(page, FORMS['desk'], 'desk')
    show(page, 'health')
    try:
        backend.show(scripted_robots.arm())
        page.wait_until(f"{SELECTED} === 'tab-joints'")
        page.wait_until("document.querySelectorAll('.joint input[type=range]').length === 20")
    finally:
        backend.show(scripted_robots.simulation())
    page.wait_until(f"{SELECTED} === 'tab-health'")


IN_HEAD = '.top h1 select, .top > .transport, .top > .recorder, .top > .clock, .top > .button'
PLACES = f"""
    [...document.querySelectorAll('{IN_HEAD}')].map((each) => each.getBoundingClientRect())
    .filter(({{ width }}) => width > 0).map(({{ left, right }}) => [left, right])
"""


@pytest.mark.parametrize('width', [320, 390])
def test_nothing_on_a_phone_covers_the_name_of_the_robot_of_several(page, robots, width):
    backend, _ = robots
    page.look_like(width, 800, phone=True)
    scene = scripted_robots.simulation()
    (subject, graph), *others = scene.messages
    (robot,) = graph.robots
    fleet = replace(graph, robots=(robot, replace(robot, id='/robot1', name='robot1')))
    try:
        backend.show(replace(scene, messages=((subject, fleet), *others)))
        page.wait_until("document.querySelectorAll('.top h1 option').length === 2")
        places = page.evaluate(PLACES)
    finally:
        backend.show(scene)
    assert len(places) == 6
    ends = [each for place in places for each in place]
    assert ends == sorted(ends)
    assert ends[-1] <= width


def test_a_graph_without_a_robot_says_the_command_that_starts_one(page, robots):
    backend, _ = robots
    be(page, FORMS['desk'], 'desk')
    show(page, 'model')
    command = "document.querySelector('{} .command code')?.textContent"
    wanted = "'ros2 launch amr_description simulation'"
    try:
        backend.show(scripted_robots.nothing())
        for place in ('.view-words', '#panel-model'):
            page.wait_until(f'{command.format(place)} === {wanted}')
            page.wait_until(f'document.querySelector(\'{place} [title="Copy the command"]\')')
    finally:
        backend.show(scripted_robots.simulation())
    page.wait_until("document.querySelector('#panel-model .findings')")


def test_the_scene_goes_back_with_the_plots_and_comes_again(page):
    be(page, FORMS['desk'], 'desk')
    page.wait_until(f'amr.now.time > {scripted_robots.SECONDS - 0.2}')  # it rests from 4 s on
    page.evaluate(DRAWN)
    pose, past = 'JSON.stringify(amr.now.scene.pose)', "document.querySelector('.view-past')"
    now = page.evaluate(pose)
    page.click('.plot-tools .toggle')
    page.evaluate(
        """(() => {
          const chart = document.querySelector('.chart-plot');
          const event = () => new KeyboardEvent('keydown', { key: 'ArrowLeft', bubbles: true });
          for (let step = 0; step < 400; step++) chart.dispatchEvent(event());
        })()"""
    )
    page.wait_until(f"{pose} !== '{now}' && !{past}.hidden")
    page.click('.view-past .button')
    page.wait_until(f"{pose} === '{now}' && {past}.hidden")


def violations(page):
    options = json.dumps({'resultTypes': ['violations'], 'runOnly': RULES, 'preload': False})
    return page.evaluate(
        f"""axe.run(document, {options}).then((found) => found.violations.flatMap(
          ({{ id, nodes }}) => nodes.map((node) => `${{id}}: ${{node.target}}`)))"""
    )


def test_axe_is_the_version_of_the_lock_file():
    lock = json.loads((ROOT / 'web' / 'package-lock.json').read_text())
    locked = lock['packages']['node_modules/axe-core']['version']
    found = re.search(rb'/\*! axe v([\d.]+)', gzip.decompress(AXE.read_bytes()))
    assert found[1].decode() == locked, 'see test/third_party/README.md'


@pytest.mark.parametrize('form', FORMS)
@pytest.mark.parametrize('theme', THEMES)
def test_axe_finds_no_violation(page, request, form, theme):
    page.evaluate(f'window.axe || (() => {{ {gzip.decompress(AXE.read_bytes()).decode()} }})();0')
    be(page, FORMS[form], form, dark=theme == 'dark')
    tabs = tabs_of(page)
    if not every_combination(request):
        first = 2 * [*FORMS].index(form) + THEMES.index(theme)
        tabs = tabs[first :: len(FORMS) * len(THEMES)]
    found = {}
    for tab in tabs:
        show(page, tab)
        if violated := violations(page):
            found[tab] = violated
    assert found == {}


def press(page, tool, title):
    """Press a button at the head of a tool."""
    page.evaluate(
        f'document.querySelector(\'#panel-{tool} .panel-head [title="{title}"]\').click()'
    )


def box(page, selector):
    """Where an element is."""
    return page.evaluate(f"document.querySelector('{selector}').getBoundingClientRect().toJSON()")


BESIDE, BELOW, BACK = 'Large, beside the scene', 'Large, over the plots', 'Back into the column'


@pytest.fixture
def desk(page):
    """The page on a small laptop, where all stands as at first; so it does afterwards."""
    be(page, (1280, 720, False), 'desk')
    yield page
    be(page, (1280, 720, False), 'desk')
    page.evaluate("document.querySelector('.reset-layout').click()")
    assert page.evaluate("localStorage.getItem('amr.tools')") == ''


def test_every_tool_stands_large_beside_the_scene_and_over_the_plots(desk, request):
    faults = []
    for number, tool in enumerate(tabs_of(desk)):
        for place in (
            (BESIDE, BELOW) if every_combination(request) else [(BESIDE, BELOW)[number % 2]]
        ):
            show(desk, tool)
            press(desk, tool, place)
            desk.evaluate(DRAWN)
            panel, view = box(desk, f'#panel-{tool}'), box(desk, '.view')
            assert view['width'] >= 240 and view['height'] >= 200, tool  # the robot stays in sight
            if place == BESIDE:
                assert panel['left'] >= view['right'] and panel['height'] == view['height'], tool
            else:
                assert panel['top'] >= view['bottom'] and panel['height'] > 0.45 * 720, tool
            assert panel['width'] >= 400, tool
            faults += [f'{tool}, {place}: {each}' for each in desk.evaluate('auditPage.faults()')]
            press(desk, tool, BACK)
    assert faults == []


def test_tools_beside_one_another_are_all_told_what_comes(desk):
    show(desk, 'frames')
    show(desk, 'health')
    press(desk, 'health', BESIDE)
    show(desk, 'log')
    press(desk, 'log', BELOW)
    show(desk, 'topics')
    seen = "[...document.querySelectorAll('.panel:not([hidden])')].map(({ id }) => id).sort()"
    assert desk.evaluate(seen) == ['panel-health', 'panel-log', 'panel-topics']
    desk.wait_until("document.querySelector('#panel-log .words')")
    desk.wait_until("document.querySelector('#panel-topics .topic')")
    desk.wait_until("document.querySelector('#panel-health .doctor > .unit')")
    # The tab of one that is large leads to it; what is in the column stays.
    desk.evaluate("document.getElementById('tab-log').click()")
    assert desk.evaluate('document.activeElement.id') == 'panel-log'
    assert desk.evaluate(seen) == ['panel-health', 'panel-log', 'panel-topics']
    # The plots are a tab while something stands in their place.
    desk.evaluate("document.getElementById('tab-plots').click()")
    assert desk.evaluate("document.querySelector('#panel-plots .charts').checkVisibility()")
    press(desk, 'log', BACK)
    assert desk.evaluate("document.querySelector('.dock .charts').checkVisibility()")
    assert 'plots' not in tabs_of(desk)


def test_a_layout_comes_back_by_itself_and_by_its_link(browser, robots):
    first = browser.open(robots[1], webgl=False)
    first.look_like(1280, 720)
    first.wait_until("window.amr?.now.link === 'open'")
    try:
        show_and_press = "document.getElementById('tab-graph').click();" + (
            f'document.querySelector(\'#panel-graph [title="{BESIDE}"]\').click();'
            "document.querySelector('.fold-drive').click();"
            "document.querySelector('.of-column').focus();0"
        )
        first.evaluate(show_and_press)
        before = box(first, '.driving')['width']
        first.key_down('ArrowLeft')
        first.key_up('ArrowLeft')
        wide = box(first, '.driving')['width']
        assert wide == pytest.approx(before + 0.03 * 1280, abs=1)
        first.evaluate(
            "[...document.querySelectorAll('.menu-items button')]"
            ".find((each) => each.textContent === 'Copy link').click()"
        )
        first.wait_until("location.hash.includes('tools=')")
        link = first.evaluate('location.href')
        for address, keep in ((robots[1], True), (link, False)):
            if not keep:
                first.evaluate('localStorage.clear()')
            first.go('about:blank')
            first.go(address)
            first.wait_until("window.amr?.now.link === 'open'")
            assert (
                first.evaluate("document.getElementById('panel-graph').dataset.place") == 'beside'
            )
            assert first.evaluate("document.querySelector('.drive').matches('.small')")
            assert box(first, '.driving')['width'] == pytest.approx(wide, abs=1)
            assert not first.evaluate("document.querySelector('.readout').checkVisibility()")
            assert first.evaluate("document.querySelector('.stop').checkVisibility()")
        first.evaluate("document.querySelector('.reset-layout').click()")
        assert box(first, '.driving')['width'] == pytest.approx(before, abs=1)
        assert first.evaluate("document.getElementById('panel-graph').dataset.place") == 'column'
        assert first.evaluate('location.hash') == ''
        assert first.errors == []
    finally:
        first.evaluate('localStorage.clear()')
        first.close()


@pytest.mark.parametrize('theme', THEMES)
def test_axe_finds_no_violation_with_two_tools_large(desk, theme):
    desk.evaluate(f'window.axe || (() => {{ {gzip.decompress(AXE.read_bytes()).decode()} }})();0')
    be(desk, (1280, 720, False), 'desk', dark=theme == 'dark')
    desk.evaluate("document.querySelector('.fold-drive').click()")
    show(desk, 'graph')
    press(desk, 'graph', BESIDE)
    show(desk, 'log')
    press(desk, 'log', BELOW)
    show(desk, 'health')
    assert violations(desk) == []
    assert desk.evaluate('auditPage.faults()') == []


@pytest.mark.parametrize('form', ['tall', 'wide'])
def test_a_phone_has_one_tool_at_a_time_large(page, form):
    be(page, FORMS[form], form)
    show(page, 'graph')
    high = box(page, '#panel-graph')
    page.evaluate("document.querySelector('.sheet-head [aria-pressed=false]').click()")
    page.evaluate(DRAWN)
    try:
        large, view = box(page, '#panel-graph'), box(page, '.view')
        assert large['width'] * large['height'] > 1.3 * high['width'] * high['height']
        assert view['width'] >= 148 and view['height'] >= 96
        assert page.evaluate('auditPage.faults()') == []
    finally:
        page.evaluate("document.querySelector('.sheet-head [aria-pressed=true]').click()")
