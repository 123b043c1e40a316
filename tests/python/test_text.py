"""The examples in README.md and docs/user/PYTHON.md, and the docstrings."""

import contextlib
import inspect
import io
import os
import re

import vdbcage
from support import SOURCE, Case


class TextTest(Case):
    def run_examples(self, file):
        """Runs what stands in blocks of Python in this file, all in one go."""
        blocks = re.findall(r"^```python\n(.*?)^```$", (SOURCE / file).read_text(), re.MULTILINE | re.DOTALL)
        self.assertGreater(len(blocks), 0)
        (self.folder / "data").symlink_to(SOURCE / "data")
        before = os.getcwd()
        self.addCleanup(os.chdir, before)
        os.chdir(self.folder)
        names = {}
        with contextlib.redirect_stdout(io.StringIO()):
            for block in blocks:
                exec(compile(block, file, "exec"), names)
        return blocks, names

    def test_the_example_of_the_readme_runs(self):
        blocks, names = self.run_examples("README.md")
        self.assertEqual(len(blocks), 1)
        self.assertLessEqual(len(blocks[0].splitlines()), 10)
        self.assertTrue(names["cage"].check.bounding)
        self.assertEqual(len(vdbcage.Mesh.read(self.folder / "posed.obj")), len(names["model"]))

    def test_the_examples_of_the_page_run(self):
        self.run_examples("docs/user/PYTHON.md")

    def test_every_public_name_has_a_docstring(self):
        for name in vdbcage.__all__:
            thing = getattr(vdbcage, name)
            self.assertTrue(thing.__doc__, name)
            self.assertEqual(thing.__module__, "vdbcage")
            if inspect.isclass(thing) and not issubclass(thing, Exception):
                for member, value in vars(thing).items():
                    if not member.startswith("_") and not inspect.ismemberdescriptor(value):
                        if callable(value) or isinstance(value, (property, classmethod)):
                            self.assertTrue(inspect.getdoc(getattr(thing, member)), f"{name}.{member}")
        self.assertEqual(sorted(vdbcage.__all__), list(vdbcage.__all__))

    def test_every_public_function_tells_its_types(self):
        for name in vdbcage.__all__:
            thing = getattr(vdbcage, name)
            functions = [thing] if inspect.isfunction(thing) else [
                getattr(member, "__func__", getattr(member, "fget", member)) for key, member in vars(thing).items()
                if key == "__init__" or not key.startswith("_")]
            for function in filter(inspect.isfunction, functions):
                names = {*inspect.signature(function).parameters, "return"}
                self.assertEqual(names - {"self", "cls", *function.__annotations__}, set(), function.__qualname__)

    def test_the_version_is_that_of_the_library(self):
        header = (SOURCE / "vdbcage" / "core" / "version.h").read_text()
        self.assertIn(f'VDBCAGE_VERSION "{vdbcage.__version__}"', header)

    def test_the_change_log_and_the_citation_are_of_this_version_and_day(self):
        header = (SOURCE / "vdbcage" / "core" / "version.h").read_text()
        version, date = re.findall(r'define VDBCAGE_VERSION(?:_DATE)? "(.*)"', header)
        citation = (SOURCE / "CITATION.cff").read_text()
        self.assertIn(f"\nversion: {version}\ndate-released: {date}\n", citation)
        newest = re.search("^## (.*)$", (SOURCE / "CHANGELOG.md").read_text(), re.MULTILINE)[1]
        self.assertIn(newest, (f"{version}, {date}", "Unreleased"))
