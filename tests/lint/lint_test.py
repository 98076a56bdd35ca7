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

    def test_an_installed_header_belongs_to_the_layer_it_is_of(self):
        self.refuses("qwsm/src/a.cpp", '#include "qwsm/logs/log_reader.hpp"')
        self.refuses("service/io/logs/a.cpp", '#include "slam6d/graph/ceres_loop_closer.hpp"')
        self.allows("service/pipeline/a.cpp", '#include "qwsm/logs/log_reader.hpp"')

    def test_libraries_do_not_print_or_read_clocks(self):
        self.refuses("qwsm/src/a.cpp", "#include <iostream>")
        self.refuses("slam6d/src/a.cpp", "auto t = std::chrono::steady_clock::now();")
        self.allows("slam6d/src/a.cpp", "#include <thread>")

    def test_third_party_headers_stay_in_their_layer(self):
        self.refuses("service/pipeline/a.cpp", "#include <yaml-cpp/yaml.h>")
        self.allows("service/config/a.cpp", "#include <yaml-cpp/yaml.h>")
        self.refuses("sim/include/sim/a.hpp", "#include <box2d/box2d.h>")
        self.refuses("service/io/a.cpp", "#include <new/library.h>")

    def test_inner_headers_stay_in_their_folder(self):
        self.allows("service/view/http/beast/a.hpp", "#include <boost/asio.hpp>")
        self.allows("service/view/http/a.cpp", '#include "service/view/http/beast/a.hpp"')
        self.refuses("service/view/http/a.hpp", "#include <boost/asio.hpp>")
        self.refuses("service/view/live/a.cpp", '#include "service/view/http/beast/a.hpp"')
        self.refuses("service/view/http/beast/a.hpp", "#include <openssl/ssl.h>")

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

    def test_a_name_that_two_sources_have_for_themselves_is_found(self):
        own = "namespace a {\nnamespace {\n\nvoid Append(int value) {\n}\n\n}  // namespace\n}\n"
        template = own.replace("void", "template <class T>\nvoid").replace("int", "T")
        files = {"service/io/a.cpp": own, "service/io/b.cpp": template, "service/dds/b.cpp": own}
        self.assertEqual(len(findings(sources.check_unnamed_namespaces, files)), 1)

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


class Figures(unittest.TestCase):
    RESULTS = "# Results\n| log | Q-WSM, m |\n|---|---|\n| intel | 0.0179 |\n| aces | 0.0488 |\n"

    def complaints(self, *rows):
        table = "| | intel | aces |\n|---|---|---|\n" + "\n".join(rows)
        readme = f"| | intel |\n|---|---|\n| other, m | 7 |\n## Results\n{table}\n## Formats\n"
        files = {"README.md": readme, "docs/results.md": self.RESULTS}
        return findings(documents.check_figures, files)

    def test_figures_may_be_rounded_and_the_table_turned(self):
        self.assertEqual(self.complaints("| Q-WSM, m | 0.018 | 0.05 |"), [])

    def test_figures_that_parted_are_found_with_their_line(self):
        self.assertEqual(
            self.complaints("| Q-WSM, m | 0.018 | 0.055 |"),
            ["README.md:7: 'aces' of 'Q-WSM, m' is 0.055, in docs/results.md it is 0.0488"])

    def test_a_figure_that_nobody_measured_is_found(self):
        self.assertEqual(len(self.complaints("| WSM, m | 0.018 | - |")), 1)


class LayerTable(unittest.TestCase):
    def complaints(self, *rows):
        table = "| folder | holds | may use |\n|---|---|---|\n" + "\n".join(rows)
        text = "# A\n## Folders\n" + table + "\n## Next\n"
        return findings(documents.check_layer_table, {"docs/architecture.md": text})

    def test_a_row_that_contradicts_the_lint_is_found(self):
        right = "| `service/graph` | loops | Ceres, `slam6d` |"
        wrong = "| `service/graph` | loops | Ceres, `slam6d`, `qwsm` |"
        self.assertEqual(len(self.complaints(wrong)) - len(self.complaints(right)), 1)

    def test_a_layer_without_a_row_is_found(self):
        self.assertIn("docs/architecture.md:1: the table of folders has no row for sim",
                      self.complaints("| `qwsm/` | 2D | Eigen |"))


class Citations(unittest.TestCase):
    def complaints(self, comment):
        entry = '@book{n07,\n  author = {Andreas N{\\"u}chter and Kai Lingemann},\n  year = {2007}\n}\n'
        return findings(documents.check_citations, {"docs/references.bib": entry, "a.hpp": comment})

    def test_a_cited_paper_is_known_by_any_of_its_authors(self):
        self.assertEqual(self.complaints("/// As in Nüchter et al. (2007), Eq. 3."), [])
        self.assertEqual(self.complaints("// (Nüchter & Lingemann 2007)"), [])

    def test_a_paper_that_is_not_listed_is_found(self):
        self.assertEqual(self.complaints("// Horn (1987)"),
                         ["a.hpp:1: docs/references.bib does not have Horn 1987"])


if __name__ == "__main__":
    unittest.main()
