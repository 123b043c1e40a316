"""What the tests have in common: models, the recipes of docs/user/FARMS.md, and what became of the jobs."""

import csv
import os
import pathlib
import re
import shutil
import subprocess
import unittest

from processes import FOLDER

SOURCE = pathlib.Path(os.environ["VDBCAGE_SOURCE"])
COMMAND = pathlib.Path(os.environ["VDBCAGE_COMMAND"])
MODELS = pathlib.Path(os.environ["VDBCAGE_MODELS"])
# Nothing of the user's own, nor of a farm that runs these tests.
ENVIRONMENT = {"PATH": f"{COMMAND.parent}:{os.environ['PATH']}:/usr/sbin", "HOME": str(FOLDER / "home"),
               "TMPDIR": str(FOLDER), "SHELL": "/bin/sh", "LC_ALL": "C.UTF-8"}
GOOD = ("bishop", "botijo", "creature", "open_shell", "soup")
BAD = "bench"  # cut off; whole it is the sixth
QUICK = "-o cages --faces 60 --effort fast"


def recipe(section):
    """The blocks of code of a section of docs/user/FARMS.md, as a reader would take them."""
    text = (SOURCE / "docs/user/FARMS.md").read_text().split(f"\n## {section}\n")[1].split("\n## ")[0]
    blocks = re.findall(r"(?:^    .*\n|^\n(?=    ))+", text, re.M)
    return [re.sub("^    ", "", block, flags=re.M).strip() + "\n" for block in blocks]


def changed(text, old, new):
    """The text with another word in it."""
    assert text.count(old) == 1, (text, old)
    return text.replace(old, new)


class Case(unittest.TestCase):
    environment = ENVIRONMENT

    def setUp(self):
        self.folder = FOLDER / self._testMethodName
        self.cages = self.folder / "cages"
        (self.folder / "assets").mkdir(parents=True)
        for name in GOOD:
            shutil.copy(MODELS / f"{name}.obj", self.folder / "assets")
        (self.folder / "assets" / f"{BAD}.obj").write_bytes((MODELS / f"{BAD}.obj").read_bytes()[:1000])

    def mend(self):
        shutil.copy(MODELS / f"{BAD}.obj", self.folder / "assets")

    def run_shell(self, text, folder=None):
        """Runs a script in the case's folder; output and errors are one text."""
        return subprocess.run(["timeout", "--kill-after=5", "300", "sh", "-c", text], cwd=folder or self.folder,
                              env=self.environment, text=True, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT)

    def shell(self, text, folder=None):
        """Its output; it must succeed."""
        done = self.run_shell(text, folder)
        self.assertEqual(done.returncode, 0, done.stdout)
        return done.stdout

    def expect_cages(self, names):
        """The folder has these cages and no others, the same as without a farm, and certified."""
        local = self.folder / "local"
        if not local.exists():
            local.mkdir()
            (local / "assets").symlink_to(MODELS)
            models = " ".join(f"assets/{name}.obj" for name in (*GOOD, BAD))
            self.shell(f"vdbcage jobs {models} {QUICK} > jobs.txt && sh -e jobs.txt", local)
        self.assertEqual(sorted(file.stem for file in self.cages.glob("*.obj")), sorted(names))
        for name in names:
            cage, expected = (folder / "cages" / f"{name}.obj" for folder in (self.folder, local))
            self.assertEqual(cage.read_bytes(), expected.read_bytes(), name)
            self.assertIn('"bounding": true', (self.cages / f"{name}.json").read_text())

    def expect_bad_first(self):
        """The table, the CSV file and the page tell of the bad model before all others."""
        told = self.run_shell("vdbcage report cages --csv all.csv --html all.html")
        self.assertEqual(told.returncode, 2)
        lines = told.stdout.splitlines()
        self.assertRegex(lines[1], f"^{BAD} +FAILED +1  assets/{BAD}.obj: line ")
        self.assertEqual(lines[-1], "6 jobs: 5 certified, 1 failed")
        with open(self.folder / "all.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["status"] for row in rows], ["1"] + 5 * ["0"])
        self.assertEqual(rows[0]["models"], f"assets/{BAD}.obj")
        page = (self.folder / "all.html").read_text()
        self.assertEqual(min((*GOOD, BAD), key=lambda name: page.index(f">{name}<")), BAD)

    def results(self):
        """Which files there are of the good models: a file that was written again is another."""
        files = [self.cages / f"{name}.{kind}" for name in GOOD for kind in ("obj", "json")]
        return [(file.name, file.stat().st_ino, file.stat().st_mtime_ns) for file in files]
