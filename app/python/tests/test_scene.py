# SPDX-FileCopyrightText: The Windfall authors
# SPDX-License-Identifier: MIT OR Apache-2.0
"""Scenes: where they come from, how they are changed, and what is refused."""

import pickle

import numpy as np
import pytest

import windfall as wf


def test_every_preset_loads_and_comes_back_from_text_dictionary_and_pickle():
    assert "storm" in wf.PRESETS and len(wf.PRESETS) > 25
    for name in wf.PRESETS:
        scene = wf.Scene.load(name)
        assert scene.leaf_count + scene.particle_count > 0
        assert wf.Scene.from_ron(scene.to_ron()) == scene
        assert wf.Scene(scene.to_dict()) == scene
        assert pickle.loads(pickle.dumps(scene)) == scene
    assert wf.Scene.load("storm") != wf.Scene.load("gale")


def test_values_go_where_paths_lead():
    scene = wf.Scene.load("autumn-park")
    windy = scene.with_(seed=7, **{"wind.speed": 9.0, "sources[0].count": np.int64(77)})
    assert windy.seed == 7 and windy.to_dict()["wind"]["speed"] == {"MetresPerSecond": 9.0}
    assert windy.to_dict()["sources"][0]["count"] == 77
    assert scene.seed != 7, "the scene itself is as it was"
    named = scene.with_(**{"wind.speed.Beaufort": 5})
    assert named.to_dict()["wind"]["speed"] == {"Beaufort": 5}
    assert scene.with_(leaves=5000).leaf_count == 5000


def test_a_dictionary_may_leave_out_what_has_a_usual_value():
    scene = wf.Scene({"name": "mine", "wind": {"speed": {"Beaufort": 5}}})
    assert scene.name == "mine" and scene.file == "<dict>"
    assert scene.to_dict()["wind"]["speed"] == {"Beaufort": 5}


def test_errors_are_the_line_of_the_command(tmp_path, refused):
    bad = tmp_path / "bad.ron"
    bad.write_text("(wind: (speed: Beaufort(99)))")
    line = refused("simulate", str(bad))
    with pytest.raises(wf.SceneError) as raised:
        wf.World(str(bad), backend="cpu")
    assert str(raised.value) == line
    error = raised.value
    assert isinstance(error, ValueError)
    assert (error.file, error.field, error.value) == (str(bad), "wind.speed", "99") and error.allowed
    with pytest.raises(wf.SceneError, match="did you mean 'storm'") as raised:
        wf.Scene.load("strom")
    assert str(raised.value) == refused("simulate", "strom")


def test_errors_of_text_dictionaries_and_paths_say_where():
    with pytest.raises(wf.SceneError) as raised:
        wf.Scene.from_ron("(\n  wind: 3,\n)", "mine.ron")
    assert (raised.value.file, raised.value.line) == ("mine.ron", 2)
    with pytest.raises(wf.SceneError, match="^<dict>: .*wnid") as raised:
        wf.Scene({"wnid": {}})
    assert raised.value.field is None
    storm = wf.Scene.load("storm")
    with pytest.raises(wf.SceneError, match="wind.sped: no 'sped' in wind; there: "):
        storm.with_(**{"wind.sped": 3})
    with pytest.raises(wf.SceneError) as raised:
        storm.with_(**{"wind.speed.Beaufort": 13})
    assert raised.value.field == "wind.speed" and raised.value.value == "13"
