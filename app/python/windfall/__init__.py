# SPDX-FileCopyrightText: The Windfall authors
# SPDX-License-Identifier: MIT OR Apache-2.0
"""Falling leaves on the CPU or the GPU: simulated, drawn, measured.

    >>> import windfall as wf
    >>> world = wf.World("storm", backend="cpu")
    >>> world.step(300).stats()["leaves"]["total"]
    20000

A scene says what there is, a world goes on. Errors are one line, the same as the command's.
"""

from ._arrays import Columns
from ._pictures import Frames, Picture
from ._study import Study, study
from ._windfall import (
    LEAF_STATES,
    MOTIONS,
    PRESETS,
    Column,
    DeviceError,
    Scene,
    SceneError,
    World,
    __version__,
)

__all__ = [
    "LEAF_STATES",
    "MOTIONS",
    "PRESETS",
    "Column",
    "Columns",
    "DeviceError",
    "Frames",
    "Picture",
    "Scene",
    "SceneError",
    "Study",
    "World",
    "__version__",
    "study",
]
