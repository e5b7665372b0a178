# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The page in a real browser: meshes of every format are drawn where the simulator has them."""

from pathlib import Path
import signal

from ament_index_python.packages import get_package_prefix
import pytest
from support.mesh_files import ascii_stl, binary_stl, box, dae, glb, gltf, obj, write
from support.running_programs import Program

from amr_description.testing.program import own_domain

BRINGUP = Path(get_package_prefix('amr_description'), 'lib', 'amr_description', 'bringup')
BOX = box((0.2, 0.4, 0.6), (0.0, 0.0, 0.1))
Y_UP_BOX = [(x, z, -y) for x, y, z in BOX]
CENTIMETRES = [tuple(100.0 * each for each in corner) for corner in BOX]
FILES = {
    'a.dae': dae(BOX, up='Z_UP'),
    'b.dae': dae(CENTIMETRES, meter=0.01, up='Y_UP'),
    'c.glb': glb(Y_UP_BOX),
    'd.gltf': gltf(Y_UP_BOX),
    'e.obj': obj(BOX),
    'f.stl': ascii_stl(BOX),
    'g.stl': binary_stl(BOX),
    'h.dae': dae(CENTIMETRES, meter=0.01, up='Z_UP'),
    'i.dae': dae(BOX, meter=1.0, up='Y_UP'),
}


def urdf():
    """Boxes in a row along x, a metre apart; their meshes lie in a folder beside the file."""
    links = '<link name="root"/>'
    for x, name in enumerate(FILES):
        links += (
            f'<link name="{name}"><visual><geometry><mesh filename="meshes/{name}"/></geometry>'
            f'</visual></link><joint name="to_{name}" type="fixed"><origin xyz="{x} 0 0"/>'
            f'<parent link="root"/><child link="{name}"/></joint>'
        )
    return f'<robot name="row">{links}</robot>'


def test_meshes_of_every_format_are_drawn_where_they_are(browser, tmp_path):
    (tmp_path / 'meshes').mkdir()
    for name, content in FILES.items():
        write(tmp_path / 'meshes' / name, content)
    path = write(tmp_path / 'row.urdf', urdf())
    with (
        own_domain(),
        Program(BRINGUP, 'display', f'urdf:={path}') as stack,
    ):
        page = browser.open(stack.expect(r'The page is at (http://\S+)')[1])
        page.wait_until(
            """performance.getEntriesByType('resource').filter(
              ({name, responseStatus}) => name.includes('/mesh/') && responseStatus === 200
            ).length === """
            + str(len(FILES))
        )
        # Each is drawn as soon as it has been read, the first one perhaps after the last one.
        extent = 'amr.now.scene.extent'
        page.wait_until(f'{extent}[0] < 0 && {extent}[3] > {len(FILES) - 1}')
        expected = [-0.1, -0.2, -0.2, len(FILES) - 0.9, 0.2, 0.4]
        found = page.evaluate(extent)
        assert found == pytest.approx(expected, abs=1e-5)
        assert page.evaluate('amr.now.notices') == 0
        assert page.errors == []
        page.close()
        assert stack.end(signal.SIGINT) == 0
