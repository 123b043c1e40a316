"""What the tests have in common."""

import os
import pathlib
import subprocess
import tempfile
import unittest

import vdbcage

SOURCE = pathlib.Path(os.environ["VDBCAGE_SOURCE"])
COMMAND = os.environ["VDBCAGE_COMMAND"]
CREATURE = SOURCE / "data" / "creature.obj"
BISHOP = SOURCE / "data" / "bishop.obj"
SHELL = SOURCE / "data" / "open_shell.obj"


def command(*words):
    """Runs the command vdbcage."""
    subprocess.run([COMMAND, *map(str, words)], check=True, stdin=subprocess.DEVNULL)


class Case(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def refuses(self, text, function, *args, error=vdbcage.InputError, **kwargs):
        """The call raises `error` with this text in its one line."""
        with self.assertRaises(error) as caught:
            function(*args, **kwargs)
        self.assertIn(text, str(caught.exception))
        self.assertNotIn("\n", str(caught.exception))
