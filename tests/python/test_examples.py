"""The example scripts run on generated surfaces and write what they say."""

import os
import subprocess
import sys

import gsp
import pytest

EXAMPLES = os.path.join(os.environ["GSP_SOURCE"], "python", "examples")


def run(name, *words):
    pytest.importorskip("matplotlib")
    return subprocess.run([sys.executable, os.path.join(EXAMPLES, name), *map(str, words)], check=True,
                          capture_output=True, text=True).stdout


def test_curve(tmp_path):
    gsp.write(str(tmp_path / "torus.ply"), *gsp.torus(16, 10))
    out = run("curve.py", tmp_path / "torus.ply", tmp_path / "curve.png", "--samples", 2000)
    assert "BD-rate" in out and (tmp_path / "curve.png").stat().st_size > 5000


def test_distortion_histogram(tmp_path):
    gsp.write(str(tmp_path / "torus.ply"), *gsp.torus(16, 10))
    out = run("distortion_histogram.py", tmp_path / "torus.ply", tmp_path / "h.png")
    assert "anisotropy" in out and (tmp_path / "h.png").stat().st_size > 5000


def test_sweep(tmp_path):
    recipe = tmp_path / "r.toml"
    recipe.write_text('models = ["shape:torus"]\nmethod = ["gsp"]\nbase_vertices = "auto-omega"\nsamples = 2000\n'
                      'wavelet = ["loop", "butterfly-lifted"]\n')
    subprocess.run([os.environ["GSP_PROGRAM"], "sweep", recipe, "--store", tmp_path / "s", "--quiet"], check=True)
    out = run("compare_sweep.py", tmp_path / "s", tmp_path / "sweep.png")
    assert out.count("%") >= 1 and (tmp_path / "sweep.png").stat().st_size > 5000
