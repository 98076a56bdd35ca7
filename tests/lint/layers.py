# SPDX-FileCopyrightText: 2026 the Q-WSM developers
# SPDX-License-Identifier: BSD-3-Clause
"""Who may include what.

    service/apps   python              composition
    service/pipeline                   sources and sinks
    service/options                    what can be configured of the programs
    service/view                       the network in browsers
    service/dds                        the network
    service/team                       sessions, queues, threads, the shared map
    service/config  service/io  service/graph
    qwsm (2D)   slam6d (3D)   sim (Box2D)
    Eigen and the standard library
"""

import re
from pathlib import PurePosixPath

from tree import Finding

LIBRARIES = {"qwsm", "slam6d", "sim"}
BORDER = {"service/config", "service/io", "service/dds", "service/graph"}

# Layer: the other layers it may include. `tests` and `examples` may include all.
MAY_USE = {
    "qwsm": set(),
    "slam6d": set(),
    "sim": {"qwsm", "slam6d"},
    "idl": set(),
    "service/config": {"qwsm"},
    "service/io": {"qwsm", "slam6d"},
    "service/graph": {"slam6d"},
    "service/dds": {"qwsm", "slam6d", "idl", "service/team"},
    "service/team": {"qwsm", "slam6d", "service/io"},
    "service/view": {"qwsm", "service/io", "service/dds", "service/team"},
    "service/options": LIBRARIES | BORDER | {"service/team", "service/view"},
    "service/pipeline": LIBRARIES | BORDER | {"service/options", "service/team", "service/view"},
    "service/apps": LIBRARIES | BORDER | {
        "service/options", "service/team", "service/view", "service/pipeline"
    },
    "python": {"qwsm", "slam6d", "service/config", "service/io", "service/graph", "service/pipeline"},
}

# Third-party library: how its headers are recognised, and the layers that may include it.
THIRD_PARTY = {
    "Eigen": (r"(unsupported/)?Eigen/", set(MAY_USE) - {"idl"}),
    "Box2D": (r"box2d/", {"sim"}),
    "yaml-cpp": (r"yaml-cpp/", {"service/config"}),
    "CLI11": (r"CLI/", {"service/apps"}),
    "Cairo": (r"cairo", {"service/io"}),
    "libpng": (r"png\.h", {"service/io"}),
    "libtiff": (r"tiff", {"service/io"}),
    "Ceres": (r"ceres/", {"service/graph"}),
    "Boost": (r"boost/", {"service/io", "service/view"}),
    "OpenSSL": (r"openssl/", {"service/view"}),
    "zstd": (r"zstd\.h", {"service/io"}),
    "LZ4": (r"lz4frame\.h", {"service/io"}),
    "bzip2": (r"bzlib\.h", {"service/io"}),
    "SQLite": (r"sqlite3\.h", {"service/io"}),
    "nlohmann-json": (r"nlohmann/", {"service/pipeline", "service/view"}),
    "Cyclone DDS": (r"dds/(dds\.h|dds[a-z]*/)", {"service/dds", "idl"}),
    "fmt": (r"fmt/", {layer for layer in MAY_USE if layer.startswith(("service/", "python"))}),
    "spdlog": (r"spdlog/", {"service/pipeline", "service/apps"}),
    "systemd": (r"systemd/", {"service/apps"}),
    "pybind11": (r"pybind11/", {"python"}),
    "Fast DDS": (r"fast(dds|rtps|cdr)/", set()),
    "GoogleTest": (r"g(test|mock)/", set()),
    "Google Benchmark": (r"benchmark/", set()),
    "nanoflann": (r"nanoflann", set()),
}

# Libraries that even their own layer keeps to its .cpp files, so that a port touches few of them and
# few of ours compile them.
SOURCES_ONLY = {
    "Box2D", "Boost", "Cairo", "Ceres", "LZ4", "OpenSSL", "SQLite", "bzip2", "libtiff", "nlohmann-json",
    "spdlog", "zstd"
}

# The folder whose headers may include such a library all the same: templates over its types. Who
# includes them stands in the folder above.
INNER_FOLDERS = {"Boost": "service/view/http/beast/"}

# Standard headers by which a library would print, open files, read clocks or run threads.
IMPURE = {"cstdio", "filesystem", "fstream", "iostream", "stdio.h"}
THREADS = {"condition_variable", "future", "mutex", "shared_mutex", "thread"}
FORBIDDEN_STANDARD = {
    "qwsm": IMPURE | THREADS,
    "slam6d": IMPURE,
    "sim": IMPURE | THREADS,
}

INCLUDE = re.compile(r'\s*#\s*include\s+[<"]([^>"]+)[>"]')
CLOCK = re.compile(r"\w*_clock::now|\bgettimeofday\b|\bclock_gettime\b|\bstd::time\(")


# Installed headers of the service's layers, which are included as those of the libraries are.
INSTALLED = {"qwsm/logs/": "service/io", "slam6d/graph/": "service/graph"}


def layer_of(path):
    """The layer a file of the tree, or an included header of the project, belongs to."""
    for folder, layer in INSTALLED.items():
        if path.startswith(folder):
            return layer
    parts = path.split("/")
    if parts[0] == "service":
        return "/".join(parts[:2])
    return parts[0]


def third_party(header):
    """The name of the library a header comes from; None for ours and the standard's."""
    libraries = THIRD_PARTY.items()
    return next((name for name, (pattern, _) in libraries if re.match(pattern, header)), None)


def is_inner_of_others(path, header):
    """Whether a header is meant for another folder than that of the path."""
    return any(header.startswith(folder) and not path.startswith(str(PurePosixPath(folder).parent))
               for folder in INNER_FOLDERS.values())


def judge(path, layer, header):
    """What is wrong with `layer` including `header` in `path`; None where nothing is."""
    library = third_party(header)
    if library:
        if layer not in THIRD_PARTY[library][1]:
            return f"{layer} must not use {library}"
        is_inner = path.startswith(INNER_FOLDERS.get(library, "nowhere"))
        if library in SOURCES_ONLY and not is_inner and not path.endswith(".cpp"):
            return f"{library} belongs into .cpp files only"
    elif header in FORBIDDEN_STANDARD.get(layer, ()):
        return f"{layer} must not print, open files or run threads"
    elif is_inner_of_others(path, header):
        return "an inner header of another folder"
    elif layer_of(header) in MAY_USE:
        if layer_of(header) not in MAY_USE[layer] | {layer}:
            return f"{layer} must not know {layer_of(header)}"
    elif header.startswith("tests/"):
        return f"{layer} must not know the tests"
    elif "/" in header and not header.startswith(("sys/", "netinet/", "arpa/")):
        return "unknown to tests/lint/layers.py: say there who may use it"
    return None


def check_layers(tree):
    """Includes follow the layers, and third-party headers stay where they belong."""
    for path in tree.with_suffix(".hpp", ".cpp", ".h"):
        layer = layer_of(path)
        if layer not in MAY_USE:
            continue
        for number, line in enumerate(tree.lines(path), start=1):
            include = INCLUDE.match(line)
            complaint = include and judge(path, layer, include[1])
            if complaint:
                yield Finding(path, number, f"includes {include[1]}: {complaint}")
            if layer in LIBRARIES and CLOCK.search(line):
                yield Finding(path, number, f"{layer} must not read a clock")
