# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The eigengrasp authors
"""scripts/check_layers catches what it must: each case is a small tree with one wrong (or no wrong) include."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts/check_layers"
LAYERS = "core:\ngeometry: core\nplanning: core geometry\n"


def check(files, layers=LAYERS):
    """Exit code and what was printed for a tree of files."""
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        for name, text in {"docs/layers.txt": layers, **files}.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text)
        done = subprocess.run([sys.executable, SCRIPT, "--root", root], capture_output=True, text=True)
        return done.returncode, done.stdout + done.stderr


class CheckLayers(unittest.TestCase):
    def assert_caught(self, files, expected, layers=LAYERS):
        code, text = check(files, layers)
        self.assertEqual(code, 1, text)
        self.assertIn(expected, text)

    def test_allowed_includes_pass(self):
        code, text = check({
            "src/planning/a.cpp": '#include "eigengrasp/geometry/g.hpp"\n#include "planning/p.hpp"\n'
                                  '#include "p.hpp"\n#include <vector>\n#include <assimp/scene.h>\n',
            "src/planning/p.hpp": "",
            "include/eigengrasp/geometry/g.hpp": "#include <Eigen/Core>\n#include <fmt/format.h>\n#include <array>\n",
            "src/CMakeLists.txt": "eigengrasp_module(planning DEPENDS core geometry PRIVATE qhull)\n"})
        self.assertEqual(code, 0, text)

    def test_upward_include_is_caught(self):
        self.assert_caught({"src/core/a.cpp": '\n#include "eigengrasp/planning/p.hpp"\n'},
                           "src/core/a.cpp:2: core may not include planning")

    def test_upward_include_in_a_public_header_is_caught(self):
        self.assert_caught({"include/eigengrasp/geometry/g.hpp": "# include <eigengrasp/planning/p.hpp>\n"},
                           "geometry may not include planning")

    def test_private_header_of_a_higher_module_is_caught(self):
        self.assert_caught({"src/geometry/a.cpp": '#include "planning/p.hpp"\n'}, "geometry may not include planning")

    def test_private_header_in_a_public_one_is_caught(self):
        self.assert_caught({"include/eigengrasp/core/c.hpp": '#include "core/p.hpp"\n'}, "the private header")

    def test_other_library_in_a_public_header_is_caught(self):
        self.assert_caught({"include/eigengrasp/core/c.hpp": "#include <assimp/scene.h>\n"}, "<assimp/scene.h>")

    def test_unknown_module_is_caught(self):
        self.assert_caught({"src/magic/a.cpp": ""}, "magic is not a module")
        self.assert_caught({"src/core/a.cpp": '#include "eigengrasp/magic/a.hpp"\n'}, "magic is not a module")

    def test_leaving_the_folder_is_caught(self):
        self.assert_caught({"src/core/a.cpp": '#include "../planning/p.hpp"\n'}, "leaves its folder")

    def test_cycle_in_the_layers_is_caught(self):
        self.assert_caught({}, "not on an earlier line", "core: geometry\ngeometry: core\n")

    def test_link_beyond_the_layers_is_caught(self):
        self.assert_caught({"src/CMakeLists.txt": "eigengrasp_module(core DEPENDS planning PUBLIC fmt)\n"},
                           "core may not depend on planning")


if __name__ == "__main__":
    unittest.main()
