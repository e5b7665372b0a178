# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Maps in files: the values of nav2_map_server's map_io.cpp, and what is wrong in a file."""

import math
import os

from hypothesis import given, strategies as st
import numpy as np
import pytest
from support.examples import examples
import yaml

from amr_description.errors import MapDataError, MapError, MapMetadataError
from amr_description.maps.grid import OccupancyGrid
from amr_description.maps.images import pgm, png, read_image
from amr_description.maps.map_files import (
    load_map,
    load_metadata,
    MapMode,
    save_map,
    SaveParameters,
)
from amr_description.maps.pose import Pose

YAML = """\
image: map.pgm
resolution: 0.05
origin: [-1.0, -2.5, 0.5]
negate: 0
occupied_thresh: 0.65
free_thresh: 0.196
"""


@pytest.fixture
def written(tmp_path):
    """A function that writes a map of one row, and returns its .yaml file."""

    def write(row, text=YAML, alpha=None):
        gray = np.array([row], np.uint8)
        data = pgm(gray) if alpha is None else png(gray, np.array([alpha], np.uint8))
        (tmp_path / 'map.pgm').write_bytes(data)
        (tmp_path / 'map.yaml').write_text(text)
        return tmp_path / 'map.yaml'

    return write


def row_of(path):
    return load_map(path).cells[0].tolist()


def test_the_three_grays_of_map_saver(written):
    grid = load_map(written([0, 205, 254]))
    assert grid.cells.tolist() == [[100, -1, 0]]
    assert grid.resolution == 0.05
    assert grid.origin == Pose(-1.0, -2.5, 0.5)


def test_thresholds_are_strict_and_the_occupied_one_wins(written):
    # occ of 51 and of 204 are 0.8 and 0.2, to the bit of a double.
    text = YAML.replace('0.65', repr(1.0 - 51 / 255)).replace('0.196', repr(1.0 - 204 / 255))
    assert row_of(written([50, 51, 52, 203, 204, 205], text)) == [100, -1, -1, -1, -1, 0]
    crossed = YAML.replace('0.65', '0.3').replace('0.196', '0.9')
    assert row_of(written([0, 100, 255], crossed)) == [100, 100, 0]


@pytest.mark.parametrize('word', ['1', 'true', 'Yes', '-3'])
def test_negated_white_is_occupied(written, word):
    assert row_of(written([0, 255], YAML.replace('negate: 0', f'negate: {word}'))) == [0, 100]


def test_alpha_counts_as_a_color_in_trinary_mode(written):
    # (0 + 0 + 0 + 255) / 4 / 255: occ 0.75; of wholly transparent white 0.25.
    assert row_of(written([0, 255, 255], alpha=[255, 255, 0])) == [100, 0, -1]


def test_scale_mode_is_linear_between_the_thresholds(written):
    text = YAML + 'mode: scale\n'
    low, high = 0.196, 0.65
    row = [0, 88, 90, 128, 160, 205, 206, 254]
    occ = [1 - each / 255 for each in row]
    assert row_of(written(row, text)) == [
        100 if each > high else 0 if each < low else round((each - low) / (high - low) * 100)
        for each in occ
    ]
    assert row_of(written([0, 128, 255], text, alpha=[254, 255, 0])) == [-1, 67, -1]


def test_raw_mode_takes_values_as_they_are(written):
    text = YAML.replace('negate: 0', 'negate: 1') + 'mode: raw\n'
    assert row_of(written([0, 7, 100, 101, 255], text)) == [0, 7, 100, -1, -1]


def test_the_first_row_of_an_image_is_the_highest(tmp_path):
    (tmp_path / 'map.pgm').write_bytes(pgm(np.array([[0], [254], [205]], np.uint8)))
    (tmp_path / 'map.yaml').write_text(YAML)
    assert load_map(tmp_path / 'map.yaml').cells.tolist() == [[-1], [0], [100]]


def test_images_are_relative_to_the_yaml_file_or_absolute(written, tmp_path, monkeypatch):
    path = written([0])
    monkeypatch.chdir('/')
    assert row_of(path) == [100]
    absolute = written([0], YAML.replace('map.pgm', str(tmp_path / 'map.pgm')))
    assert row_of(absolute.rename(tmp_path.parent / 'elsewhere.yaml')) == [100]


def test_the_home_folder(written, tmp_path, monkeypatch):
    written([0])
    monkeypatch.setenv('HOME', str(tmp_path))
    assert row_of('~/map.yaml') == [100]


def test_numbers_as_yaml_cpp_reads_them(written):
    text = YAML.replace('0.05', '5e-2').replace('[-1.0, -2.5, 0.5]', '[1E1, .5, "-1"]')
    found = load_metadata(written([0], text))
    assert found.resolution == 0.05
    assert found.origin == Pose(10.0, 0.5, -1.0)


@pytest.mark.parametrize(
    ('change', 'words'),
    [
        (('image: map.pgm\n', ''), "'image' has to name"),
        (('map.pgm', "''"), "'image' has to name"),
        (('resolution: 0.05\n', ''), "'resolution' is missing"),
        (('0.05', '0'), "'resolution' is 0 m; it must be above 0"),
        (('0.05', 'five'), "'resolution' is 'five'; it must be a number"),
        (('0.05', '.nan'), "'resolution' is '.nan'"),
        (('[-1.0, -2.5, 0.5]', '[0, 0]'), r"'origin' is \['0', '0'\]; it must be \[x, y, yaw\]"),
        (('-2.5', 'x'), "'origin' is 'x'"),
        (('negate: 0', 'negate: perhaps'), "'negate' is 'perhaps'; it must be 0 or 1"),
        (('negate: 0\n', ''), "'negate' is None"),
        (('negate: 0', 'mode: [raw]\nnegate: 0'), r"'mode' is \['raw'\]; it must be"),
        (('negate: 0', 'mode: scales\nnegate: 0'), "'mode' is 'scales'; it must be trinary, "),
        (('0.196', '0.7\nmode: scale'), "'free_thresh' is 0.7 and 'occupied_thresh' 0.65"),
        ((YAML, 'word'), 'it is not the .yaml file of a map, which has image'),
        (('0.5]', '0.5'), 'map.yaml:4: '),
    ],
)
def test_what_is_wrong_in_a_yaml_file_is_said_in_a_line(written, change, words):
    path = written([0], YAML.replace(*change))
    with pytest.raises(MapMetadataError, match=words) as error:
        load_map(path)
    assert str(error.value).startswith(str(path))
    assert '\n' not in str(error.value)


def test_what_is_not_there_is_named(written, tmp_path):
    with pytest.raises(MapError, match=r'hall.yaml: there is no such file') as error:
        load_map(tmp_path / 'hall.yaml')
    assert type(error.value) is MapError
    path = written([0])
    (tmp_path / 'map.pgm').unlink()
    with pytest.raises(MapDataError, match=r"map.pgm: it cannot be read: .*'image' in .*map.yaml"):
        load_map(path)
    (tmp_path / 'map.pgm').write_bytes(b'BM')
    with pytest.raises(MapDataError, match=r'map.pgm: it is a BMP file'):
        load_map(path)
    with pytest.raises(MapMetadataError, match='it is not text'):
        (tmp_path / 'map.yaml').write_bytes(b'\xff\xfe')
        load_map(path)
    with pytest.raises(MapMetadataError, match='directory'):
        load_map(tmp_path)


def grid_of(cells, origin=(0.0, 0.0, 0.0), resolution=0.05):
    return OccupancyGrid(np.array(cells, np.int8), resolution, Pose(*origin))


def test_what_map_saver_writes(tmp_path):
    grid = grid_of([[-1, 0, 25], [26, 64, 65], [100, 100, 0]], (-12.345, 3.0, 0.25))
    image, metadata = save_map(grid, tmp_path / 'hall')
    assert (image, metadata) == (tmp_path / 'hall.pgm', tmp_path / 'hall.yaml')
    assert image.read_bytes() == b'P5\n3 3\n255\n' + bytes([0, 0, 254, 205, 205, 0, 205, 254, 254])
    assert metadata.read_text() == (
        'image: hall.pgm\nmode: trinary\nresolution: 0.05\norigin: [-12.345, 3, 0.25]\n'
        'negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n'
    )


def test_a_resolution_that_was_in_a_message_is_written_as_it_was_meant(tmp_path):
    _, metadata = save_map(grid_of([[0]], resolution=float(np.float32(0.05))), tmp_path / 'a')
    assert 'resolution: 0.05\n' in metadata.read_text()


def test_names_that_yaml_would_misread_are_quoted(tmp_path):
    for name in ('true', '#1', "it's: a map", 'x' * 90 + ' y' * 30):
        save_map(grid_of([[100]]), tmp_path / name)
        assert load_map(tmp_path / f'{name}.yaml').cells.tolist() == [[100]]


@examples(30)
@given(
    cells=st.lists(st.integers(-1, 100), min_size=6, max_size=6),
    mode=st.sampled_from(list(MapMode)),
    image_format=st.sampled_from(['pgm', 'png']),
)
def test_a_saved_map_is_read_again(tmp_path_factory, cells, mode, image_format):
    folder = tmp_path_factory.mktemp('maps')
    grid = grid_of(np.reshape(cells, (2, 3)), (0.1, -0.2, 0.3))
    save_map(grid, folder / 'm', SaveParameters(mode, image_format))
    found = load_map(folder / 'm.yaml')
    assert (found.resolution, found.origin) == (grid.resolution, grid.origin)
    if mode is MapMode.RAW:
        assert (found.cells == grid.cells).all()
        return
    # A PGM has no transparency: there scale mode loses what is unknown, as map_saver warns.
    known = (grid.cells >= 0) | (mode is MapMode.TRINARY) | (image_format == 'png')
    expected = np.select([grid.cells < 0, grid.cells >= 65, grid.cells <= 25], [-1, 100, 0], 50)
    if mode is MapMode.TRINARY:
        expected[expected == 50] = -1
        assert (found.cells == expected).all()
    else:
        decided = (
            known & (expected != 50) & (abs(grid.cells - 65) > 1) & (abs(grid.cells - 25) > 1)
        )
        assert (found.cells == expected)[decided].all()


@pytest.mark.parametrize(
    ('parameters', 'words'),
    [
        (SaveParameters(free_thresh=0.7), '0 <= free < occupied <= 1'),
        (SaveParameters(occupied_thresh=1.5), '0 <= free < occupied <= 1'),
        (SaveParameters(free_thresh=math.nan), 'free nan'),
        (SaveParameters(image_format='bmp'), "format 'bmp' is not written; pgm and png are"),
    ],
)
def test_a_map_is_not_saved_with_what_cannot_be(tmp_path, parameters, words):
    with pytest.raises(MapError, match=words):
        save_map(grid_of([[0]]), tmp_path / 'm', parameters)
    assert not [*tmp_path.iterdir()]


def test_a_folder_that_is_not_there_is_said(tmp_path):
    with pytest.raises(MapError, match=r'none/m.pgm: it cannot be written: No such file'):
        save_map(grid_of([[0]]), tmp_path / 'none' / 'm')


def test_scale_mode_has_transparency_in_a_png(tmp_path):
    image, metadata = save_map(
        grid_of([[-1, 0, 50]]), tmp_path / 'm', SaveParameters(MapMode.SCALE, 'png')
    )
    found = read_image(image.read_bytes())
    assert found.alpha.tolist() == [[0, 1, 1]]
    assert (found.brightness[0, 1:] * 255).tolist() == [255, 128]
    assert yaml.safe_load(metadata.read_text())['free_thresh'] == 0.25


def mutated(random, data):
    """The same bytes but for some that are others, gone, or there twice."""
    found = bytearray(data)
    for _ in range(random.integers(1, 6)):
        at = int(random.integers(0, len(found)))
        match random.integers(3):
            case 0:
                found[at] = int(random.integers(0, 256))
            case 1:
                del found[at : at + int(random.integers(1, 9))]
            case 2:
                found[at:at] = found[at : at + int(random.integers(1, 9))]
        if not found:
            break
    return bytes(found)


@examples(150)
@given(seed=st.integers(0, 2**32 - 1))
def test_broken_files_are_read_or_refused_in_a_line(tmp_path_factory, seed):
    random = np.random.default_rng(seed)
    folder = tmp_path_factory.mktemp('broken')
    gray = random.integers(0, 256, (3, 5), np.uint8)
    images = [pgm(gray), b'P2 5 3 255 ' + b' '.join(b'%d' % each for each in gray.ravel())]
    images += [png(gray), png(gray, gray)]
    image, text = images[random.integers(4)], YAML.encode()
    if random.integers(2):
        image = mutated(random, image)
    else:
        text = mutated(random, text)
    (folder / 'map.pgm').write_bytes(image)
    (folder / 'map.yaml').write_bytes(text)
    try:
        grid = load_map(folder / 'map.yaml')
    except MapError as error:
        assert '\n' not in str(error)
        assert str(folder) in str(error)
    else:
        assert set(np.unique(grid.cells).tolist()) <= {-1, 0, 100}


@pytest.mark.parametrize('name', ['map.yaml', 'map.pgm'])
def test_a_pipe_or_a_device_holds_nobody_up(tmp_path, name):
    (tmp_path / 'map.yaml').write_text(YAML)
    (tmp_path / name).unlink(missing_ok=True)
    os.mkfifo(tmp_path / name)
    with pytest.raises(MapError, match=f'{name}: it cannot be read: it is no regular file'):
        load_map(tmp_path / 'map.yaml')


def test_an_image_whose_name_no_file_can_have_is_said(tmp_path):
    (tmp_path / 'map.yaml').write_text(YAML.replace('map.pgm', '"\\uD800.pgm"'))
    with pytest.raises(MapError, match='it cannot be read: it is no name of a file|surrogate'):
        load_map(tmp_path / 'map.yaml')
