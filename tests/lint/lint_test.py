# SPDX-FileCopyrightText: 2026 the Q-WSM developers
# SPDX-License-Identifier: BSD-3-Clause
"""The checks find what they are there to find, in small trees made to break them."""

import pathlib
import tempfile
import unittest

import documents
import layers
import sources
from tree import Tree


def findings(check, files):
    """What `check` says about a tree of {path: text}."""
    with tempfile.TemporaryDirectory() as folder:
        for path, text in files.items():
            target = pathlib.Path(folder) / path
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_text(text)
        return [str(finding) for finding in check(Tree(folder))]


class Layers(unittest.TestCase):
    def complaints(self, path, *lines):
        return findings(layers.check_layers, {path: "\n".join(lines)})

    def refuses(self, path, line):
        self.assertEqual(len(self.complaints(path, line)), 1)

    def allows(self, path, line):
        self.assertEqual(self.complaints(path, line), [])

    def test_libraries_do_not_know_each_other_or_the_service(self):
        self.refuses("qwsm/src/a.cpp", '#include "slam6d/x.hpp"')
        self.refuses("qwsm/src/a.cpp", '#include "service/io/x.hpp"')
        self.allows("sim/src/a.cpp", '#include "qwsm/geometry/pose2.hpp"')

    def test_libraries_do_not_print_or_read_clocks(self):
        self.refuses("qwsm/src/a.cpp", "#include <iostream>")
        self.refuses("slam6d/src/a.cpp", "auto t = std::chrono::steady_clock::now();")
        self.allows("slam6d/src/a.cpp", "#include <thread>")

    def test_third_party_headers_stay_in_their_layer(self):
        self.refuses("service/pipeline/a.cpp", "#include <yaml-cpp/yaml.h>")
        self.allows("service/config/a.cpp", "#include <yaml-cpp/yaml.h>")
        self.refuses("sim/include/sim/a.hpp", "#include <box2d/box2d.h>")
        self.refuses("service/io/a.cpp", "#include <new/library.h>")

    def test_a_lower_layer_does_not_know_a_higher_one(self):
        complaint = "includes service/pipeline/b.hpp: service/io must not know service/pipeline"
        self.assertEqual(
            self.complaints("service/io/a.hpp", "", '#include "service/pipeline/b.hpp"'),
            [f"service/io/a.hpp:2: {complaint}"])


class Lengths(unittest.TestCase):
    def test_a_long_function_is_found_with_its_line(self):
        body = "  Step();\n" * 60
        short = "int Short() { return 1; }"
        long = f"void Long(int a,\n          int b) {{\n{body}}}"
        source = f"namespace a {{\n\n{short}\n\n{long}\n}}\n"
        self.assertEqual(findings(sources.check_lengths, {"qwsm/src/a.cpp": source}),
                         ["qwsm/src/a.cpp:5: a function of 63 lines: name its steps"])

    def test_a_long_namespace_class_or_table_is_no_function(self):
        members = "  int a = 0;  // {\n" * 70
        rows = '  "row {",\n' * 70
        table = f"const auto kTable = {{\n{rows}}};"
        source = f"namespace a {{\nstruct B {{\n{members}}};\n{table}\n}}\n"
        self.assertEqual(findings(sources.check_lengths, {"qwsm/src/a.cpp": source}), [])

    def test_a_long_file_is_found(self):
        self.assertEqual(len(findings(sources.check_lengths, {"a.hpp": "int a;\n" * 401})), 1)


class Files(unittest.TestCase):
    def test_a_missing_notice_is_found(self):
        files = {"a.cpp": "int a;\n", "b": "#!/bin/sh\n"}
        self.assertEqual(len(findings(sources.check_notices, files)), 2)

    def test_a_header_without_guard_is_found(self):
        self.assertEqual(len(findings(sources.check_headers, {"a.hpp": "int a;\n"})), 1)

    def test_a_private_path_is_found(self):
        self.assertEqual(len(findings(sources.check_paths, {"a.md": "see /" + "home/me/b\n"})), 1)
        self.assertEqual(findings(sources.check_paths, {"a.md": "see docs/home/b\n"}), [])

    def test_a_broken_script_is_found(self):
        self.assertTrue(findings(sources.check_scripts, {"a": "#!/bin/sh\nif true\n"}))

    def test_a_source_outside_the_build_is_found(self):
        files = {"x/CMakeLists.txt": "add_library(x a.cpp)\n", "x/a.cpp": "", "x/b.cpp": ""}
        self.assertEqual(findings(sources.check_build, files),
                         ["x/b.cpp:1: stands in no CMakeLists.txt above it"])

    def test_a_link_to_nowhere_is_found(self):
        files = {"a.md": "[b](b.md#the-end) [c](c.md) [d](#d)\n", "b.md": "# Start\n## The end\n"}
        self.assertEqual(len(findings(documents.check_links, files)), 2)


if __name__ == "__main__":
    unittest.main()
