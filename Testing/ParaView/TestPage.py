# SPDX-License-Identifier: BSD-3-Clause
"""Runs the Python of Documentation/ParaView.md, in which the plugin is loaded by PV_PLUGIN_PATH."""

import os
import re
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
with open(os.path.join(ROOT, "Documentation", "ParaView.md"), encoding="utf-8") as page:
    blocks = re.findall(r"```python\n(.*?)```", page.read(), re.DOTALL)
assert blocks, "there are no examples"
with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    os.symlink(os.path.join(ROOT, "Examples"), "Examples")
    for block in blocks:
        exec(compile(block, "ParaView.md", "exec"), {})
    for file in re.findall(r'"(\w+\.\w+)"', "".join(blocks)):
        assert os.path.getsize(file) > 10000, f"{file} is empty"
    os.chdir(ROOT)
print("passed")
