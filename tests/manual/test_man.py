import os
import re
import shutil
import subprocess
import tempfile
import unittest

from support import SOURCE, commands, options, output


def shown(page):
    """The page as `man` shows it on a terminal, in which nothing is bold: name of a section -> text."""
    done = subprocess.run(["mandoc", "-T", "ascii", "-O", "width=100"], input=page, capture_output=True, text=True,
                          check=True)
    text = re.sub(".\b", "", done.stdout)
    parts = re.split(r"^([A-Z][A-Z ]+)$", text, flags=re.MULTILINE)
    return {title: " ".join(body.split()) for title, body in zip(parts[1::2], parts[2::2])}


def code(page, section):
    """The lines of code of a section of a page, as they were before roff."""
    part = page[page.index(f".SH {section}\n"):].split("\n.SH ")[0]
    blocks = re.findall(r"\.EX\n(.*?)\n\.EE", part, re.DOTALL)
    return [block.replace("\\-", "-").replace("\\e", "\\") for block in blocks]


class Pages(unittest.TestCase):
    def pages(self):
        pages = {"vdbcage": output("vdbcage", "man")}
        for name in commands():
            pages["vdbcage-" + name] = output("vdbcage", "man", name)
        if os.environ["VDBCAGE_WINDOW"]:
            pages["vdbcage-view"] = output(os.environ["VDBCAGE_WINDOW"], "--man")
        return pages

    def test_mandoc_finds_nothing_wrong(self):
        for name, page in self.pages().items():
            with self.subTest(name), tempfile.NamedTemporaryFile("w", suffix=".1") as file:
                file.write(page)
                file.flush()
                lint = subprocess.run(["mandoc", "-T", "lint", file.name], capture_output=True, text=True)
                self.assertEqual(lint.stdout + lint.stderr, "")
                self.assertEqual(lint.returncode, 0)

    def test_every_page_says_what_a_page_has_to(self):
        for name, page in self.pages().items():
            with self.subTest(name):
                sections = shown(page)
                self.assertTrue(sections["NAME"].startswith(name + " - "))
                for title in ["SYNOPSIS", "DESCRIPTION", "SEE ALSO"]:
                    self.assertGreater(len(sections[title]), 5, title)
                if name != "vdbcage-view":
                    self.assertIn("75", sections["EXIT STATUS"])

    def test_every_option_is_there_with_its_help(self):
        for name in commands():
            sections = shown(output("vdbcage", "man", name))
            text = sections["OPTIONS"] + " " + sections.get("RARER OPTIONS", "")
            for option in options(name):
                self.assertRegex(text + " ", rf"(^| ){option} ", name)
        self.assertIn("--faces N Faces of the cage, at most, 4 to 1000000 [400].",
                      shown(output("vdbcage", "man", "make"))["OPTIONS"])

    def test_the_main_page_has_all_commands(self):
        text = shown(output("vdbcage", "man"))["COMMANDS"]
        self.assertEqual(re.findall(r"vdbcage-([a-z]+)\(1\)", text), commands())

    def test_the_examples_run(self):
        with tempfile.TemporaryDirectory() as folder:
            for model in ["bishop.obj", "creature.obj"]:
                shutil.copy(SOURCE / "data" / model, folder)
            os.makedirs(folder + "/.config/fish/completions")
            for name in commands():
                lines = code(output("vdbcage", "man", name), "EXAMPLES")
                self.assertTrue(lines, name)
                for line in lines:
                    if name == "repair" and os.environ["VDBCAGE_HAS_GPL_PART"] != "1":
                        continue
                    shell = "zsh" if "completion zsh" in line else "bash"
                    setup = "autoload -Uz compinit && compinit -u -D; " if shell == "zsh" else "set -o pipefail; "
                    done = subprocess.run([shell, "-c", setup + line], cwd=folder, capture_output=True, text=True,
                                          env={**os.environ, "HOME": folder, "MANPAGER": "cat"})
                    self.assertEqual(done.returncode, 0, (line, done.stderr))
                    if name == "make" and "cage.obj" in line:
                        shutil.copy(folder + "/cage.obj", folder + "/posed.obj")
            made = set(os.listdir(folder)) | set(os.listdir(folder + "/cages"))
        for file in ["cage.obj", "loops.png", "fast.json", "picture.png", "weights.npy", "moved.obj", "families.png",
                     "creature.json", "cages.html"]:
            self.assertIn(file, made)

    def test_a_command_that_is_not_there(self):
        done = subprocess.run(["vdbcage", "man", "mak"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 1)
        self.assertIn("did you mean make?", done.stderr)


if __name__ == "__main__":
    unittest.main()
