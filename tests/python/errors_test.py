# SPDX-FileCopyrightText: 2026 the Q-WSM developers
# SPDX-License-Identifier: BSD-3-Clause
"""Each module raises its own errors, whichever others are imported beside it."""

import os
import subprocess
import sys
import unittest

CHECK = """
for module, make in (qwsm, qwsm.Mapper), (slam6d, slam6d.Slam):
    try:
        make({"unknown": 1})
    except module.OptionError as error:
        assert type(error) is module.OptionError, type(error)
"""


class Errors(unittest.TestCase):
    def test_both_modules_in_either_order(self):
        for order in "qwsm, slam6d", "slam6d, qwsm":
            with self.subTest(order):
                program = [sys.executable, "-c", f"import {order}\n{CHECK}"]
                done = subprocess.run(program, env=os.environ, capture_output=True, text=True)
                self.assertEqual((done.returncode, done.stderr), (0, ""))


if __name__ == "__main__":
    unittest.main()
