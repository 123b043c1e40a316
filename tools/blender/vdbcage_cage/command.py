# SPDX-License-Identifier: Apache-2.0 OR GPL-3.0-or-later
"""Runs the command `vdbcage`. Nothing here knows Blender.

The command is a process of its own: no matter what Python Blender has, nothing of it crashes with the work, and a
cancel is SIGTERM.
"""

import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import threading


OWN = pathlib.Path(__file__).parent / "bin" / "vdbcage"  # of the add-on that tools/release makes


class CommandError(Exception):
    """What went wrong, in one line for the user."""


def found(path, own=OWN):
    """The command: `path`, or if that is empty the add-on's `own`, or else the `vdbcage` of PATH. Raises CommandError."""
    if not path and own.exists():
        return _own(own)
    if not path:
        path = shutil.which("vdbcage")
        if path is None:
            raise CommandError("There is no command vdbcage in PATH. Set its path in the preferences of the add-on")
    elif not (os.path.isfile(path) and os.access(path, os.X_OK)):
        raise CommandError(f"{path} is not a program. Set the path of the command vdbcage in the preferences of the "
                           "add-on")
    return path


def _own(launcher):
    """The launcher. Blender unpacks files without the right to run them."""
    for program in (launcher, launcher.parent.parent / "lib" / "vdbcage" / "vdbcage"):
        if not os.access(program, os.X_OK):
            try:
                program.chmod(program.stat().st_mode | 0o111)
            except OSError as error:
                raise CommandError(f"{program} cannot be made a program: {error.strerror}. Set the path of the command "
                                   "vdbcage in the preferences of the add-on") from None
    return str(launcher)


class Job:
    """Commands that run one after the other. They share a folder for their files, which goes when the job is closed.

        with Job(temporary_folder) as job:
            job.start([[command, "make", ...], ...])
            job.wait()
    """

    _line = re.compile(r"\s*(\d+) %  (\S+)")

    def __init__(self, parent):
        """The folder is made in the folder `parent`."""
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="vdbcage_", dir=parent))
        self.stage, self.percent = "", 0
        self.said = ""  # all that the last command said besides
        self._waiting = []
        self._process = self._reader = None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def start(self, commands):
        """Starts the first of the commands; `poll` goes on. They are to be verbose (-v). Raises CommandError."""
        self._waiting = list(commands)
        self._next()

    def poll(self):
        """True when all have ended. Raises CommandError with the line that a command ended with."""
        if self._process is None:
            return True
        status = self._process.poll()
        if status is None:
            return False
        self._reader.join()
        self._process = None
        if status != 0:
            raise CommandError(self._failure(status))
        self._next()
        return self._process is None

    def wait(self):
        """Returns when all have ended. Raises CommandError."""
        while not self.poll():
            self._process.wait()

    def close(self):
        """Ends what still runs, and removes the folder."""
        self._waiting = []
        if self._process is not None:
            self._process.terminate()
            try:
                self._process.wait(5)
            except subprocess.TimeoutExpired:  # it hangs, say in a driver
                self._process.kill()
                self._process.wait()
            self._reader.join()
            self._process = None
        shutil.rmtree(self.folder, ignore_errors=True)

    def _next(self):
        if not self._waiting:
            return
        words = [os.fspath(word) for word in self._waiting.pop(0)]
        try:
            self._process = subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                             stderr=subprocess.PIPE, encoding="utf-8", errors="replace",
                                             creationflags=getattr(subprocess, "CREATE_NO_WINDOW", 0))
        except OSError as error:
            raise CommandError(f"{words[0]} could not be started: {error.strerror or error}") from None
        self.stage, self.percent, self.said = "", 0, ""
        self._reader = threading.Thread(target=self._read, args=(self._process.stderr,))
        self._reader.start()

    def _read(self, stream):
        with stream:
            for line in stream:
                progress = self._line.match(line)
                if progress:
                    self.percent, self.stage = int(progress[1]), progress[2]
                else:
                    self.said += line

    def _failure(self, status):
        lines = self.said.strip().splitlines()
        if not lines:
            return f"vdbcage ended with status {status}"
        line = lines[-1].replace("vdbcage: error: ", "", 1)
        # The user does not know where the files of the command are.
        return re.sub(rf"{re.escape(str(self.folder))}[/\\](\w+[/\\])?", "", line)
