"""docs/user/GUIDE.md, followed as a reader does: block after block, in one shell."""

import os
import pathlib
import re
import shutil
import subprocess

from support import SOURCE


class Shell:
    """A bash that ends at the first command that fails."""

    def __init__(self, folder):
        self._bash = subprocess.Popen(["bash"], cwd=folder, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                      stderr=subprocess.STDOUT)
        self._write("set -e -o pipefail\n")

    def _write(self, text):
        self._bash.stdin.write(text.encode())
        self._bash.stdin.flush()

    def run(self, command):
        """What the command prints, on both streams. It must succeed."""
        self._write(f"{{ {command}\n}} </dev/null; printf '\\0'\n")
        printed = bytearray()
        while (byte := self._bash.stdout.read(1)) != b"\0":
            assert byte, f"{command}\nfailed with exit status {self._bash.wait()}:\n{printed.decode()}"
            printed += byte
        return printed.decode()

    def close(self):
        self._bash.communicate()


class Step:
    """A command with what the page shows of its output, or None where it shows none, and what it printed."""

    def __init__(self, command, shown):
        self.command, self.shown, self.printed = command, shown, None

    def files(self):
        """What it is said to write. Names with a variable of a loop are not known here."""
        return re.findall(r"(?:-o|>) (\w+\.\w+)", self.command) + re.findall(r"--stages (\w+)", self.command)


class Guide:
    """The page's text and its blocks: lists of steps.

    A block of `sh` is commands. In one of `console` commands stand behind `$ `, and all that they print below.
    """

    def __init__(self):
        self.text = (SOURCE / "docs/user/GUIDE.md").read_text()
        self.blocks = []
        for language, body in re.findall(r"^```(\w*)\n(.*?)^```$", self.text, re.MULTILINE | re.DOTALL):
            assert language in ("sh", "console"), f"nothing runs a block of '{language}'"
            if language == "sh":
                self.blocks.append([Step(body, None)])
            else:
                parts = re.split(r"^\$ ((?:.*\\\n)*.*)\n", body, flags=re.MULTILINE)
                assert parts[0] == "", f"output without a command: {parts[0]}"
                self.blocks.append([Step(*pair) for pair in zip(parts[1::2], parts[2::2])])

    def steps(self):
        return [step for block in self.blocks for step in block]

    def pictures(self):
        """The pictures that are made by the page's commands: name in docs/pictures/ -> name that the commands give it."""
        return {f"guide_{name}": name for name in re.findall(r"!\[[^]]+\]\(\.\./pictures/guide_(\w+\.png)\)", self.text)}

    def prose(self):
        return re.sub(r"^```.*?^```$", "", self.text, flags=re.MULTILINE | re.DOTALL)

    def follow(self, folder):
        """Runs all blocks in a folder that looks like the project's with its build. The folder of their files."""
        commands = pathlib.Path(shutil.which("vdbcage")).parent
        (folder / "build/release").mkdir(parents=True)
        (folder / "data").symlink_to(SOURCE / "data")
        (folder / "build/release/bin").symlink_to(commands)
        (folder / "build/release/data").symlink_to(os.environ["VDBCAGE_MODELS"])
        if os.environ["VDBCAGE_HAS_GPL_PART"] != "1":
            self.blocks = [block for block in self.blocks
                           if not any("vdbcage repair" in step.command for step in block)]
        shell = Shell(folder)
        try:
            for step in self.steps():
                step.printed = shell.run(step.command)
            return pathlib.Path(shell.run("pwd").strip())
        finally:
            shell.close()
