# SPDX-FileCopyrightText: 2026 the Q-WSM developers
# SPDX-License-Identifier: BSD-3-Clause
"""The Python of README.md does what is said of it, on a bag of a simulated drive."""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

import numpy as np

README = pathlib.Path(os.environ["QWSM_SOURCE"], "README.md")


class Readme(unittest.TestCase):
    def test_from_a_bag_to_a_plotted_map(self):
        (example,) = re.findall(r"^```python\n(.*?)^```", README.read_text(), re.DOTALL | re.MULTILINE)
        self.assertLessEqual(len(example.splitlines()), 10)
        pyplot = mock.MagicMock()  # Plotting is others' work, and theirs to test.
        modules = {"matplotlib": mock.MagicMock(pyplot=pyplot), "matplotlib.pyplot": pyplot}
        with tempfile.TemporaryDirectory() as folder, mock.patch.dict(sys.modules, modules):
            bag = f"{folder}/drive.mcap"
            convert = [os.environ["QWSM_PROGRAM"], "convert", os.environ["QWSM_TEST_LOG"], "-o", bag]
            subprocess.run(convert, check=True, capture_output=True)
            exec(example.replace('"drive.mcap"', repr(bag)), {})
        cells = pyplot.imshow.call_args.args[0]
        self.assertEqual(len(pyplot.imshow.call_args.kwargs["extent"]), 4)
        self.assertGreater(np.count_nonzero(cells == 2), 100)
        self.assertEqual(*map(len, pyplot.plot.call_args.args[:2]))


if __name__ == "__main__":
    unittest.main()
