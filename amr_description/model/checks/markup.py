# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The elements and attributes of URDF and ros2_control, and rules on markup, names and files.

Readers ignore elements and attributes that they do not know. The rules compare a description with
the grammar :data:`ROBOT` and report what is probably a mistake.
"""

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field
import re

from lxml import etree

from amr_description.errors import AmrError
from amr_description.model.checks.context import CheckContext, FileExists
from amr_description.model.findings import Finding
from amr_description.model.gazebo.sensors import has_sensors
from amr_description.model.xml_reader import line_of
from amr_description.text import closest_match, one_line, quote, quote_all

_SHARE = re.compile(r'/share/[^/]+/')
_ABSOLUTE = re.compile(r'(?:file://)?/|file:/(?!/)|~|[A-Za-z]:[\\/]')
_XACRO = ('http://www.ros.org/wiki/xacro', 'http://ros.org/wiki/xacro')
# Elements that only set values; some expanded files keep a few.
_MAKES_NOTHING = ('arg', 'property')
_EXPRESSION = re.compile(r'=\s*["\'][^"\'<]*\$[{(]')
TOUCHES_NOTHING = "the shape of the link's visual is taken, or none"
"""What the simulator makes of a collision whose mesh cannot be had."""
# Elements whose unknown children are refused where they are read.
_READ_STRICTLY = ('ros2_control', 'geometry')
# The names of links are much alike: others than these are other parts.
_MISSPELT_REFERENCE = 0.8
_ODD = re.compile(r'\A/|\s')


@dataclass(frozen=True, slots=True)
class Element:
    """
    The grammar of an element.

    ``children`` are by tag; of those in ``single`` only the first counts. An ``open`` element may
    contain anything, as other programs read it.
    """

    attributes: tuple[str, ...] = ()
    children: Mapping[str, 'Element'] = field(default_factory=dict)
    single: tuple[str, ...] = ()
    open: bool = False


_ANYTHING = Element(open=True)
_ORIGIN = Element(('xyz', 'rpy'))
_GEOMETRY = Element(
    children={
        'box': Element(('size',)),
        'cylinder': Element(('radius', 'length')),
        'sphere': Element(('radius',)),
        'mesh': Element(('filename', 'scale')),
    }
)
_MATERIAL = Element(
    ('name',),
    {'color': Element(('rgba',)), 'texture': Element(('filename',))},
    ('color', 'texture'),
)
_LINK = Element(
    ('name', 'type'),
    {
        'inertial': Element(
            children={
                'origin': _ORIGIN,
                'mass': Element(('value',)),
                'inertia': Element(('ixx', 'ixy', 'ixz', 'iyy', 'iyz', 'izz')),
            },
            single=('origin', 'mass', 'inertia'),
        ),
        'visual': Element(
            ('name',),
            {'origin': _ORIGIN, 'geometry': _GEOMETRY, 'material': _MATERIAL},
            ('origin', 'geometry', 'material'),
        ),
        'collision': Element(
            ('name',),
            # Contact parameters of Bullet and of old Gazebo stand beside them.
            {'origin': _ORIGIN, 'geometry': _GEOMETRY, 'verbose': _ANYTHING}
            | dict.fromkeys(('material', 'contact_coefficients'), _ANYTHING),
            ('origin', 'geometry'),
        ),
        'contact': _ANYTHING,
    },
    ('inertial',),
)
_JOINT = Element(
    ('name', 'type'),
    {
        'origin': _ORIGIN,
        'parent': Element(('link',)),
        'child': Element(('link',)),
        'axis': Element(('xyz',)),
        'limit': Element(
            ('lower', 'upper', 'effort', 'velocity', 'acceleration', 'deceleration', 'jerk')
        ),
        'dynamics': Element(('damping', 'friction')),
        'mimic': Element(('joint', 'multiplier', 'offset')),
        'calibration': Element(('rising', 'falling', 'reference_position')),
        'safety_controller': Element(
            ('soft_lower_limit', 'soft_upper_limit', 'k_position', 'k_velocity')
        ),
    },
)
_PARAM = Element(('name',))
_LIMITS = Element(('enable',))
_INTERFACE = Element(
    ('name', 'data_type', 'size'), {'param': _PARAM, 'limits': _LIMITS}, ('limits',)
)
_COMPONENT = Element(
    ('name', 'mimic'),
    {
        'command_interface': _INTERFACE,
        'state_interface': _INTERFACE,
        'param': _PARAM,
        'limits': _LIMITS,
    },
    ('limits',),
)
_ROS2_CONTROL = Element(
    ('name', 'type', 'rw_rate', 'is_async'),
    {
        'hardware': Element(
            children={'plugin': Element(), 'group': Element(), 'param': _PARAM},
            single=('plugin', 'group'),
        ),
        'properties': _ANYTHING,
        'joint': _COMPONENT,
        'sensor': _COMPONENT,
        'gpio': _COMPONENT,
        'transmission': _ANYTHING,
    },
    ('hardware',),
)
ROBOT = Element(
    ('name', 'version'),
    {
        'material': _MATERIAL,
        'link': _LINK,
        'joint': Element(_JOINT.attributes, _JOINT.children, tuple(_JOINT.children)),
        'ros2_control': _ROS2_CONTROL,
    }
    | dict.fromkeys(('gazebo', 'transmission', 'mujoco', 'sensor'), _ANYTHING),
)
"""``<robot>`` and all below it."""


def xacro_is_expanded(context: CheckContext) -> Iterator[Finding]:
    """No element and no expression of xacro is left."""
    left = [element for uri in _XACRO for element in context.xml.iter(f'{{{uri}}}*')]
    making = [each for each in left if etree.QName(each).localname not in _MAKES_NOTHING]
    if left and (making or _EXPRESSION.search(context.robot.text)):
        yield context.error(
            min(map(line_of, left)),
            'this is a xacro file, not yet a URDF',
            found=f'<xacro:{etree.QName((making or left)[0]).localname}>',
            fix='run  xacro FILE > robot.urdf  first, or give the file in the place of its text',
        )


def markup_is_known(context: CheckContext) -> Iterator[Finding]:
    """
    Every element and attribute is known, and is there once where only one counts.

    Those with an XML namespace, and the content of ``<gazebo>``, are not checked.
    """
    stack = [(context.xml, ROBOT)]
    while stack:
        element, grammar = stack.pop()
        yield from _check_attributes(context, element, grammar)
        seen: set[str] = set()
        children = []
        for child in element.iterchildren(etree.Element):
            tag = child.tag
            known = grammar.children.get(tag)
            if known is None:
                yield from _check_tag(context, child, grammar)
                continue
            if tag in seen and tag in grammar.single:
                yield context.warning(
                    line_of(child),
                    f'a second <{tag}> in <{element.tag}> is ignored',
                    fix='leave one',
                )
            seen.add(tag)
            if not known.open:
                children.append((child, known))
        stack.extend(reversed(children))


def one_shape_counts(context: CheckContext) -> Iterator[Finding]:
    """A geometry has one shape; all but the first are ignored."""
    for geometry in context.xml.iterfind('link/*/geometry'):
        shapes = list(geometry.iterchildren(etree.Element))
        for shape in shapes[1:]:
            yield context.warning(
                line_of(shape),
                f'a second shape, <{shape.tag}>, in one <geometry> is ignored',
                fix=f'give it a <{geometry.getparent().tag}> of its own',
            )


def names_are_usable(context: CheckContext) -> Iterator[Finding]:
    """Names have no blanks and no leading slash: tf2 refuses such frames."""
    robot = context.robot
    parts = [('link', each.name, each.line) for each in robot.links]
    parts += [('joint', each.name, each.line) for each in robot.joints]
    for kind, name, line in parts:
        if _ODD.search(name):
            yield context.warning(
                line,
                f'the {kind} has a name that ROS tools trip over',
                found=quote(name),
                expected='letters, digits and _, such as '
                + quote(re.sub(r'\W+', '_', name.strip('/ '))),
            )


def gazebo_refers_to_something(context: CheckContext) -> Iterator[Finding]:
    """The ``reference`` of a ``<gazebo>`` is a link or a joint."""
    robot = context.robot
    known = [link.name for link in robot.links] + [joint.name for joint in robot.joints]
    for element in context.xml.iterchildren('gazebo'):
        name = element.get('reference')
        if name is None or robot.has_link(name) or robot.has_joint(name):
            continue
        if has_sensors(element):
            continue  # told by the rule on sensors
        meant = closest_match(name, known, _MISSPELT_REFERENCE)
        yield context.warning(
            line_of(element),
            '<gazebo> refers to what is not there, and is ignored',
            found=quote(name),
            expected=f'a link or a joint: {quote_all(known)}',
            fix=f'write reference="{meant}"' if meant else '',
        )


def files_are_there(context: CheckContext) -> Iterator[Finding]:
    """Meshes and textures exist."""
    file_exists = context.inputs.file_exists
    if file_exists is None:
        return
    for file in _meshes_and_textures(context):
        if not file.path or _ABSOLUTE.match(file.path):
            continue
        try:
            if file_exists(file.path):
                continue
        except (AmrError, ValueError) as error:
            yield context.warning(
                file.line,
                f'{file.what} cannot be looked up',
                found=quote(file.path),
                fix=str(error),
            )
            continue
        yield context.warning(
            file.line,
            f'{file.what} is not there',
            found=quote(file.path),
            expected='package://<package>/<path>, or a path from the folder of this file',
            taken=TOUCHES_NOTHING if file.touches else '',
        )


def paths_hold_everywhere(context: CheckContext) -> Iterator[Finding]:
    """
    No path is valid on this machine only.

    Expanded ``$(find package)`` expressions of xacro are accepted: such a file exists in the share
    folder of its package.
    """
    file_exists = context.inputs.file_exists
    if file_exists is None:
        return
    for file in _named_files(context):
        if not _ABSOLUTE.match(file.path) or _is_of_a_package(file.path, file_exists):
            continue
        share = _SHARE.search(file.path)
        if share and _is_of_a_package(f'{file.path[: share.end()]}package.xml', file_exists):
            yield context.warning(
                file.line,
                f'{file.what} names a file that is not there',
                found=f'"{one_line(file.path)}"',
                fix='write the name of one that its package installs',
            )
        else:
            yield context.warning(
                file.line,
                f'{file.what} has a path of this machine only',
                found=quote(file.path),
                fix='write package://<package>/<path below its share folder>'
                if file.takes_package
                else 'let xacro find the file: $(find <package>)/config/<file>.yaml',
            )


def _check_attributes(
    context: CheckContext, element: etree._Element, grammar: Element
) -> Iterator[Finding]:
    for name in element.attrib:
        if name not in grammar.attributes and not name.startswith('{'):
            yield context.warning(
                line_of(element),
                f'<{element.tag}> has no attribute {quote(name)} in URDF: it is ignored',
                **_hint(name, grammar.attributes, '{}="…"'),
            )


def _check_tag(
    context: CheckContext, element: etree._Element, grammar: Element
) -> Iterator[Finding]:
    parent = element.getparent()
    strict = next(element.iterancestors(*_READ_STRICTLY), None) is not None
    if parent is None or strict or element.tag.startswith('{'):
        return
    yield context.warning(
        line_of(element),
        f'<{parent.tag}> has no element {quote(f"<{element.tag}>")} in URDF: it is ignored',
        **_hint(element.tag, grammar.children, '<{}>'),
    )


def _hint(name: str, known: Collection[str], form: str) -> dict[str, str]:
    """Return the expected names, and the fix if one of them is similar."""
    if not known:
        return {'expected': 'none', 'fix': 'remove it'}
    meant = closest_match(name, known)
    return {
        'expected': ', '.join(form.format(each) for each in known),
        'fix': f'write {form.format(meant)}' if meant else '',
    }


@dataclass(frozen=True, slots=True)
class _NamedFile:
    """A file that the description names; ``what`` says what it is for."""

    path: str
    what: str
    line: int
    touches: bool
    takes_package: bool = True


def _is_of_a_package(path: str, file_exists: FileExists) -> bool:
    try:
        return _SHARE.search(path) is not None and file_exists(path)
    except (AmrError, ValueError):
        return False


def _named_files(context: CheckContext) -> Iterator[_NamedFile]:
    """Yield the files that a description may name by a path of this machine."""
    yield from _meshes_and_textures(context)
    for element in context.xml.iterfind('gazebo/plugin/parameters'):
        plugin = element.getparent().get('name', '')
        yield _NamedFile(
            path=(element.text or '').strip(),
            what=f'gazebo plugin {quote(plugin)}: <parameters>',
            line=line_of(element),
            touches=False,
            takes_package=False,
        )


def _meshes_and_textures(context: CheckContext) -> Iterator[_NamedFile]:
    for element in context.xml.iter('mesh', 'texture'):
        part = next(element.iterancestors('visual', 'collision', 'link'), None)
        above = next(element.iterancestors('link', 'robot'), None)
        if above is None or (element.tag == 'mesh' and part is None):
            continue
        owner = '' if above.tag == 'robot' else f' of link {quote(above.get("name", ""))}'
        kind = f'the {element.tag}{owner}'
        touches = part is not None and part.tag == 'collision'
        path = element.get('filename', '').strip()
        yield _NamedFile(path, kind, line_of(element), touches)
