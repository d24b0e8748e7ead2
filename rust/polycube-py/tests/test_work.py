"""Long calls: progress, cancellation, Ctrl-C, threads, jobs, panics."""

import gc
import os
import pickle
import signal
import threading
import time
import traceback

import numpy as np
import pytest

import polycube


def test_progress_is_told_on_this_thread_and_never_goes_back(pair):
    seen = []
    polycube.simplify(pair[1], pair[0], progress=lambda *now: seen.append((threading.get_ident(), *now)))
    assert {ident for ident, _, _ in seen} == {threading.get_ident()}
    assert seen[-1][2] == 1.0
    fractions = [fraction for _, _, fraction in seen]
    assert fractions == sorted(fractions) and fractions[0] >= 0
    assert all(isinstance(stage, str) for _, stage, _ in seen)


def test_what_a_progress_callback_raises_ends_the_call(slow):
    mesh, options = slow

    def progress(stage, fraction):
        raise ZeroDivisionError("stop")

    with pytest.raises(ZeroDivisionError, match="stop"):
        polycube.simplify(mesh, progress=progress, **options)


@pytest.mark.parametrize("call", [polycube.simplify, lambda m, **o: polycube.remesh(m, m, **o)])
def test_an_event_cancels(slow, call):
    mesh, options = slow
    cancel = threading.Event()
    timer = threading.Timer(0.3, cancel.set)
    timer.start()
    with pytest.raises(polycube.Cancelled) as caught:
        call(mesh, cancel=cancel, **options)
    assert caught.value.kind == "cancelled"
    assert not isinstance(caught.value, ValueError)


def test_cancel_without_is_set(cube):
    with pytest.raises(AttributeError):
        polycube.simplify(cube, cancel=object())


def test_ctrl_c_interrupts(slow):
    mesh, options = slow
    timer = threading.Timer(0.3, os.kill, [os.getpid(), signal.SIGINT])
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        polycube.simplify(mesh, **options)


def test_ctrl_c_interrupts_waiting_for_a_job(slow):
    mesh, options = slow
    job = polycube.Job.simplify(mesh, **options)
    timer = threading.Timer(0.3, os.kill, [os.getpid(), signal.SIGINT])
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        job.result()
    assert not job.done
    job.cancel()
    with pytest.raises(polycube.Cancelled):
        job.result()


def test_other_threads_run_meanwhile(slow):
    """A thread that counts goes on while a call works, which it would not if the call held the interpreter."""
    mesh, options = slow
    cancel, counted = threading.Event(), 0

    def count():
        nonlocal counted
        while counted < 100_000:
            counted += 1
        cancel.set()

    threading.Thread(target=count).start()
    with pytest.raises(polycube.Cancelled):
        polycube.simplify(mesh, cancel=cancel, **options)
    assert counted == 100_000


def test_threads_get_the_same_results(pair):
    results = {}

    def work(i):
        results[i] = polycube.simplify(pair[1], pair[0]).polycube.points

    threads = [threading.Thread(target=work, args=[i]) for i in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(np.array_equal(points, results[0]) for points in results.values())


def test_a_job_gives_what_the_call_gives(surfaces):
    shape, mesh = surfaces
    job = polycube.Job.simplify(mesh, shape)
    assert job.wait(600)
    assert job.done and job.progress[1] == 1.0 and "done" in repr(job)
    assert np.array_equal(job.result().polycube.points, polycube.simplify(mesh, shape).polycube.points)
    assert np.shares_memory(job.result().levels, job.result().levels)
    remesh = polycube.Job.remesh(shape, mesh, surface_only=True, scale=0.3)
    own = polycube.remesh(shape, mesh, surface_only=True, scale=0.3)
    assert np.array_equal(remesh.result().quads.points, own.quads.points)


def test_a_job_is_cancelled(slow):
    mesh, options = slow
    job = polycube.Job.simplify(mesh, **options)
    assert not job.wait(0.05) and not job.done
    stage, fraction = job.progress
    assert isinstance(stage, str) and 0 <= fraction < 1
    job.cancel()
    assert job.wait(60)
    for _ in range(2):
        with pytest.raises(polycube.Cancelled):
            job.result()


def test_a_job_that_nobody_holds_stops(slow):
    mesh, options = slow

    def workers():
        return sum(name == "polycube" for name in map(thread_name, os.listdir("/proc/self/task")))

    def thread_name(task):
        try:
            with open(f"/proc/self/task/{task}/comm") as file:
                return file.read().strip()
        except OSError:
            return ""

    if not os.path.isdir("/proc/self/task"):
        pytest.skip("there is no /proc here")
    before = workers()
    job = polycube.Job.simplify(mesh, **options)
    while workers() == before:  # the thread takes its name when it starts to run
        time.sleep(0.01)
    del job
    gc.collect()
    while workers() > before:  # ends, or the test hangs
        time.sleep(0.01)


def test_mistakes_are_raised_when_a_job_starts(cube, pair):
    with pytest.raises(polycube.InvalidOption):
        polycube.Job.simplify(cube, scale=-1)
    with pytest.raises(TypeError):
        polycube.Job.remesh(cube, cube, hexes="many")
    job = polycube.Job.simplify(pair[1], cube)
    with pytest.raises(polycube.Mismatch):
        job.result()


@pytest.mark.parametrize("timeout", [-1, 0, float("nan"), float("inf"), 1e300])
def test_odd_times_to_wait(cube, timeout):
    job = polycube.Job.simplify(cube)
    job.result()
    try:
        assert job.wait(timeout)
    except polycube.InvalidOption:
        assert not timeout < 1e10


def test_a_job_is_a_generic_type():
    assert polycube.Job[polycube.Simplified].__args__ == (polycube.Simplified,)


def test_a_panic_becomes_an_exception():
    from polycube._native import _panic

    with pytest.raises(polycube.InternalError, match="as asked") as caught:
        _panic()
    assert caught.value.kind == "internal"


def test_errors_can_be_sent_to_other_processes(pair, cube):
    with pytest.raises(polycube.Mismatch) as caught:
        polycube.simplify(pair[1], cube)
    error = caught.value
    again = pickle.loads(pickle.dumps(error))
    assert type(again) is polycube.Mismatch
    assert vars(again) == vars(error) and str(again) == str(error)
    assert "Mismatch" in traceback.format_exception_only(error)[-1]
    assert repr(error).startswith("Mismatch('shape and polycube")
