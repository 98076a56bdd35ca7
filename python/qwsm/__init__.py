# SPDX-FileCopyrightText: 2026 the Q-WSM developers
# SPDX-License-Identifier: BSD-3-Clause
"""Robust weighted scan matching with quadtrees: logs, maps, matches, searches and their evaluation.

Metres, radians and nanoseconds throughout; T_a_b is the pose of frame b in frame a.
"""

from ._qwsm import *  # noqa: F403
from ._qwsm import __version__  # noqa: F401
