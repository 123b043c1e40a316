"""Links between the documents, and to their pictures."""

import os
import pathlib
import re
import unittest

from support import SOURCE


INSTALLED = pathlib.Path(os.environ["VDBCAGE_MODELS"]).parent / "documents"  # by cmake/Install.cmake, without pictures


def documents():
    found = [*SOURCE.glob("*.md"), *SOURCE.glob("docs/**/*.md"), *SOURCE.glob("data/*.md")]
    assert len(found) > 10, found
    return found


def without_code(text):
    """The document without its blocks of code, where brackets mean something else."""
    text = re.sub(r"^( *)```.*?^\1```$", "", text, flags=re.MULTILINE | re.DOTALL)
    return re.sub(r"`[^`\n]*`", lambda code: code[0].replace("[", "("), text)


def anchors(document):
    """The anchors that GitHub gives to the headings."""
    found = set()
    for heading in re.findall(r"^#+ +(.+)$", without_code(document.read_text()), re.MULTILINE):
        text = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading).strip().lower()
        anchor = re.sub(r"[^\w\- ]", "", text).replace(" ", "-")
        same = [other for other in found if re.fullmatch(re.escape(anchor) + r"(-\d+)?", other)]
        found.add(f"{anchor}-{len(same)}" if same else anchor)
    return found


def links(document):
    """Where its links lead that are not to the web: (the link, file, anchor or an empty text)."""
    for target in re.findall(r"\]\(([^)\s]+)\)", without_code(document.read_text())):
        if not re.match(r"[a-z]+:", target):
            path, _, anchor = target.partition("#")
            yield target, document.parent / path if path else document, anchor


class Links(unittest.TestCase):
    def test_what_they_lead_to_is_there(self):
        count = 0
        for document in documents():
            for target, file, anchor in links(document):
                count += 1
                with self.subTest(f"{document.name}: {target}"):
                    self.assertTrue(file.exists())
                    if anchor:
                        self.assertIn(anchor, anchors(file))
        self.assertGreater(count, 50)

    def test_pictures_are_shown_somewhere(self):
        shown = {file.name for document in documents() for _, file, _ in links(document)}
        self.assertEqual({path.name for path in SOURCE.glob("docs/pictures/*.png")} - shown, set())

    def test_they_hold_where_documents_are_installed(self):
        pages = [*INSTALLED.glob("**/*.md")]
        self.assertEqual(len(pages), len([*SOURCE.glob("docs/**/*.md")]) + 1)
        pictures = {INSTALLED / "docs" / path.name for path in SOURCE.glob("docs/pictures/*.png")}
        missing = {file.resolve().relative_to(INSTALLED.resolve()) for page in pages for _, file, _ in links(page)
                   if not file.exists() and file not in pictures}
        self.assertEqual({path.parts[0] for path in missing},
                         {"CHANGELOG.md", "CITATION.cff", "CONTRIBUTING.md", "data", "examples", "tests"})


if __name__ == "__main__":
    unittest.main()
