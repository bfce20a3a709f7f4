"""Globally smooth parameterizations of surfaces, and progressive codes of their remeshes.

Surfaces are two arrays: positions, float64 (n, 3), and faces, int32 (m, 3), counter-clockwise seen from outside.

    positions, faces = gsp.read("horse.ply")
    map = gsp.parameterize(positions, faces)
    stream = gsp.encode(gsp.remesh(map))
    decoded = gsp.decode(stream, bytes=4096)
    gsp.surface_distance(positions, faces, decoded.positions, decoded.faces).psnr_db

Long calls release Python's lock, run on all cores (threads=N limits one call), end at Ctrl-C, and call
progress(stage, fraction). What goes wrong is a gsp.Error with `cause`, `element` and `index`.
"""

from gsp import _gsp
from gsp._gsp import *  # noqa: F403
from gsp._gsp import __version__

__all__ = [name for name in dir(_gsp) if not name.startswith("_")] + ["__version__"]
