# SPDX-FileCopyrightText: 2026 the Q-WSM developers
# SPDX-License-Identifier: BSD-3-Clause
"""Registration of 3D scans, and 6D SLAM by it.

Metres and radians throughout; poses are 4x4 matrices, T_a_b that of frame b in frame a.
"""

from ._slam6d import *  # noqa: F403
from ._slam6d import __version__  # noqa: F401
