"""tools/commit_message, by itself and as git's hook."""

import os
import pathlib
import subprocess
import tempfile
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
CHECK = SOURCE / "tools" / "commit_message"

GOOD = [
    "Cages keep their names\n\nThe window lost them when a file was saved twice.\n",
    "\nä" + 71 * "x" + "\n\nLetters count, not bytes.",
    "Short\n\nReason: it may begin like a trailer.\n",
    "Short\n\nThe reason.\n\nSigned-off-by: A <a@b.c>\n# Please enter the commit message\n",
    "Short\n\nThe reason.\n# ------------------------ >8 ------------------------\n" + 100 * "d" + "\n",
    "Merge branch 'fit'\n",
    'Revert "Cages keep their names"\n\nThis reverts commit 1234567.\n',
    "fixup! Cages keep their names\n",
]
BAD = {
    "# Please enter the commit message\n\n": "it is empty",
    73 * "x" + "\n\nThe reason.\n": "its subject has 73 letters; at most 72 are allowed",
    "Short\nThe reason.\n": "its second line is not empty",
    "Short\n": "it has no body",
    "Short\n\n# only what git adds\n\n": "it has no body",
    "Short\n\nSigned-off-by: A <a@b.c>\nReviewed-by: B <b@b.c>\n": "it has no body",
}


class CommitMessage(unittest.TestCase):
    def setUp(self):
        made = tempfile.TemporaryDirectory()
        self.addCleanup(made.cleanup)
        self.folder = pathlib.Path(made.name)

    def run_check(self, argument):
        return subprocess.run([CHECK, argument], cwd=self.folder, capture_output=True, text=True)

    def test_good_messages_pass(self):
        for message in GOOD:
            with self.subTest(message):
                (self.folder / "message").write_text(message)
                done = self.run_check("message")
                self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_bad_messages_are_refused(self):
        for message, problem in BAD.items():
            with self.subTest(message):
                (self.folder / "message").write_text(message)
                done = self.run_check("message")
                self.assertEqual(done.returncode, 1)
                self.assertIn(problem, done.stderr)

    def test_git_calls_it(self):
        environment = {name: value for name, value in os.environ.items() if not name.startswith("GIT_")}

        def git(*words):
            return subprocess.run(["git", "-c", "user.name=A", "-c", "user.email=a@b.c", "-c",
                                   f"core.hooksPath={SOURCE}/tools/hooks", *words], cwd=self.folder,
                                  env=environment, capture_output=True, text=True)

        git("init", "-q")
        self.assertNotEqual(git("commit", "-q", "--allow-empty", "-m", "Short").returncode, 0)
        for name in "ab":
            done = git("commit", "-q", "--allow-empty", "-m", name, "-m", "The reason.")
            self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.run_check("HEAD~1..HEAD").returncode, 0)
        git("commit", "-q", "--allow-empty", "--no-verify", "-m", "Short")
        done = self.run_check("HEAD~2..HEAD")
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr.count("\n"), 1)


if __name__ == "__main__":
    unittest.main()
