"""Reports of the command, against the schema; and the schema, against the page that explains it."""

import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

import jsonschema

SOURCE = pathlib.Path(os.environ["VDBCAGE_SOURCE"])
PUBLISHED = json.loads((SOURCE / "docs/user/report.schema.json").read_text())
BOX = """v 0 0 0
v 2 0 0
v 2 3 0
v 0 3 0
v 0 0 5
v 2 0 5
v 2 3 5
v 0 3 5
f 1 4 3 2
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
"""


def closed(schema):
    """The schema without room for new fields, which others are to pass over: here they have to be in it."""
    if isinstance(schema, list):
        return [closed(part) for part in schema]
    if not isinstance(schema, dict):
        return schema
    parts = {name: closed(part) for name, part in schema.items()}
    return {**parts, "additionalProperties": False} if "properties" in schema else parts


SCHEMA = closed(PUBLISHED)


def properties(schema):
    """The names of all fields in it."""
    if isinstance(schema, list):
        return set().union(*map(properties, schema))
    if not isinstance(schema, dict):
        return set()
    return set(schema.get("properties", {})).union(*map(properties, schema.values()))


class Reports(unittest.TestCase):
    def setUp(self):
        made = tempfile.TemporaryDirectory()
        self.addCleanup(made.cleanup)
        self.folder = pathlib.Path(made.name)
        shutil.copy(SOURCE / "data" / "bishop.obj", self.folder)
        (self.folder / "box.obj").write_text(BOX)
        (self.folder / "open.obj").write_text(BOX[:BOX.rindex("f ")])

    def valid(self, name):
        report = json.loads((self.folder / name).read_text())
        jsonschema.Draft202012Validator(SCHEMA).validate(report)
        return report

    def run_command(self, *words, status=0):
        """The report, which must keep to the schema."""
        done = subprocess.run(["vdbcage", *words, "--report", "r.json"], cwd=self.folder, capture_output=True,
                              text=True)
        self.assertEqual(done.returncode, status, done.stderr)
        report = self.valid("r.json")
        self.assertEqual(report["arguments"], [*words[1:], "--report", "r.json"])
        self.assertEqual(report["kind"], words[0])
        self.error = done.stderr
        return report

    def sha256(self, name):
        return hashlib.sha256((self.folder / name).read_bytes()).hexdigest()

    def test_a_cage_of_quads(self):
        report = self.run_command("make", "bishop.obj", "-o", "cage.obj", "--mesh", "loops", "--faces", "60",
                                  "--threads", "1", "--effort", "fast", "--scale-field", "sphere:0,1,0,1,2", "--bounding", "on")
        self.assertEqual(report["models"][0]["sha256"], self.sha256("bishop.obj"))
        self.assertEqual(report["cage_sha256"], self.sha256("cage.obj"))
        self.assertEqual(report["threads"], 1)
        options = report["options"]
        self.assertEqual((options["faces"], options["bounding"], options["resolution"]), (60, True, "auto"))
        self.assertEqual((options["joints"], options["scale-field"]), (None, "sphere:0,1,0,1,2"))
        self.assertIsInstance(report["result"]["resolution"], int)
        self.assertEqual((report["quads"]["share"], report["quads"]["loop_share"]), (1, 1))
        self.assertEqual(sum(report["quads"]["valences"].values()), report["check"]["points"])
        self.assertTrue(report["check"]["bounding"])
        self.assertGreater(report["check"]["volume_ratio"], 1)
        self.assertIn("certify", [stage["name"] for stage in report["stages"]])

    def test_an_open_model(self):
        report = self.run_command("make", "open.obj", "-o", "cage.obj", "--faces", "20", "--effort", "fast")
        self.assertIsNone(report["check"]["volume_ratio"])
        self.assertIsNone(report["quads"])
        self.assertIsNotNone(report["result"]["ray_agreement"])

    def test_a_hollow_model(self):
        inner = [line.split() for line in BOX.splitlines()]
        points = [f"v {' '.join(str(1 + float(x) / 9) for x in line[1:])}" for line in inner if line[0] == "v"]
        faces = ["f " + " ".join(str(int(i) + 8) for i in line[:0:-1]) for line in inner if line[0] == "f"]
        (self.folder / "hollow.obj").write_text(BOX + "\n".join(points + faces) + "\n")
        asked = ["-o", "cage.obj", "--faces", "20", "--effort", "fast"]
        for name, hollows in (("box.obj", 0), ("hollow.obj", 1)):
            report = self.run_command("make", name, *asked)
            self.assertEqual(report["result"]["model_hollows"], hollows)
            self.assertEqual(report["result"]["cavities_filled"], 0)
            self.assertEqual("  1 hollow inside the model became solid\n" in self.error, hollows == 1, self.error)

    def test_symmetry_of_both_kinds(self):
        asked = ["-o", "cage.obj", "--faces", "20", "--effort", "fast", "--symmetry"]
        report = self.run_command("make", "box.obj", *asked, "x")
        self.assertEqual(report["result"]["symmetry"]["axis"], "x")
        # Twice as wide at the back, and turned.
        lines = [line.split() for line in BOX.splitlines()]
        points = [[float(x) for x in line[1:]] for line in lines if line[0] == "v"]
        turned = [(0.8 * x - 0.6 * y, 0.6 * x + 0.8 * y, z * (1 if y == 0 else 0.5)) for x, y, z in points]
        text = "".join(f"v {x} {y} {z}\n" for x, y, z in turned) + BOX[BOX.index("f "):]
        (self.folder / "turned.obj").write_text(text)
        report = self.run_command("make", "turned.obj", *asked, "auto")
        self.assertIsNone(report["result"]["symmetry"]["axis"])
        self.assertEqual(len(report["result"]["symmetry"]["normal"]), 3)

    def test_several_models(self):
        report = self.run_command("make", "box.obj", "open.obj", "-o", "cage.obj", "--faces", "20", "--effort", "fast")
        self.assertEqual([model["file"] for model in report["models"]], ["box.obj", "open.obj"])
        self.assertTrue(report["models"][1]["check"]["bounding"])

    def test_warnings_of_odd_files(self):
        points, faces = BOX.count("v "), BOX.count("f ")
        (self.folder / "odd.obj").write_text(f"OFF\n{points} {faces} 0\n{BOX}")
        warning = "line 1: the header of an OFF file comes before the OBJ file; it is passed over"
        report = self.run_command("make", "odd.obj", "-o", "cage.obj", "--faces", "20", "--effort", "fast")
        self.assertEqual(report["models"][0]["warnings"], [warning])
        report = self.run_command("check", "odd.obj", "box.obj", status=2)
        self.assertEqual((report["cage_warnings"], report["models"][0]["warnings"]), ([warning], []))
        if os.environ["VDBCAGE_HAS_GPL_PART"] == "1":
            self.assertEqual(self.run_command("repair", "odd.obj", "-o", "mended.obj")["cage_warnings"], [warning])

    def test_a_failure(self):
        (self.folder / "bad.obj").write_text("v 0 0 0\nf 1 2 3\n")
        report = self.run_command("make", "bad.obj", "-o", "cage.obj", status=1)
        self.assertEqual(report["models"], [{"file": "bad.obj"}])
        self.assertEqual(self.error, f"vdbcage: error: {report['error']}\n")
        self.assertEqual((report["exit_status"], report["check"], report["seconds"]), (1, None, None))

    def test_a_cancelled_run(self):
        words = ["vdbcage", "make", "box.obj", "-o", "cage.obj", "--effort", "best", "--resolution", "400",
                 "--progress", "lines", "--report", "run.json"]
        process = subprocess.Popen(words, cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        process.stdout.readline()  # it works
        process.terminate()
        _, self.error = process.communicate()
        self.assertEqual(process.returncode, 143, self.error)
        report = self.valid("run.json")
        self.assertEqual((report["exit_status"], report["error"]), (143, "cancelled"))
        self.assertEqual(self.error, "vdbcage: error: cancelled\n")
        self.assertFalse((self.folder / "cage.obj").exists())

    def test_a_verdict(self):
        report = self.run_command("check", "box.obj", "box.obj", status=2)
        self.assertFalse(report["check"]["bounding"])
        self.assertEqual(report["cage_sha256"], self.sha256("box.obj"))
        self.assertEqual(report["quads"]["corner_mean_degrees"], 0)
        self.assertIsNone(self.run_command("check", "open.obj", "box.obj", status=2)["check"]["genus"])

    def test_a_fitted_cage(self):
        (self.folder / "large.obj").write_text(BOX.replace("v 2", "v 2.1"))
        words = ("fit", "box.obj", "large.obj", "-o", "fitted.obj")
        report = self.run_command(*words)
        self.assertEqual((report["fitted"], report["exit_status"], report["error"]), ("fitted.obj", 0, None))
        self.assertEqual(report["cage_sha256"], self.sha256("box.obj"))
        self.assertTrue(report["check"]["bounding"])
        held = self.run_command(*words, "--keep", "points:0-7", status=1)
        self.assertEqual((held["fitted"], held["exit_status"]), (None, 1))
        self.assertEqual(self.error, f"vdbcage: error: {held['error']}\n")
        self.assertNotEqual(held["inputs"], report["inputs"])

    @unittest.skipIf(os.environ["VDBCAGE_HAS_GPL_PART"] != "1", "without repair")
    def test_a_repair(self):
        report = self.run_command("repair", "open.obj", "-o", "mended.obj")
        self.assertEqual((report["valid"], report["repair"]["filled_holes"]), (True, 1))
        self.assertEqual(report["repair"]["before"]["faces"] + 2, report["repair"]["after"]["faces"])
        report = self.run_command("repair", "mended.obj", "-o", "again.obj")
        self.assertEqual(report["repair"]["before"], report["repair"]["after"])

    @unittest.skipUnless(os.environ["VDBCAGE_WINDOW"], "without the window")
    def test_what_the_window_saves(self):
        (self.folder / "s.view").write_text("open box.obj\nset faces 20\nwait\nsave-report r.json\nwait\n")
        subprocess.run([os.environ["VDBCAGE_WINDOW"], "--script", "s.view", "--without-window", "any"],
                       cwd=self.folder, check=True)
        report = json.loads((self.folder / "r.json").read_text())
        jsonschema.Draft202012Validator(SCHEMA).validate(report)
        self.assertEqual((report["arguments"], report["cage"], report["options"]["faces"]), (None, None, 20))

    def test_the_page_has_every_field(self):
        page = (SOURCE / "docs/user/REPORT.md").read_text()
        parts = {name: part for name, part in SCHEMA["$defs"].items() if name != "options"}
        for name in properties(parts) - {"name"}:
            self.assertIn(f"`{name}`", page, name)

    def test_the_page_has_every_stage(self):
        header = (SOURCE / "vdbcage" / "core" / "stages.h").read_text()
        page = (SOURCE / "docs/user/REPORT.md").read_text().split("## Stages\n")[1].split("\n## ")[0]
        stages = re.findall(r'{StageName::\w+, "([^"]+)"', header)
        self.assertEqual(re.findall(r"^\| `([^`]+)` \|", page, re.MULTILINE), stages)
        report = self.run_command("make", "box.obj", "-o", "cage.obj")
        self.assertLessEqual({stage["name"] for stage in report["stages"]}, set(stages))

    def test_the_schema_itself(self):
        jsonschema.Draft202012Validator.check_schema(SCHEMA)
        report = self.run_command("check", "box.obj", "box.obj", status=2)
        for change in [{"more": 1}, {"format": 2}, {"cage_sha256": "x"}]:
            self.assertFalse(jsonschema.Draft202012Validator(SCHEMA).is_valid({**report, **change}), change)
        self.assertTrue(jsonschema.Draft202012Validator(PUBLISHED).is_valid({**report, "more": 1}))
        del report["check"]
        self.assertFalse(jsonschema.Draft202012Validator(SCHEMA).is_valid(report))


if __name__ == "__main__":
    unittest.main()
