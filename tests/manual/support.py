"""The command, as users call it from a shell."""

import os
import pathlib
import re
import subprocess

SOURCE = pathlib.Path(os.environ["VDBCAGE_SOURCE"])


def output(*words):
    """What a command prints. It must succeed and print nothing to standard error."""
    done = subprocess.run(words, capture_output=True, text=True)
    assert done.returncode == 0 and not done.stderr, (words, done.returncode, done.stderr)
    return done.stdout


def commands():
    """The names that the help lists."""
    names = re.findall(r"^  ([a-z]+)  +[a-z]", output("vdbcage", "--help"), re.MULTILINE)
    assert len(names) > 5, names
    return names


def options(command):
    """The long options that the help lists, the rarer ones too."""
    text = output("vdbcage", command, "--help")
    if "--help-all" in text:
        text += output("vdbcage", command, "--help-all")
    found = set(re.findall(r"^  (?:-[a-z] )?(--[a-z-]+)", text, re.MULTILINE))
    assert "--threads" in found, found
    return found | {"--help"}
