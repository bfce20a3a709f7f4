"""What the module does to the process around it: threads, locks, interrupts."""

import os
import signal
import subprocess
import sys
import threading
import time

import gsp
import numpy as np
import pytest


def stream_of(surface, **options):
    map = gsp.parameterize(*surface, base_vertices="auto-omega", **options)
    return gsp.encode(gsp.remesh(map))


def test_two_threads_at_once_give_the_same_bytes():
    surfaces = [gsp.torus(30, 20), gsp.sphere(3)]
    alone = [stream_of(s) for s in surfaces]
    together = [None] * 4

    def work(i):
        together[i] = stream_of(surfaces[i % 2])

    threads = [threading.Thread(target=work, args=(i,), daemon=True) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert together == alone * 2


def test_number_of_threads_is_of_the_call():
    surface = gsp.torus(30, 20)
    assert stream_of(surface, threads=1) == stream_of(surface, threads=3) == stream_of(surface)


def test_lock_is_released():
    """Another thread of Python goes on while a call works."""
    ticks, stop = [], threading.Event()

    def tick():
        while not stop.is_set():
            ticks.append(time.perf_counter())
            time.sleep(0.001)

    surface = gsp.sphere(5)
    thread = threading.Thread(target=tick, daemon=True)
    thread.start()
    begin = time.perf_counter()
    gsp.surface_distance(*surface, *gsp.sphere(4), samples=2000000)
    end = time.perf_counter()
    stop.set()
    thread.join()
    during = sum(begin < t < end for t in ticks)
    assert end - begin < 0.05 or during > 5


def product_time():
    a = np.random.default_rng(1).random((500, 500))
    times = []
    for _ in range(15):
        begin = time.process_time(), time.perf_counter()
        a @ a
        times.append((time.process_time() - begin[0], time.perf_counter() - begin[1]))
    return np.min(times, axis=0)


def blas_threads():
    """The setting of OpenBLAS, where NumPy's is that."""
    import ctypes

    try:
        return ctypes.CDLL("libopenblas.so.0", mode=os.RTLD_NOLOAD | os.RTLD_NOW).openblas_get_num_threads()
    except (OSError, AttributeError):
        return None


def test_a_product_of_numpy_takes_the_same_time_before_and_after():
    product_time()
    before, threads = product_time(), blas_threads()
    stream_of(gsp.torus(30, 20))
    after = product_time()
    assert blas_threads() in (threads, None) or threads is None
    # Times of a busy machine; a BLAS left on one thread or on too many is a factor of two and more on idle ones.
    assert np.all(after < 1.9 * before + 0.002)


def test_progress_is_told_and_its_exception_ends_the_call():
    told, notes = [], []
    gsp.parameterize(*gsp.sphere(3), progress=lambda stage, share: told.append((stage, share)), on_note=notes.append)
    assert len(told) > 3 and all(isinstance(s, str) and 0.0 <= x <= 1.0 for s, x in told) and notes

    class Enough(Exception):
        pass

    def stop(stage, share):
        raise Enough(stage)

    with pytest.raises(Enough):
        gsp.parameterize(*gsp.sphere(3), progress=stop)
    with pytest.raises(TypeError):
        gsp.parameterize(*gsp.sphere(3), progress=3)


def test_ctrl_c_ends_a_long_call():
    code = ("import gsp, sys\nsurface = gsp.sphere(6)\nprint('ready', flush=True)\n"
            "try:\n    gsp.parameterize(*surface)\nexcept KeyboardInterrupt:\n    sys.exit(42)\n")
    child = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE)
    assert child.stdout.readline() == b"ready\n"
    time.sleep(0.5)
    child.send_signal(signal.SIGINT)
    try:
        assert child.wait(timeout=60) == 42
    finally:
        child.kill()
        child.stdout.close()
