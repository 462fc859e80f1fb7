# SPDX-License-Identifier: BSD-3-Clause
"""The notebook's cells run where there is neither IPython nor anything that a cell may do without."""

import contextlib
import io
import json
import os
import sys
import unittest
import unittest.mock

NOTEBOOK = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "Examples", "Python", "Relief.ipynb")
OPTIONAL = ("IPython", "ipywidgets", "pyvista", "reliefshading.pyvista")


class TestNotebook(unittest.TestCase):
    def setUp(self):
        with open(NOTEBOOK, encoding="utf-8") as file:
            self.cells = [cell for cell in json.load(file)["cells"] if cell["cell_type"] == "code"]

    def test_is_kept_without_outputs(self):
        for cell in self.cells:
            self.assertEqual((cell["outputs"], cell["execution_count"]), ([], None), cell["id"])

    def test_runs_without_what_is_optional(self):
        names = {"__name__": "__main__"}
        printed = io.StringIO()
        with unittest.mock.patch.dict(sys.modules, dict.fromkeys(OPTIONAL)), contextlib.redirect_stdout(printed):
            for cell in self.cells:
                exec(compile("".join(cell["source"]), cell["id"], "exec"), names)
        self.assertEqual(names["picture"].image.shape, (300, 450, 4))
        self.assertEqual(len(names["pictures"]), 3)
        self.assertEqual(len(printed.getvalue().splitlines()), 4)
        # A notebook shows a cell's last value by this.
        self.assertTrue(names["picture"]._repr_png_())


if __name__ == "__main__":
    unittest.main()
