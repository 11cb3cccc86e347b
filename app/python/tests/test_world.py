# SPDX-FileCopyrightText: The Windfall authors
# SPDX-License-Identifier: MIT OR Apache-2.0
"""Worlds: the same state as the command's, on both backends, across checkpoints, threads and interrupts."""

import multiprocessing
import pickle
import signal
import threading
import time

import pytest

import windfall as wf


def test_a_world_is_where_the_command_is(simulated):
    world = wf.World("storm", backend="cpu").step(300)
    report = simulated("storm", "--steps", "300")
    assert world.state_hash() == report["state_hash"]
    assert world.step_index == 300 and world.time_s == pytest.approx(report["time_s"])
    stats = world.stats()
    assert stats["leaves"] == report["leaves"]
    assert stats["litter"] == report["litter"] and stats["particles"] == report["particles"]


def test_counts_of_litter_and_particles_are_those_of_the_command(simulated):
    for scene in ["drift", "particle-lab"]:
        stats = wf.World(scene, backend="cpu").step(20).stats()
        report = simulated(scene, "--steps", "20")
        assert stats["litter"] == report["litter"] and stats["particles"] == report["particles"]
        assert stats["litter"] or stats["particles"]


def test_both_backends_agree_to_the_bit(storm):
    cpu, gpu = (wf.World(storm, backend=backend).step(60) for backend in ("cpu", "wgpu"))
    assert gpu.info["backend"] == "wgpu" and cpu.info["backend"] == "cpu"
    if gpu.info["contract"] == "exact":
        assert gpu.state_hash() == cpu.state_hash()
    assert (gpu.view("place")["bits"] == cpu.view("place")["bits"]).all()
    hashes = {wf.World(storm, backend="cpu", threads=threads).step(60).state_hash() for threads in (1, 3)}
    assert hashes == {cpu.state_hash()}


def test_a_saved_world_goes_on_as_if_nothing_had_been(storm, tmp_path, simulated):
    world = wf.World(storm, backend="cpu").step(40)
    path = tmp_path / "a.windfall"
    world.save(path)
    assert [file.name for file in tmp_path.iterdir()] == ["a.windfall"]
    copies = [
        wf.World.open(path, backend="cpu"),
        wf.World.from_bytes(world.to_bytes(), backend="cpu"),
        pickle.loads(pickle.dumps(world)),
    ]
    expected = world.step(40).state_hash()
    assert [copy.step(40).state_hash() for copy in copies] == [expected] * 3
    assert copies[2].info["backend"] == "cpu", "a pickle keeps the backend"
    assert simulated("--resume", str(path), "--steps", "40")["state_hash"] == expected


def test_what_is_no_checkpoint_is_refused(tmp_path):
    path = tmp_path / "a.windfall"
    path.write_bytes(b"leaves")
    with pytest.raises(wf.SceneError, match="not a usable checkpoint") as raised:
        wf.World.open(path)
    assert raised.value.file == str(path)
    with pytest.raises(wf.SceneError, match="none.windfall"):
        wf.World.open(tmp_path / "none.windfall")


def _stepped(world: wf.World) -> str:
    return world.step(30).state_hash()


def test_worlds_go_to_other_processes(storm):
    world = wf.World(storm, backend="cpu", threads=1)
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        found = pool.map_async(_stepped, [world]).get(timeout=120)
    assert found == [_stepped(world)]


def test_others_work_while_a_world_steps():
    world = wf.World("storm", backend="cpu", threads=1)
    counted = 0
    thread = threading.Thread(target=world.step, args=(300,))
    thread.start()
    while thread.is_alive():
        counted += 1
    thread.join()
    assert world.step_index == 300 and counted > 1000


def test_a_world_is_stepped_by_one_thread_at_a_time():
    world = wf.World("storm", backend="cpu", threads=1)
    # Long enough for this thread to come in between, also where others use the processor.
    thread = threading.Thread(target=world.step, args=(3000,))
    thread.start()
    time.sleep(0.1)
    with pytest.raises(RuntimeError, match="another thread"):
        world.step()
    with pytest.raises(BufferError, match="stepping"):
        world.view("place")
    thread.join()
    assert world.step_index == 3000


def test_ctrl_c_ends_a_long_step():
    world = wf.World("storm", backend="cpu")
    threading.Timer(0.3, signal.raise_signal, [signal.SIGINT]).start()
    began = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        world.step(1_000_000)
    assert time.monotonic() - began < 30, "it does not go on to the end"
    reached = world.step_index
    assert 0 < reached < 1_000_000
    other = wf.World("storm", backend="cpu").step(reached)
    assert world.state_hash() == other.state_hash(), "between two steps"
    assert world.step().step_index == reached + 1, "it can go on"


def test_backends_that_there_are_not():
    with pytest.raises(ValueError, match="'cuda'; allowed: 'auto', 'cpu', 'wgpu'"):
        wf.World("storm", backend="cuda")
    with pytest.raises(ValueError, match="threads is 0"):
        wf.World("storm", threads=0)
    with pytest.raises(wf.DeviceError, match="adapter"):
        wf.World("storm", backend="wgpu", adapter="no such adapter")
