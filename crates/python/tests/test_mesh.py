"""Meshes in and out."""

from __future__ import annotations

import json
import pickle
import struct
from pathlib import Path

import numpy as np
import palpate
import pytest
from conftest import Command

CUBE = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float) * 0.02
SIDES = [
    [0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
    [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3],
]  # fmt: skip


def test_a_cube_has_the_volume_and_area_of_one() -> None:
    """Judge: closed forms. Tolerance: rounding."""
    cube = palpate.Mesh(CUBE, SIDES)
    assert cube.volume == pytest.approx(8e-6, rel=1e-12)
    assert cube.area == pytest.approx(2.4e-3, rel=1e-12)
    assert np.allclose(cube.extent, 0.02, rtol=1e-12)
    diagonal = (CUBE - 0.01) / np.linalg.norm(CUBE - 0.01, axis=1, keepdims=True)
    assert np.allclose(cube.normals, diagonal, atol=1e-12)
    assert cube.is_closed and cube.problems == [] and len(cube) == 12


def test_distances_have_a_sign() -> None:
    """Judge: a cube's own distances."""
    cube = palpate.Mesh(CUBE, SIDES)
    distances = cube.signed_distances([[0.01, 0.01, 0.01], [0.01, 0.01, 0.025], [0.01, 0.001, 0.01]])
    assert distances == pytest.approx([-0.01, 0.005, -0.001], abs=1e-15)


def test_arrays_come_back_as_they_were_given() -> None:
    cube = palpate.Mesh(CUBE, SIDES)
    assert np.array_equal(cube.vertices, CUBE) and cube.vertices.dtype == np.float64
    assert np.array_equal(cube.triangles, SIDES) and cube.triangles.dtype == np.uint32
    cube.vertices[:] = 0.0
    assert np.array_equal(cube.vertices, CUBE), "what is given out is a copy"
    assert pickle.loads(pickle.dumps(cube)) == cube
    assert palpate.Mesh(CUBE[:, ::-1][:, ::-1].astype(np.float64, order="F"), np.array(SIDES, dtype=np.int16)) == cube


def test_an_open_mesh_is_told() -> None:
    opened = palpate.Mesh(CUBE, SIDES[1:])
    assert not opened.is_closed
    assert opened.problems[0]["kind"] == "not_closed" and opened.problems[0]["count"] == 3
    with pytest.raises(palpate.InputError, match="the surface is not closed: 3 edges"):
        _ = opened.normals


@pytest.mark.parametrize(
    ("vertices", "triangles", "said"),
    [
        (CUBE[:, :2], SIDES, r"`vertices` has the shape \(8, 2\)"),
        (CUBE, [[0, 1]], r"`triangles` has the shape \(1, 2\)"),
        (CUBE, np.array(SIDES, dtype=float), "`triangles` holds numbers of the type float64"),
        (CUBE, [[0, 1, -1]], "numbers nothing"),
        (CUBE, [[0, 1, 8]], "triangle 0 names vertex 8, but there are 8"),
        (CUBE * np.nan, SIDES, "vertex 0 has a coordinate that is not a finite number"),
        (CUBE, np.empty((0, 3), dtype=int), "the mesh has no triangles"),
        ("no", SIDES, "`vertices` is no array of numbers"),
    ],
)
def test_bad_arrays_are_told(vertices: object, triangles: object, said: str) -> None:
    with pytest.raises(palpate.InputError, match=said):
        palpate.Mesh(vertices, triangles)  # type: ignore[arg-type]


def test_builtin_organs_are_those_of_the_command(command: Command) -> None:
    kidney = palpate.Mesh.builtin("kidney", 2000)
    told = json.loads(command("mesh", "info", "--builtin", "kidney", "--triangles", "2000", "--json").stdout)
    assert (told["volume_m3"], told["area_m2"]) == (kidney.volume, kidney.area)
    assert told["extent_m"] == kidney.extent.tolist() and told["problems"] == kidney.problems


def test_errors_are_those_of_the_command(command: Command, tmp_path: Path) -> None:
    absent = tmp_path / "absent.stl"
    damaged = tmp_path / "damaged.stl"
    damaged.write_bytes(bytes(80) + struct.pack("<I", 7))
    for path in (absent, damaged):
        with pytest.raises(palpate.InputError) as raised:
            palpate.Mesh.read(path, unit="mm")
        said = command("mesh", "info", path, "--unit", "mm")
        assert said.returncode == 2 and str(raised.value) in said.stderr
    with pytest.raises(palpate.InputError) as raised:
        palpate.Mesh.builtin("livr")
    assert str(raised.value) in command("mesh", "info", "--builtin", "livr").stderr


@pytest.mark.parametrize("extension", ["ply", "obj"])
def test_files_keep_a_mesh(extension: str, tmp_path: Path) -> None:
    liver = palpate.Mesh.builtin("liver", 1000)
    liver.write(tmp_path / f"liver.{extension}")
    assert palpate.Mesh.read(tmp_path / f"liver.{extension}", unit="m") == liver


def test_a_file_that_cannot_be_written_is_told(tmp_path: Path) -> None:
    liver = palpate.Mesh.builtin("liver", 1000)
    with pytest.raises(palpate.InputError, match="xyz"):
        liver.write(tmp_path / "liver.xyz")
    with pytest.raises(palpate.InputError, match="cannot be written"):
        liver.write(tmp_path / "nowhere" / "liver.ply")


def test_a_file_is_replaced_when_that_is_asked_for(tmp_path: Path) -> None:
    """Judge: the bytes before."""
    file = tmp_path / "own"
    documents: list[tuple[palpate.Mesh | palpate.Tissue | palpate.Recording | palpate.Motion, str]] = [
        (palpate.Mesh.builtin("liver", 1000), ".ply"),
        (palpate.Tissue.builtin("pig-liver"), ".toml"),
        (palpate.Recording([0.0, 1.0], [0.0, 1e-3], [0.0, 1e-2]), ".csv"),
        (palpate.Motion({"right": ([0.0, 1.0], [[0.0, 0.0, 0.1], [0.0, 0.0, 0.2]])}), ".motion.csv"),
    ]
    for document, ending in documents:
        path = file.with_suffix(ending)
        path.write_text("old")
        with pytest.raises(palpate.InputError, match="is there already"):
            document.write(path)
        assert path.read_text() == "old"
        document.write(path, overwrite=True)
        assert path.read_bytes() != b"old"
    assert len(list(tmp_path.iterdir())) == len(documents)


def test_simplifying_keeps_the_volume() -> None:
    """Judge: the original. Tolerance: the command's own test asks for less than one part in a hundred."""
    liver = palpate.Mesh.builtin("liver", 4000)
    small = liver.simplify(1000)
    assert len(small) <= 1000 and small.volume == pytest.approx(liver.volume, rel=1e-2)
    with pytest.raises(palpate.InputError, match="bound no solid; ask for 4 or more"):
        liver.simplify(2)


def label_map(path: Path) -> None:
    """Two balls of voxels of 2 mm as a NRRD file, the first named."""
    size = 24
    at = np.indices((size, size, size)) - 0.5 * (size - 1)
    labels = np.zeros((size, size, size), dtype=np.uint8)
    labels[np.linalg.norm(at, axis=0) < 9] = 7
    labels[np.linalg.norm(at, axis=0) < 4] = 9
    header = (
        "NRRD0005\ntype: uint8\ndimension: 3\nspace: left-posterior-superior\n"
        f"sizes: {size} {size} {size}\nspace directions: (2,0,0) (0,2,0) (0,0,2)\n"
        "space origin: (0,0,0)\nencoding: raw\nSegment0_LabelValue:=7\nSegment0_Name:=liver\n\n"
    )
    path.write_bytes(header.encode() + labels.tobytes())


def test_labels_become_surfaces(tmp_path: Path) -> None:
    """Judge: the volume of the ball, to the error of its voxels."""
    path = tmp_path / "labels.nrrd"
    label_map(path)
    told: list[str] = []
    organs = palpate.isosurface(path, triangles=2000, progress=lambda part, words: told.append(words))
    assert sorted(organs) == ["9", "liver"]
    assert organs["9"].volume == pytest.approx(4 / 3 * np.pi * 8e-3**3, rel=0.1)
    assert palpate.isosurface(path, ["liver"], triangles=2000)["liver"] == organs["liver"]
    with pytest.raises(palpate.InputError, match='no label "livr"; the nearest is liver'):
        palpate.isosurface(path, ["livr"])
    with pytest.raises(palpate.InputError, match="there is no such file"):
        palpate.isosurface(tmp_path / "absent.nii.gz")


def test_wrapping_closes_what_is_open_and_crossed() -> None:
    """Judges: the whole liver's volume, and what is reported of the envelope."""
    liver = palpate.Mesh.builtin("liver", 2000)
    faces = np.concatenate([liver.triangles[60:], liver.triangles[100:900]])
    torn = palpate.Mesh(liver.vertices, faces)
    assert not torn.is_closed
    heard: list[tuple[float, str]] = []
    wrapped = torn.wrap(distance=0.002, triangles=6000, progress=lambda part, words: heard.append((part, words)))
    assert wrapped.is_closed and wrapped.problems == [] and len(wrapped) <= 6000
    # The distance times the area, over the volume.
    assert wrapped.volume == pytest.approx(liver.volume, rel=0.002 * liver.area / liver.volume)
    assert heard[-1][0] == 1.0
    with pytest.raises(palpate.InputError):
        torn.wrap(distance=-1.0)
