# SPDX-FileCopyrightText: 2026 the Q-WSM developers
# SPDX-License-Identifier: BSD-3-Clause
"""The type stubs name what the modules have, with the same arguments, and all of it is explained."""

import ast
import importlib
import pathlib
import re
import unittest

OBVIOUS = {"__init__", "__len__", "__iter__", "__next__", "inverse"}


def arguments(function):
    """Names of a function's arguments, by its stub."""
    return [a.arg for a in function.args.args + function.args.kwonlyargs if a.arg != "self"]


def told_arguments(function):
    """Names of the arguments of each overload, by the signatures that pybind11 writes."""
    signatures = re.findall(r"^(?:\d+\. )?\w+\((.*)\) ->", function.__doc__, re.MULTILINE)
    return [[name for name in re.findall(r"(\w+): ", re.sub(r"\[[^\]]*\]", "", signature))
             if name != "self"] for signature in signatures]


class Stubs(unittest.TestCase):
    def check(self, name):
        module = importlib.import_module(name)
        stub = ast.parse(pathlib.Path(module.__file__).with_name("__init__.pyi").read_text())
        classes = {node.name: node for node in stub.body if isinstance(node, ast.ClassDef)}
        functions = {node.name: node for node in stub.body if isinstance(node, ast.FunctionDef)}
        public = {n for n in dir(module) if not n.startswith("_")}
        self.assertEqual(set(classes) | set(functions), public)
        for function in functions.values():
            self.check_function(module, function)
        for told in classes.values():
            self.check_class(getattr(module, told.name), told)

    def check_class(self, real, told):
        members = [node for node in told.body if isinstance(node, ast.FunctionDef)]
        fields = {node.target.id for node in told.body if isinstance(node, ast.AnnAssign)}
        named = {node.name for node in members} | fields
        existing = {name for name in vars(real) if not name.startswith("_")}
        with self.subTest(told.name):
            self.assertEqual({name for name in named if not name.startswith("_")}, existing)
            self.assertTrue(issubclass(real, Exception) or real.__doc__)
        for member in members:
            is_property = any(getattr(d, "id", "") == "property" for d in member.decorator_list)
            if not is_property:
                self.check_function(real, member)

    def check_function(self, owner, told):
        real = getattr(owner, told.name)
        with self.subTest(told.name):
            self.assertIn(arguments(told), told_arguments(real))
            explained = re.sub(r"^(?:\d+\. )?\w+\(.*\) -> .*$", "", real.__doc__, flags=re.MULTILINE)
            self.assertTrue(told.name in OBVIOUS or explained.strip(), f"{told.name}: no docstring")

    def test_qwsm(self):
        self.check("qwsm")

    def test_slam6d(self):
        self.check("slam6d")


if __name__ == "__main__":
    unittest.main()
