"""What docs/user/GUIDE.md says is what happens. VDBCAGE_TAKE_PICTURES=1 puts its pictures into docs/pictures/."""

import os
import pathlib
import re
import shutil
import struct
import tempfile
import unittest

from guide import Guide
from support import SOURCE, commands, options

PICTURES = SOURCE / "docs/pictures"


def size(picture):
    """Width and height of a PNG."""
    head = picture.read_bytes()[:24]
    assert head[:8] == b"\x89PNG\r\n\x1a\n", picture
    return struct.unpack(">II", head[16:])


def without_seconds(text):
    return re.sub(r", \d+\.\d+ s$", ", … s", text, flags=re.MULTILINE)


class Followed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.guide = Guide()
        cls.files = cls.guide.follow(pathlib.Path(folder.name))
        if os.environ.get("VDBCAGE_TAKE_PICTURES") == "1":
            for shown, made in cls.guide.pictures().items():
                shutil.copy(cls.files / made, PICTURES / shown)

    def test_commands_print_what_is_shown(self):
        shown = [step for step in self.guide.steps() if step.shown is not None]
        self.assertGreater(len(shown), 20)
        for step in shown:
            with self.subTest(step.command):
                self.assertEqual(without_seconds(step.printed), step.shown)

    def test_files_are_made(self):
        named = {name for step in self.guide.steps() for name in step.files()}
        self.assertGreater(len(named), 30)
        for name in named:
            with self.subTest(name):
                self.assertTrue((self.files / name).exists())

    def test_pictures_are_those_that_the_commands_make(self):
        pictures = self.guide.pictures()
        self.assertEqual(set(pictures), {path.name for path in PICTURES.glob("guide_*.png")})
        for shown, made in pictures.items():
            with self.subTest(shown):
                self.assertEqual(size(PICTURES / shown), size(self.files / made))
                self.assertLess((PICTURES / shown).stat().st_size, 250_000)

    def test_options_of_the_text_are_options(self):
        known = set().union(*(options(name) for name in commands()))
        named = set(re.findall(r"--[a-z]+(?:-[a-z]+)*", self.guide.prose()))
        self.assertGreater(len(named), 10)
        self.assertEqual(named - known, set())


if __name__ == "__main__":
    unittest.main()
