"""tools/bench/paper.py: the page is whole; never how fast anything is."""

import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest


class Paper(unittest.TestCase):
    def test_the_paper_s_tables_are_a_page(self):
        script = pathlib.Path(os.environ["VDBCAGE_SOURCE"]) / "tools/bench/paper.py"
        voxelizers = "cpu,gl,cgal" if os.environ["VDBCAGE_HAS_GPL_PART"] == "1" else "cpu,gl"
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "paper.html"
            subprocess.run([script, "-o", file, "--programs", pathlib.Path(shutil.which("vdbcage")).parent, "--models",
                            "bishop", "--resolutions", "16,32", "--whole-runs", "32", "--divisions", "1",
                            "--voxelizers", voxelizers], check=True)
            page = file.read_text()
        self.assertEqual(len(re.findall("<h2>", page)), 8)
        # Time and memory, by resolution and by triangles. Resolutions, smoothing, meshes, poses of two cages.
        self.assertEqual(len(re.findall('src="data:image/svg[+]xml;base64,', page)), 2)
        self.assertEqual(len(re.findall('src="data:image/png;base64,iVBORw0KGgo', page)), 5)
        tables = re.findall("<table>.*?</table>", page, re.DOTALL)
        self.assertEqual(len(tables), 9)
        for table in tables:
            head, *rows = re.findall("<tr>(.*?)</tr>", table, re.DOTALL)
            self.assertTrue(rows, table)
            for row in rows:
                self.assertEqual(row.count("<td"), head.count("<th"), row)
        # A number that was published, and that bounding cages are certified.
        self.assertIn('<td class="number">0.97</td>', page)
        bounding = re.findall(">bounding</td>.*?</tr>", page)
        self.assertEqual(len(bounding), 1 + 3 + 2)
        for row in bounding:
            self.assertIn(">certified</td>", row)

    def test_whole_runs_are_refused_where_none_would_be_made(self):
        script = pathlib.Path(os.environ["VDBCAGE_SOURCE"]) / "tools/bench/paper.py"
        done = subprocess.run([script, "-o", "paper.html", "--whole-runs", "8"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn("--whole-runs: 8 is not allowed; it must be 32 or more", done.stderr)
        self.assertFalse(pathlib.Path("paper.html").exists())


if __name__ == "__main__":
    unittest.main()
