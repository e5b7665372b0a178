# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``ros2 pkg xml``, and ``ros2 daemon``, which does nothing."""

from fixtures.cli.commands import ros2
import pytest

MANIFEST = """\
<?xml version="1.0"?>
<!-- a comment -->
<package format="3">
  <name>toys</name>
  <depend>rclpy</depend>
  <depend>std_msgs</depend>
  <license/>
  <export>
    <build_type>ament_python</build_type>
  </export>
</package>
"""


@pytest.fixture(scope='module')
def prefix(tmp_path_factory):
    """A prefix with ``toys``, ``broken``, whose manifest is, and ``bare``, which has none."""
    folder = tmp_path_factory.mktemp('prefix')
    index = folder / 'share/ament_index/resource_index/packages'
    index.mkdir(parents=True)
    for package, text in (('toys', MANIFEST), ('broken', '<package>\n<a></b>'), ('bare', None)):
        (index / package).touch()
        (folder / 'share' / package).mkdir()
        if text:
            (folder / 'share' / package / 'package.xml').write_text(text)
    return str(folder)


@pytest.fixture
def xml(prefix):
    def run(*args):
        result = ros2('pkg', 'xml', *args, AMENT_PREFIX_PATH=prefix)
        return result.returncode, result.stdout, result.stderr

    return run


def test_the_manifest_is_printed_from_its_root_on(xml):
    code, text, said = xml('toys')
    assert (code, said) == (0, '')
    assert text == MANIFEST[MANIFEST.index('<package') :].replace('<license/>', '<license />')


@pytest.mark.parametrize(
    ('tag', 'text'),
    [
        ('name', 'toys\n'),
        ('depend', 'rclpy\nstd_msgs\n'),
        ('license', '\n'),
        ('export/build_type', 'ament_python\n'),
    ],
)
def test_each_element_of_a_tag_is_a_line(xml, tag, text):
    assert xml('toys', '-t', tag) == xml('toys', '--tag', tag) == (0, text, '')


@pytest.mark.parametrize(
    ('args', 'said'),
    [
        (('nobody',), 'Package not found'),
        (('../toys',), 'Package not found'),
        (('bare',), 'Package XML manifest not found: there is no '),
        (('toys', '-t', 'nope'), 'XML tag not found; there are depend, export, license, name'),
        (('toys', '-t', '['), 'XML tag not found'),
    ],
)
def test_what_is_not_there_is_told(xml, args, said):
    code, text, error = xml(*args)
    assert (code, text, error.count('\n')) == (1, '', 1)
    assert error.startswith(said)


def test_a_broken_manifest_is_told_with_its_place(xml):
    code, text, error = xml('broken')
    assert (code, text) == (1, '')
    assert error.endswith('broken/package.xml is not XML: mismatched tag: line 2, column 5\n')


@pytest.mark.parametrize(
    ('verb', 'said'),
    [
        ('start', 'The daemon is not needed: every answer is fresh\n'),
        ('status', 'The daemon is not running\n'),
        ('stop', 'The daemon has been stopped\n'),
    ],
)
def test_the_verbs_of_the_daemon_are_harmless(verb, said):
    result = ros2('daemon', verb)
    assert (result.returncode, result.stdout, result.stderr) == (0, said, '')
