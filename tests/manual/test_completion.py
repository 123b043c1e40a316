import functools
import os
import pathlib
import pty
import re
import select
import subprocess
import tempfile
import unittest

from support import commands, options


def bash(line, folder):
    """What bash offers for the last word of `line`. The function gets what the shell itself would give it."""
    words = [word for word in re.split(r"\s+|(=)", line) if word is not None]
    words = [word for i, word in enumerate(words) if word or i == len(words) - 1]
    script = f"source <(vdbcage completion bash); COMP_WORDS=({' '.join(repr(w) for w in words)}); " \
             f"COMP_CWORD={len(words) - 1}; _vdbcage; printf '%s\\n' \"${{COMPREPLY[@]}}\"; complete -p vdbcage"
    done = subprocess.run(["bash", "-c", script], cwd=folder, capture_output=True, text=True)
    assert done.returncode == 0 and not done.stderr, done.stderr
    *offers, registered = done.stdout.splitlines()
    assert registered == "complete -F _vdbcage vdbcage", registered
    return {offer for offer in offers if offer}


def fish(line, folder):
    """What fish offers, without what it tells of each."""
    script = f"vdbcage completion fish | source; complete -C {line!r}"
    done = subprocess.run(["fish", "--no-config", "-c", script], cwd=folder, capture_output=True, text=True,
                          env={**os.environ, "HOME": str(folder)})
    assert done.returncode == 0 and not done.stderr, done.stderr
    offers = {offer.split("\t")[0] for offer in done.stdout.splitlines()}
    last = line.split(" ")[-1]
    # In --mesh=t it offers the whole word.
    return {offer.split("=", 1)[1] if "=" in last else offer for offer in offers}


def zsh(line, folder):
    """What zsh offers, asked as a user does: at a terminal, by the key that lists."""
    main, side = pty.openpty()
    terminal = {"HOME": str(folder), "TERM": "dumb", "COLUMNS": "200"}
    shell = subprocess.Popen(["zsh", "-f", "-i"], stdin=side, stdout=side, stderr=side, cwd=folder, close_fds=True,
                             start_new_session=True, env={**os.environ, **terminal})
    os.close(side)
    seen = ""

    def until(mark):
        nonlocal seen
        while mark not in seen:
            assert select.select([main], [], [], 60)[0], f"zsh said only {seen!r}"
            seen += os.read(main, 65536).decode()
        before, _, seen = seen.partition(mark)
        return before

    try:
        # One offer a line, to standard output, between marks that the typed words do not have.
        setup = """PS1= ; stty -echo; unsetopt zle_bracketed_paste; autoload -Uz compinit && compinit -u -D
            source <(vdbcage completion zsh)
            show() {
                compadd() {
                    builtin compadd -O offers "$@"
                    print -rl -- $offers | sed 's/^/offer:/'
                    builtin compadd "$@"
                }
                _main_complete
                print END''OFFERS
            }
            zle -C show list-choices show; bindkey '^T' show; print SET''UP"""
        os.write(main, (setup + "\n").encode())
        until("SETUP")
        os.write(main, (line + "\x14").encode())
        text = until("ENDOFFERS")
    finally:
        shell.kill()
        shell.wait()
        os.close(main)
    return set(re.findall(r"offer:(\S+)", text))


class Completions(unittest.TestCase):
    def setUp(self):
        made = tempfile.TemporaryDirectory()
        self.addCleanup(made.cleanup)
        self.folder = pathlib.Path(made.name)
        (self.folder / "model.obj").write_text("")
        (self.folder / "models").mkdir()

    def each(self):
        """The shells, as functions of the line."""
        return [functools.partial(shell, folder=self.folder) for shell in [bash, fish, zsh]]

    def test_commands(self):
        for offers in self.each():
            self.assertEqual(offers("vdbcage ma"), {"make", "man"})
            self.assertTrue(set(commands()) <= offers("vdbcage "))

    def test_options(self):
        for offers in self.each():
            self.assertEqual(offers("vdbcage make --fa"), {"--faces"})
            self.assertEqual(offers("vdbcage make model.obj --nu"), set())
            self.assertEqual(offers("vdbcage deform --nu"), {"--nu"})

    def test_every_option_of_every_command(self):
        for shell in [bash, fish]: # zsh takes a second each; it asks for the same list
            for name in commands():
                offered = shell(f"vdbcage {name} --", self.folder)
                self.assertEqual(options(name) - offered, set(), (shell.__name__, name))

    def test_words_of_an_option(self):
        for offers in self.each():
            self.assertEqual(offers("vdbcage make --mesh "), {"triangles", "triquad", "quads", "loops"})
            self.assertEqual(offers("vdbcage make --mesh q"), {"quads"})
            self.assertEqual(offers("vdbcage make --mesh=q"), {"quads"})
            self.assertEqual(offers("vdbcage bind --coordinates h"), {"harmonic"})
            self.assertEqual(offers("vdbcage man ch"), {"check"})
            self.assertEqual(offers("vdbcage completion "), {"bash", "fish", "zsh"})

    def test_files_and_folders(self):
        for offers in self.each():
            for line, names in [("vdbcage make mod", {"model.obj", "models"}),
                                ("vdbcage make -o mod", {"model.obj", "models"}),
                                ("vdbcage make --stages mod", {"models"}),
                                ("vdbcage make --faces mod", set())]:
                self.assertEqual({offer.rstrip("/") for offer in offers(line)}, names, line)

    def test_a_shell_that_is_not_known(self):
        done = subprocess.run(["vdbcage", "completion", "tcsh"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 1)
        self.assertIn("'tcsh' is neither bash nor fish nor zsh", done.stderr)


if __name__ == "__main__":
    unittest.main()
