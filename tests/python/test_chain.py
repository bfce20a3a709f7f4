"""The module gives what the program gives, to the byte."""

import os
import re
import subprocess

import gsp
import numpy as np
import pytest

PROGRAM, SOURCE = os.environ["GSP_PROGRAM"], os.environ["GSP_SOURCE"]


def command(*words):
    return subprocess.run([PROGRAM, *words, "--quiet", "--json"], check=True, capture_output=True, text=True).stdout


@pytest.fixture(scope="module", params=["sphere", "torus"])
def chain(request, tmp_path_factory):
    folder = tmp_path_factory.mktemp(request.param)
    surface = gsp.sphere(3) if request.param == "sphere" else gsp.torus(30, 16)
    gsp.write(str(folder / "in.ply"), *surface)
    command("parameterize", folder / "in.ply", "-o", folder / "c.param.ply")
    command("remesh", folder / "c.param.ply", "-o", folder / "c.sr.ply")
    command("encode", folder / "c.sr.ply", "-o", folder / "c.pgc")
    command("encode", folder / "c.sr.ply", "-o", folder / "fixed.pgc", "--mode", "fixed", "--bytes", "900")
    command("decode", folder / "c.pgc", "-o", folder / "c.ply", "--bytes", "700")
    return folder, surface


def test_whole_chain_is_that_of_the_program(chain):
    folder, surface = chain
    positions, faces = gsp.read(str(folder / "in.ply"))
    assert np.array_equal(positions, surface[0]) and np.array_equal(faces, surface[1])
    assert positions.dtype == np.float64 and faces.dtype == np.int32
    map = gsp.parameterize(positions, faces)
    map.save(str(folder / "py.param.ply"))
    assert (folder / "py.param.ply").read_bytes() == (folder / "c.param.ply").read_bytes()
    assert gsp.check(map).valid
    remesh = gsp.remesh(map)
    remesh.save(str(folder / "py.sr.ply"))
    assert (folder / "py.sr.ply").read_bytes() == (folder / "c.sr.ply").read_bytes()
    stream = gsp.encode(remesh)
    assert stream == (folder / "c.pgc").read_bytes()
    assert gsp.encode(remesh, mode="fixed", bytes=900) == (folder / "fixed.pgc").read_bytes()
    assert gsp.encode(remesh, bytes=700) == stream[:700]
    prefix = gsp.decode(stream, bytes=700)
    prefix.save(str(folder / "py.ply"))
    assert (folder / "py.ply").read_bytes() == (folder / "c.ply").read_bytes()
    assert gsp.header_bytes(stream) < 700


def test_surfaces_that_are_no_manifolds_are_read_cut_apart(tmp_path):
    positions = np.vstack([np.eye(3), -np.eye(3)])
    gsp.write(str(tmp_path / "book.off"), positions, [[0, 1, 2], [0, 1, 3], [1, 0, 4]])
    path, notes = str(tmp_path / "book.off"), []
    assert not gsp.topology(*gsp.read(path)).usable
    cut, faces = gsp.read(path, repair="cut", on_note=notes.append)
    assert len(cut) == 6 + 4 and gsp.topology(cut, faces).usable
    assert any("1 edges and 2 vertices" in note for note in notes)
    with pytest.raises(gsp.Error):
        gsp.read(path, repair="glue")


def test_measures_are_those_of_the_program(chain):
    import json

    folder, surface = chain
    decoded = gsp.read_remesh(str(folder / "c.ply"))
    told = json.loads(command("distance", folder / "in.ply", folder / "c.ply", "--samples", "20000", "--seed", "3",
                              "--hausdorff-tolerance", "0.05"))
    mine = gsp.surface_distance(*surface, decoded.positions, decoded.faces, samples=20000, seed=3)
    assert mine.rms == told["rms"] and mine.psnr_db == pytest.approx(told["psnr_db"], abs=1e-9)
    bounds = gsp.hausdorff_bounds(*surface, decoded.positions, decoded.faces, tolerance=0.05)
    assert bounds.both.lower <= bounds.both.upper <= 1.05 * bounds.both.lower
    assert mine.hausdorff <= bounds.both.upper
    map = gsp.read_map(str(folder / "c.param.ply"))
    assert map.omega is None and map.summary == {}
    told = json.loads(command("distortion", folder / "c.param.ply"))
    values = gsp.distortion(map)
    assert values.flipped_faces == 0 and values.anisotropy.mean == pytest.approx(told["anisotropy"]["mean"])
    per_face = gsp.face_distortion(map)["anisotropy"]
    assert len(per_face) == len(map.faces) and per_face.max() == values.anisotropy.maximum
    assert len(gsp.smoothness(map).faces) == len(map.faces)


def test_arrays_of_a_map_are_what_they_say(chain):
    map = gsp.parameterize(*chain[1], base_vertices="auto-omega", method="maps")
    n, m = len(map.positions), len(map.faces)
    assert map.patch.shape == map.position.shape == (n,) and map.face_corners.shape == (m, 3)
    # Charts are equilateral triangles of side 1: the areas of the faces in them cover each once.
    a, b, c = map.face_corners.T
    area = 0.5 * ((b - a).conj() * (c - a)).imag
    assert area.sum() == pytest.approx(len(map.base_faces) * np.sqrt(3) / 4)
    assert map.omega.shape[1] == 5 and np.allclose(map.omega[:, 1:4].sum(axis=1), map.omega[:, 4])
    assert any(line.startswith("method maps") for line in map.provenance)


def test_shape_and_cause_of_what_cannot_be_used():
    report = gsp.topology(*gsp.torus(6, 5))
    assert (report.components[0].genus, report.boundary_loops, report.usable, report.refusal) == (1, 0, True, None)
    positions, faces = gsp.torus(6, 5)
    report = gsp.topology(positions, np.vstack([faces, [[0, 1, 1]]]))
    assert report.repeated_index_faces == [60] and not report.usable and "60" in report.refusal


def test_bd_rate_of_half_the_bytes():
    rate, psnr = np.array([1000, 2000, 4000, 8000]), np.array([50.0, 55, 60, 65])
    result = gsp.bd_rate(rate, psnr, rate / 2, psnr)
    assert result.rate.value == pytest.approx(-50.0) and result.rate.overlap_share == pytest.approx(1.0)
    with pytest.raises(gsp.Error):
        gsp.bd_rate(rate, psnr, rate, psnr + 100)
    with pytest.raises(ValueError):
        gsp.bd_rate(rate, psnr[:3], rate, psnr)


def test_a_sweep_reads_into_columns(tmp_path):
    recipe = tmp_path / "r.toml"
    recipe.write_text('models = ["shape:torus"]\nmethod = ["gsp", "maps"]\nbase_vertices = "auto-omega"\n'
                      "samples = 2000\nbudgets = [400, 800]\n")
    command("sweep", recipe, "--store", tmp_path / "s")
    points = gsp.read_store(str(tmp_path / "s"))
    assert points["method"] == ["gsp"] * 3 + ["maps"] * 3  # two budgets and the whole stream
    assert list(points["bytes"][[0, 1, 3, 4]]) == [400, 800] * 2
    assert np.all(points["psnr_db"] > 20) and len(points["label"]) == 6
    cells = gsp.read_store(str(tmp_path / "s"), what="cells")
    assert cells["status"] == ["done", "done"] and np.all(cells["stream_bytes"] > 800)
    from_csv = gsp.read_curve(str(tmp_path / "s" / "curve.csv"))
    assert np.array_equal(from_csv["psnr_db"], points["psnr_db"])
    with pytest.raises(gsp.Error):
        gsp.read_store(str(tmp_path))


def test_the_readme_example():
    text = open(os.path.join(SOURCE, "README.md"), encoding="utf-8").read()
    block = re.search(r"^    import gsp\n(?:    .*\n|\n)+", text, re.M).group(0)
    scope = {}
    exec(re.sub(r"^    ", "", block, flags=re.M), scope)
    assert scope["distance"].psnr_db > 30
