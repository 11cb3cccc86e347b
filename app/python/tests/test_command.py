# SPDX-FileCopyrightText: The Windfall authors
# SPDX-License-Identifier: MIT OR Apache-2.0
"""The command inside the package, exports and studies."""

import subprocess
import sys

import numpy as np
import pytest

import windfall as wf


def test_the_command_is_there():
    done = subprocess.run([sys.executable, "-m", "windfall", "--version"], capture_output=True, text=True)
    assert done.returncode == 0 and done.stdout.strip() == f"windfall {wf.__version__}"


def test_a_scene_is_exported_as_the_command_does(storm, tmp_path):
    path = storm.with_(leaves=50).export(tmp_path / "a.csv", frames=range(0, 4), fps=30, backend="cpu")
    rows = path.read_text().splitlines()
    assert path == tmp_path / "a.csv" and rows[0].startswith("frame,step,time_s")
    assert {row.split(",")[0] for row in rows[1:]} == {"0", "1", "2", "3"}
    with pytest.raises(ValueError, match="follow one another"):
        storm.export(tmp_path / "b.csv", frames=range(0, 9, 2))
    with pytest.raises(ValueError, match="no folder"):
        storm.export(tmp_path / "none" / "b.csv", frames=(0, 1))


def test_a_study_is_a_pair_of_tables(tmp_path):
    vary = {"wind.speed": [0, 6], "fall_speed": "1..2/2"}
    study = wf.study("autumn-park", vary, drops=20, over_s=1, seconds=60, out=tmp_path / "s")
    summary, landings = study.summary, study.landings
    assert list(summary["wind.speed"]) == [0, 0, 6, 6] and list(summary["fall_speed"]) == [1, 2, 1, 2]
    assert (summary["drops"] == 20).all() and len(landings["aloft_s"]) == 80
    landed = np.isfinite(landings["aloft_s"])
    point = (landings["point"] == 3) & landed
    assert landings["along_m"][point].mean() == pytest.approx(summary["along_mean_m"][2], rel=1e-9)
    assert landings["along_m"][point].mean() > landings["along_m"][(landings["point"] == 1) & landed].mean()
    again = wf.study("autumn-park", vary, drops=20, over_s=1, seconds=60, out=tmp_path / "s")
    assert all((again.summary[name] == summary[name]).all() for name in ("point", "drops", "landed"))


def test_a_study_that_makes_no_sense_says_so():
    with pytest.raises(ValueError, match="--vary wind.sped: no 'sped' in wind"):
        wf.study("autumn-park", {"wind.sped": [0, 1]}, drops=20)
    with pytest.raises(ValueError, match="^six-motions: wind.speed is 99"):
        wf.study("six-motions", {"wind.speed": [0, 99]}, drops=20)
