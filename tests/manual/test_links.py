"""Links between the documents, and to their pictures."""

import re
import unittest

from support import SOURCE


def documents():
    found = [*SOURCE.glob("*.md"), *SOURCE.glob("docs/*.md"), *SOURCE.glob("data/*.md")]
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


class Links(unittest.TestCase):
    def test_what_they_lead_to_is_there(self):
        count = 0
        for document in documents():
            for target in re.findall(r"\]\(([^)\s]+)\)", without_code(document.read_text())):
                if re.match(r"[a-z]+:", target):
                    continue
                count += 1
                path, _, anchor = target.partition("#")
                file = document.parent / path if path else document
                with self.subTest(f"{document.name}: {target}"):
                    self.assertTrue(file.exists())
                    if anchor:
                        self.assertIn(anchor, anchors(file))
        self.assertGreater(count, 50)

    def test_pictures_are_shown_somewhere(self):
        shown = {path for document in documents()
                 for path in re.findall(r"\]\((?:docs/)?(\w+\.png)\)", document.read_text())}
        self.assertEqual({path.name for path in SOURCE.glob("docs/*.png")} - shown, set())


if __name__ == "__main__":
    unittest.main()
