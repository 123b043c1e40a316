"""The blocks of code of docs/user/blender.md, one after the other, as a reader would run them."""

import os
import re
import subprocess

import bpy
from support import COMMAND, SOURCE


class Documented:
    """Each section has blocks: `run` runs the next of them and returns the text before it."""

    def __init__(self, folder):
        """They are run in the folder, which gets the project's data."""
        text = (SOURCE / "docs/user/blender.md").read_text()
        pattern = re.compile(r"^( *)```(python|sh)\n(.*?)^ *```$", re.M | re.S)
        self._blocks = [(match[2], re.sub(rf"^{match[1]}", "", match[3], flags=re.M)) for match in
                        pattern.finditer(text)]
        self._names = {"bpy": bpy}  # as in Blender's console
        os.symlink(SOURCE / "data", folder / "data")
        os.chdir(folder)

    def __len__(self):
        return len(self._blocks)

    def run(self):
        """Runs the next block; its text."""
        language, text = self._blocks.pop(0)
        if language == "python":
            exec(text, self._names)
        else:
            path = f"{os.path.dirname(COMMAND)}:{os.environ['PATH']}"
            subprocess.run(["sh", "-e"], input=text, text=True, check=True, env=os.environ | {"PATH": path})
        return text

    def run_until(self, text):
        """Runs blocks up to the one that has this text."""
        while text not in self.run():
            pass
