"""docs/user/ERRORS.md: it has all messages and no others, and each comes as it says."""

import concurrent.futures
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

import error_rows
from error_rows import FOLDER, PIPE, READ_ONLY
from support import SOURCE
from thrown_texts import Sources

ROOMS = ["vdbcage", "tools/cli", "tools/report", "tools/files", "tools/draw"]

# Messages of the page that no row causes, with why not.
NOT_CAUSED = {
    "needs more memory than a test may take": {
        "FILE: an STL file cannot hold N triangles",
        "FILE: it has N points; at most N are supported",
        "N triangles are too many; at most N are allowed",
        "FILE: N points times N handles do not fit in a weights file, which must be smaller than 2 GiB",
        "picture: cannot be written as PNG: REASON",
    },
    "another process has to change files at the right moment; tests/core/test_atomic_file.cpp does so": {
        "FILE: cannot be written: the stream failed",
        "FILE: cannot be written: another process took the temporary file FILE away",
        "FILE: cannot be written: REASON; FILE was made",
        "FILE: cannot be written: REASON; FILE was replaced, what it held is in FILE",
        "FILE: N positions were given; FILE has N points",
    },
    "would be a defect of vdbcage, and none is known": {
        "the cage could not be certified; this is a defect of vdbcage, please report the model",
        "convex hull: REASON",
    },
    "the driver has to be broken or old, or there have to be threads for all but the driver": {
        "OpenGL: its threads cannot be started: REASON",
        "OpenGL: EGL cannot initialize the device (WORD)",
        "OpenGL: EGL cannot make its context current (WORD)",
        "OpenGL: EGL: the device lacks WORD",
        "OpenGL: EGL has neither a hardware device nor displays without a surface",
        "OpenGL: OSMesa cannot make its context current",
        "OpenGL: this context has version N.N; 4.5 is needed",
        "OpenGL: this context has no NAME",
        "OpenGL failed while WHAT: REASON",
        "OpenGL: the device has too small buffers for a plane of this many voxels",
        "OpenGL: this framebuffer cannot be drawn into (status N)",
        "NAME: does not compile: REASON",
        "NAME: does not link: REASON",
    },
    "the programs of tools/release have to run on another machine; tests/release/launcher.sh pretends that they do": {
        "these programs are for processors of the kind x86_64; this one is WORD",
        "these programs need glibc N or later; this system has WORD",
    },
    "signals come at any time; tests/cli/test_faults.cpp sends them": {
        "cancelled",
    },
}

# What is thrown, but not at a user of the command, with why not: the first words of it. The reference has these errors.
LIBRARY_ONLY = {
    "the command reads meshes from files, which have points for all faces, finite ones": [
        "a face uses point", "point … is (…, …, …); coordinates must be finite",
        "point … is …; coordinates must be finite", "picture: point … is not finite",
        "posed points: point … is not finite", "model: its faces have no area",
        "model: its coordinates are not within the range of float",
        "the surface to decimate: its coordinates are too large to subtract",
    ],
    "the command hands on as many values as there are points": [
        "colours were given; the mesh has", "it has … points; … has …", "posed points: there are",
        "model: it has … points; the binding has", "weights: there are …; … points and",
        "there are … values for … points", "picture: … points were given", "picture: … … were given",
        "a layer has … colours of points", "loose points: there is no point",
    ],
    "the command makes the surfaces, voxels and planes that it works on": [
        "surface: ", "the surface is not a 2-manifold", "has no length", "has two faces on the same side", "axis: …",
        "symmetry axis: …", "the mask has active voxels near", "convex hull: a mask of",
        "model: its bounding box is not within the box given for the voxels",
    ],
    "the command looks at its options and files before": [
        "kept points: … is not allowed",
        "faces: … is not allowed; a closed surface", "decimation: faces is", "there is no option '…'; there are:",
        "is … voxels; it must be between 0 and", "is …; it must be …", "the cube has one radius everywhere",
        "is not at a finite place", "has an axis without length", "coordinates: 'given' weights were made elsewhere",
        "inversions: the binding's weights were made elsewhere", "weights: …", "it is not a NumPy file",
        "repair: this build was made without VDBCAGE_WITH_CGAL_GPL", "its … is … pixels; 1 to … is allowed",
        "is …; 0 to 1 is allowed", "there is nothing to show", "it has … columns; 0 or more are allowed",
        "a panel has nothing to show", "a layer has no mesh", "view: ",
    ],
    "programs that draw by themselves can use contexts wrongly": [
        "OpenGL: a context is already current", "OpenGL: an EGL context is already current",
        "OpenGL: an OSMesa context is already current", "OpenGL: the context is in use on another thread",
        "OpenGL: a device turned out to be software", "OpenGL: the program has no uniform",
    ],
    "only the window and tests read pictures, or make them of other bytes": [
        "picture: it has … x … pixels and … bytes", "picture: it has … pixels and alpha",
    ],
}

# Files that throw what other errors said, with more about it. In any other the scanner would miss words.
HAND_ERRORS_ON = {
    "vdbcage/core/error.h", "vdbcage/core/error.cpp", "vdbcage/core/detail/atomic_file.cpp",
    "vdbcage/gl/offscreen.cpp", "vdbcage/pipeline/options.cpp", "tools/files/naming_files.h",
    "tools/cli/command_line.cpp", "tools/cli/commands/render.cpp",
}

NUMBER = r"(?:[-+]?[0-9][-+.0-9e]*|-?nan|-?inf)"


def messages():
    lines = (SOURCE / "docs/user/ERRORS.md").read_text().splitlines()
    return [line[4:] for line in lines if line.startswith("    ")]


def printed(message):
    """What a message of the page looks like, as a regular expression."""
    return re.sub(r"\b(N|FILE|FOLDER|WORD|NAME|WHAT|RANGE|REASON)\b", lambda name: NUMBER if name[1] == "N" else ".*",
                  re.escape(message))


def launcher_messages():
    """Those of the script that starts the programs of tools/release, as they stand on the page."""
    texts = re.findall(r'"(these programs [^"]*)"', (SOURCE / "tools/release_files/launcher").read_text())
    return {re.sub(r"\$\w+", "WORD", re.sub(r"2\.\$\w+", "N", text)) for text in texts}


def flat(lists):
    return [item for items in lists.values() for item in items]


class Page(unittest.TestCase):
    def test_it_has_what_the_sources_throw(self):
        sources, page = Sources(SOURCE, ROOMS), messages()
        self.assertGreater(len(sources.thrown), 300)
        self.assertEqual(sources.wordless, HAND_ERRORS_ON)
        self.assertEqual(len(page), len(set(page)), "a message stands there twice")
        found, missing, library_only = launcher_messages(), [], set()
        for thrown in sources.thrown:
            told = {message for message in page if sources.tells(message, thrown)}
            found |= told
            if told:
                continue
            words = [words for words in flat(LIBRARY_ONLY) if thrown.words().lstrip("…: ").startswith(words)]
            library_only.update(words)
            if not words:
                missing.append(f"{thrown.where}: {thrown.words()}")
        missing += launcher_messages() - set(page)
        self.assertEqual(missing, [], "these need a remedy on the page")
        self.assertEqual(set(page) - found, set(), "the sources have no such messages")
        self.assertEqual(set(flat(LIBRARY_ONLY)) - library_only, set(), "the sources have no such texts")

    def test_each_message_has_a_remedy(self):
        blocks = (SOURCE / "docs/user/ERRORS.md").read_text().split("\n\n")
        for block, after in zip(blocks, [*blocks[1:], ""]):
            if block.startswith("    "):
                self.assertRegex(after.strip(), r"(?s)^[^ #].*[.?]$", block)


def snapshot(folder):
    """Names of what is in a folder, with the bytes of small files."""
    return {path: path.read_bytes() if path.is_file() and path.stat().st_size < 1 << 20 else b""
            for path in sorted(folder.rglob("*"))}


class Rows(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        made = tempfile.TemporaryDirectory()
        cls.addClassCleanup(made.cleanup)
        cls.folder = pathlib.Path(made.name)
        cls.folder.chmod(0o755)
        # Where everybody may run it.
        cls.command = shutil.copy(shutil.which("vdbcage"), cls.folder)
        for name, content in error_rows.COMMON.items():
            (cls.folder / name).write_text(content)
        subprocess.run([cls.command, "bind", "cage.obj", "model.obj", "-q", "-o", "w.npy"], cwd=cls.folder, check=True)
        cls.rows = error_rows.all_rows((cls.folder / "w.npy").read_bytes())

    def run_row(self, number, row):
        """What is wrong with it, if anything."""
        folder = self.folder / str(number)
        for name, content in row.files.items():
            path = folder / name
            path.parent.mkdir(parents=True, exist_ok=True)
            if content is FOLDER:
                path.mkdir()
            elif content is PIPE:
                os.mkfifo(path)
            elif isinstance(content, int):
                path.touch()
                os.truncate(path, content) # takes no room on the disk
            else:
                path.write_bytes(content if isinstance(content, bytes) else b"" if content is READ_ONLY
                                 else content.encode())
            if content is READ_ONLY:
                path.chmod(0o444)
        folder.chmod(0o777)
        words = [self.command, *row.words]
        if row.limits:
            words = ["bash", "-c", f'ulimit {row.limits}; exec "$@"', "bash", *words]
        if row.as_nobody and os.geteuid() == 0:
            words = ["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups", *words]
        before = snapshot(folder)
        environment = {name: value for name, value in os.environ.items() if name != "DISPLAY"} | row.environment
        with open(row.output or os.devnull, "w", encoding="utf-8") as output:
            done = subprocess.run(words, cwd=folder, env=environment, stdout=output, stderr=subprocess.PIPE, text=True,
                                  errors="replace")
        start = "vdbcage: error: "
        said = done.stderr[len(start):-1]
        # Of OpenGL there is one for each way that was tried.
        parts = re.split("; (?=OpenGL)", said) if row.message.startswith("OpenGL") else [said]
        right = done.stderr.startswith(start) and done.stderr.endswith("\n") and "\n" not in said and \
            done.returncode == row.status and any(re.fullmatch(printed(row.message), part) for part in parts)
        left = snapshot(folder)
        shutil.rmtree(folder)
        if right and left == before:
            return None
        return f"{row.message}\n  exit status {done.returncode}: {done.stderr}" + \
            ("" if left == before else f"  left behind: {[str(path) for path in left.keys() ^ before.keys()]}\n")

    def test_each_row_gives_its_message(self):
        # Sanitizers take all of the memory's addresses.
        rows = [row for row in self.rows if "-v" not in row.limits or os.environ["VDBCAGE_HAS_SANITIZER"] == "0"]
        if os.environ["VDBCAGE_HAS_GPL_PART"] == "0":
            rows += error_rows.WITHOUT_GPL_PART
        if os.environ["VDBCAGE_HAS_OSMESA"] == "0":
            rows = [row for row in rows if not row.message.startswith("OpenGL: OSMesa")]
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            wrong = [text for text in pool.map(self.run_row, range(len(rows)), rows) if text]
        if wrong:
            self.fail("\n" + "\n".join(wrong))

    def test_each_message_has_a_row(self):
        caused = [row.message for row in [*self.rows, *error_rows.WITHOUT_GPL_PART]]
        self.assertEqual(set(messages()) - set(caused) - set(flat(NOT_CAUSED)), set(), "no row causes these")
        self.assertEqual({*caused, *flat(NOT_CAUSED)} - set(messages()), set(), "the page has no such messages")
        self.assertEqual(set(caused) & set(flat(NOT_CAUSED)), set())
        self.assertEqual(len(caused), len(set(caused)))


if __name__ == "__main__":
    unittest.main()
