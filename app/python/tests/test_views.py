# SPDX-FileCopyrightText: The Windfall authors
# SPDX-License-Identifier: MIT OR Apache-2.0
"""Columns as arrays: without a copy, copied, decoded."""

import csv
import io
import subprocess
import sys

import numpy as np
import pytest

import windfall as wf


def test_a_view_is_the_state_itself(storm):
    world = wf.World(storm, backend="cpu")
    first, second = world.view("place"), world.view("place")
    assert first.shape == (storm.leaf_count,) and first["position"].shape == (storm.leaf_count, 3)
    assert first["position"].strides == (16, 4)
    assert np.shares_memory(first, second), "no copy"
    assert not first.flags.writeable
    with pytest.raises(ValueError, match="read-only"):
        first["position"][0] = 0
    with pytest.raises(TypeError, match="read-only"):
        memoryview(world.column("place"))[0] = 0
    with pytest.raises(TypeError, match="read-write"):
        io.BytesIO(b"leaf").readinto(world.column("place"))
    del first, second
    world.step()


def test_a_world_does_not_step_while_it_is_viewed(storm):
    world = wf.World(storm, backend="cpu")
    view = world.view("place")
    part = view["position"][3:]
    del view
    with pytest.raises(BufferError, match="1 views"):
        world.step()
    assert world.step_index == 0
    before = part.copy()
    del part
    assert (world.step(30).view("place")["position"][3:] != before).any()


def test_a_view_keeps_its_world_alive(storm):
    view = wf.World(storm, backend="cpu").view("place")
    assert np.isfinite(view["position"]).all()


def test_copies_let_the_world_go_on(storm):
    world = wf.World(storm, backend="cpu")
    copied = {name: world.columns[name] for name in world.columns}
    assert {"place", "drift", "attitude", "particles.place"} <= set(copied)
    assert len(world.columns) == len(copied)
    assert np.allclose(np.linalg.norm(copied["attitude"]["quaternion"], axis=1), 1, atol=1e-5)
    assert (world.step(30).columns["place"] != copied["place"]).any()
    with pytest.raises(KeyError, match="no column 'places'; there: place, "):
        world.columns["places"]


def test_decoded_leaves_are_those_of_the_tracks(storm, tmp_path):
    scene = tmp_path / "storm.ron"
    scene.write_text(storm.to_ron())
    arguments = ["simulate", str(scene), "--backend", "cpu", "--steps", "30", "--tracks", "t.csv"]
    subprocess.run(
        [sys.executable, "-m", "windfall", *arguments, "--track-every", "30"], cwd=tmp_path, check=True, capture_output=True
    )
    rows = [row for row in csv.DictReader(open(tmp_path / "t.csv")) if int(row["step"]) == 30]
    leaves = wf.World(storm, backend="cpu").step(30).leaves_flat()
    assert len(rows) == 100
    for row in rows:
        slot = int(row["leaf"])
        assert int(row["id"]) == leaves["id"][slot]
        assert row["state"] == wf.LEAF_STATES[leaves["state"][slot]]
        if row["state"] == "dormant":
            continue
        for name in ("x_m", "y_m", "z_m", "vx_m_s", "vy_m_s", "vz_m_s", "qx", "qy", "qz", "qw"):
            assert np.float32(row[name]) == leaves[name][slot], (name, row)
        if row["primitive"]:
            assert row["primitive"] == wf.MOTIONS[leaves["motion"][slot]]


def test_decoded_leaves_have_shapes(storm):
    leaves = wf.World(storm, backend="cpu").leaves()
    count = storm.leaf_count
    assert leaves["position"].shape == leaves["velocity"].shape == (count, 3)
    assert leaves["quaternion"].shape == (count, 4)
    assert set(np.unique(leaves["state"])) <= set(range(len(wf.LEAF_STATES)))
    assert len(np.unique(leaves["id"])) == count
    falling = leaves["state"] == wf.LEAF_STATES.index("falling")
    assert falling.any() and ((0.01 < leaves["size_m"][falling]) & (leaves["size_m"][falling] < 0.5)).all()
