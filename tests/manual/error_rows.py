"""What causes each message of docs/user/ERRORS.md: a command line in a folder, and the files that it needs."""

import json
import struct
import zlib

from volumes import floats, frustum, grid, mask, node, one, scale_map, text, tile, tree, volume

TETRAHEDRON = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n"
CORNERS = [(x, y, z) for x in (-1, 2) for y in (-1, 2) for z in (-1, 2)]
BOX_FACES = "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n"


def obj(points, faces):
    return "".join("v %r %r %r\n" % tuple(p) for p in points) + faces


BOX = obj(CORNERS, BOX_FACES)
FOLDER, PIPE, READ_ONLY = object(), object(), object() # instead of the bytes of a file
COMMON = {"model.obj": TETRAHEDRON, "cage.obj": BOX}


class Row:
    def __init__(self, message, words, files=None, status=1, environment=None, limits="", output=None, as_nobody=False):
        self.message = message
        self.words = words.split() if isinstance(words, str) else words
        self.files = {**COMMON, **(files or {})}
        self.status = status
        self.environment = environment or {}
        self.limits = limits         # options of ulimit, in a shell
        self.output = output         # where standard output goes
        self.as_nobody = as_nobody   # for whom permissions mean something: root may do anything


def reading(extension, *pairs):
    """Rows of models that cannot be read: message without what names file, and the file's bytes."""
    return [Row("FILE: " + message, f"check bad.{extension} model.obj", {f"bad.{extension}": content})
            for message, content in pairs]


def make(message, words, files=None, **more):
    return Row(message, "make model.obj -o new.obj --effort fast --faces 20 --resolution 16 " + words, files, **more)


# ---- Models

POINTS = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
OFF_POINTS = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n"
FACET = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
XYZ = "property float x\nproperty float y\nproperty float z\n"
SPLATS = ["f_dc_0", "f_dc_1", "f_dc_2", "opacity", "scale_0", "scale_1", "scale_2", "rot_0", "rot_1", "rot_2", "rot_3"]
CORNER_LIST = "property list uchar int vertex_indices\n"


def ply(body, vertices=3, faces=1, form="ascii", of_vertex=XYZ, of_face=CORNER_LIST):
    head = f"ply\nformat {form} 1.0\nelement vertex {vertices}\n{of_vertex}element face {faces}\n{of_face}end_header\n"
    return head + body if isinstance(body, str) else head.encode() + body


def binary_ply(values, rest, **more):
    return ply(struct.pack(f"<{len(values)}f", *values) + rest, form="binary_little_endian", **more)


def binary_stl(count, corners):
    return b"h" * 80 + struct.pack("<I", count) + (struct.pack("<12f2x", 0, 0, 0, *corners) if corners else b"")


CORNERS_OF_ONE = [0, 0, 0, 1, 0, 0, 0, 1, 0]

MODELS = [
    *reading("obj",
             ("the file is empty; copy or export it again", ""),
             ("it has no faces; at least one is needed", POINTS),
             ("every face is degenerate (its corners are on a line); at least one must have an area",
              "v 0 0 0\nv 1 1 1\nv 3 3 3\nf 1 2 3\n"),
             ("line N: WHAT is missing; add it, or export the file again", "v 0 0\nv 1 0 0\n"),
             ("line N: WHAT is WORD, which is not a number; numbers are written like 12, -0.5 and 3e-2", "v 0,5 0 0\n"),
             ("line N: the integer WORD is too large; it must be below 2^63", POINTS + "f 1 2 99999999999999999999\n"),
             ("line N: WHAT is WORD; coordinates must be finite", "v 1 nan 0\n"),
             ("line N: a line cannot begin with WORD in an OBJ file; lines begin with a keyword, like v or f",
              "0 0 0\n"),
             ("line N: WORD behind the coordinates is not a number; only numbers may be there", "v 0 0 0 v 1 0 0\n"),
             ("line N: the corner WORD is not understood; it must be v, v/vt, v//vn or v/vt/vn",
              POINTS + "f 1.5 2 3\n"),
             ("line N: the corner WORD has index 0; points count from 1", POINTS + "f 0 1 2\n"),
             ("line N: the corner WORD is out of range; there are N points", POINTS + "f 1 2 4\n"),
             ("line N: the corner WORD is out of range; there are N points before it", POINTS + "f -1 -2 -4\n"),
             ("line N: the file ends within a face; copy or export it again", POINTS + "f 1 2"),
             ("line N: the file ends within a line, and no face uses point N: it seems to be cut off; "
              "if it is whole, end its last line", POINTS + "v 0 1 1\nf 1 2 3\nf 1 2 3")),
    *reading("obj",
             ("byte N: the file ends within a character of UTF-16; copy or export it again",
              POINTS.encode("utf-16") + b"f"),
             ("line N: a line cannot begin with WORD in an OBJ file; if this is an OFF file, let its name end in .off",
              OFF_POINTS),
             ("line N: the counts before the OBJ file are N points and N faces, but there are N and N; delete this "
              "line if the file is whole", "OFF\n4 1 0\n" + POINTS + "f 1 2 3\n")),
    *reading("off",
             ("line N: WHAT is WORD, which is not an integer; write a whole number", "OFF\nthree 1 0\n"),
             ("line N: the file ends where WHAT should be; copy or export it again", "OFF\n"),
             ("line N: WORD is not the header of an OFF file; the first line must be OFF, or the counts", "PLY\n"),
             ("line N: WORD is of another dimension; only three-dimensional OFF files are supported", "4OFF\n0 0 0\n"),
             ("line N: binary OFF files are not supported; only ascii ones are", "OFF BINARY\n"),
             ("line N: the file ends before a header; the first line must be OFF", "# nothing\n"),
             ("line N: WHAT is WORD, which is below 0; it must be 0 or more", "OFF\n-3 1 0\n"),
             ("line N: WORD behind the counts is not understood; they are those of points, faces and edges",
              "OFF\n3 1 0 7\n"),
             ("line N: the header announces N points and N faces, which cannot fit in the N bytes that follow; "
              "copy or export the file again",
              "OFF\n1000000000000 1 0\n0 0 0\n"),
             ("line N: WORD follows the last of the N faces that the header announces; correct the header",
              OFF_POINTS + "3 0 1 2\n3 0 2 1\n"),
             ("line N: the file ends within WHAT N of N; copy or export it again", OFF_POINTS),
             ("line N: a face with N corners cannot fit in the N bytes that follow; a face begins with the number "
              "of its corners", OFF_POINTS + "4 0 1 2\n"),
             ("line N: the corner WORD is out of range; there are N points, counted from 0",
              OFF_POINTS + "3 0 1 3\n")),
    *reading("ply",
             ('line N: the first line is not that of a PLY file; it must be "ply"', "plyx\n"),
             ('line N: the file ends within its header; it must end with a line "end_header"',
              "ply\nformat ascii 1.0\n"),
             ("line N: WORD is not a line of a PLY header; it must begin with format, comment, obj_info, element, "
              "property or end_header", "ply\nelemnt vertex 3\n"),
             ("line N: WORD is not understood here; the line must end before it", "ply\nformat ascii 1.0 more\n"),
             ('line N: the header does not tell the format; it needs a line like "format ascii 1.0"',
              "ply\nelement vertex 0\nend_header\n"),
             ("line N: the format is WORD; it must be ascii, binary_little_endian or binary_big_endian",
              "ply\nformat utf8 1.0\n"),
             ("line N: the version of the format is WORD; it must be 1.0", "ply\nformat ascii 2.0\n"),
             ("line N: the number of elements is WORD, which is below 0; it must be 0 or more",
              "ply\nelement vertex -3\n"),
             ('line N: a property stands before the first element; a line like "element vertex 8" comes first',
              "ply\nproperty float x\n"),
             ("line N: the length of a list is not of an integer type; it must be, like uchar or int",
              "ply\nelement face 3\nproperty list float int a\n"),
             ("line N: a property has no name; it must follow the type", "ply\nelement vertex 3\nproperty float\n"),
             ("line N: WORD is not a type of PLY; there are char, uchar, short, ushort, int, uint, float and double",
              "ply\nelement vertex 3\nproperty quad x\n"),
             ('line N: the PLY header has no property "NAME" of "vertex"; points have x, y and z',
              ply("", of_vertex="property float x\n")),
             ('line N: the PLY header has more than one property "NAME" of "vertex"; there must be one',
              ply("", of_vertex="property float x\n" + XYZ)),
             ('line N: the PLY header makes the property "NAME" of "vertex" a list; it must be a number',
              ply("", of_vertex=XYZ.replace("float", "list uchar float"))),
             ('line N: the PLY header has no element "vertex"; there must be one, with x, y and z',
              ply("").replace("element vertex", "element point")),
             ('line N: the PLY header has two elements "vertex"; there must be one',
              ply("").replace("element face", "element vertex")
              .replace(CORNER_LIST, XYZ)),
             ('line N: the PLY header has no property "vertex_indices" of "NAME"; it must have that list',
              ply("", of_face="property int corners\n")),
             ('line N: the PLY header makes the property "NAME" of "NAME" no list; it must be a list',
              ply("", of_face="property int vertex_indices\n")),
             ("line N: the PLY header is that of Gaussian splats, which have no faces; make a mesh of them first",
              ply("", faces=0, of_vertex=XYZ + "".join(f"property float {name}\n" for name in SPLATS))),
             ("line N: binary data follow text of UTF-16; export the file again, as ascii or as binary",
              ply("", form="binary_little_endian").encode("utf-16")),
             ('line N: the header announces N elements "NAME" of at least N bytes, but only N bytes are left; copy '
              'or export the file again',
              ply("0 0 0\n", vertices=1000000000000)),
             ('line N: the file ends before element "NAME" N of N; copy or export it again',
              ply("0.000 0.000 0.000\n1 0 0\n")),
             ('byte N: the file ends within element "NAME" N of N; copy or export it again',
              binary_ply(CORNERS_OF_ONE, b"\1\0\0\0\0", of_face=CORNER_LIST + "property int more\n")),
             ("line N: the line ends before the element is complete; each property needs a value",
              ply("0.000 0.000 0.000\n", vertices=1, of_vertex=XYZ + "property float w\n")),
             ('line N: WORD follows the properties of element "NAME" N of N; the header must have a property for '
              'each value', ply("0 0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")),
             ("line N: WORD follows the last element; correct the counts of the header",
              ply("0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 2 1 0\n")),
             ("byte N: the last element ends here, but N bytes follow; copy or export the file again",
              binary_ply(CORNERS_OF_ONE, struct.pack("<B3i", 3, 0, 1, 2) + b"more")),
             ("line N: the length of a list is N, which is below 0; it must be 0 or more",
              ply("0 0 0\n1 0 0\n0 1 0\n-3 0 1 2\n")),
             ("line N: a list of N values cannot fit in the N bytes that are left; copy or export the file again",
              ply("0 0 0\n1 0 0\n0 1 0\n1000000 0 1 2\n")),
             ("line N: the corner N is out of range; there are N points, counted from 0",
              ply("0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n")),
             ('byte N: WHAT of element "NAME" N of N is N; coordinates must be finite',
              binary_ply([0, 0, float("inf")] * 3, struct.pack("<B3i", 3, 0, 1, 2))),
             ("byte N: WHAT is N, which is not an integer; write a whole number",
              binary_ply(CORNERS_OF_ONE, struct.pack("<B3f", 3, 0, 1, 1.5),
                         of_face="property list uchar float vertex_indices\n"))),
    *reading("stl",
             ("line N: the facet's normal is missing; it has three numbers", "solid a\nfacet normal 0 0\nouter loop\n"),
             ('line N: the file ends before "endsolid"; copy or export it again', "solid a\n" + FACET),
             ('line N: WORD stands here; it must be "WORD"', "solid a\nfacette normal 0 0 1\n"),
             ("byte N: the file ends within the header of a binary STL (84 bytes); copy or export it again", "h"),
             ("byte N: the header announces N triangles, which take N bytes, but the file has N; copy or export it "
              "again",
              binary_stl(4000000000, CORNERS_OF_ONE)),
             ("byte N: the last of N triangles ends here, but N bytes follow; copy or export the file again",
              binary_stl(0, CORNERS_OF_ONE)),
             ("byte N: WHAT of triangle N is N; coordinates must be finite",
              binary_stl(1, [float("nan")] + CORNERS_OF_ONE[1:]))),
]

# ---- Reports

# What `report` reads of one.
REPORT = json.dumps({"format": 1, "kind": "make", "models": [{"file": "model.obj"}], "cage": "cage.obj", "error": None,
                     "seconds": 1, "memory_peak_mib": 1,
                     "check": {"bounding": True, "triangles": 12, "quads": 0, "mean_distance": 0.1, "max_distance": 0.2,
                               "volume_ratio": None, "min_angle_degrees": 45}})


def png(width, height):
    """The head of a picture that says that it is so large."""
    chunks = [b"IHDR" + struct.pack(">2I5B", width, height, 8, 2, 0, 0, 0), b"IDAT" + zlib.compress(b"")]
    return b"\x89PNG\r\n\x1a\n" + b"".join(struct.pack(">I", len(chunk) - 4) + chunk +
                                           struct.pack(">I", zlib.crc32(chunk)) for chunk in chunks)


# ---- The command line

COMMAND_LINE = [
    Row("there is no command 'WORD' (see vdbcage --help)", "frobnicate"),
    Row("there is no command 'WORD'; did you mean NAME? (see vdbcage --help)", "mak"),
    Row("there is no option 'WORD' (see vdbcage NAME --help)", "make model.obj --frobnicate"),
    Row("there is no option 'WORD'; did you mean NAME? (see vdbcage NAME --help)", "make model.obj --face 20"),
    Row("there is no option 'WORD'; a file of this name is written ./WORD", "make model.obj -o new.obj -x"),
    Row("WHAT is required", "make -o new.obj"),
    Row("--NAME: it needs a value, NAME", "make model.obj -o"),
    Row("--NAME: it is given N times; once is allowed", "make model.obj -o new.obj -o other.obj"),
    Row("there is no place for 'WORD'; see vdbcage NAME --help", "repair cage.obj my cage.obj -o new.obj"),
    Row("--NAME: 'WORD' is not allowed; it must be a number", "check cage.obj model.obj --least-part all"),
    Row("--NAME: 'WORD' is not allowed; it must be a whole number", "check cage.obj model.obj --threads all"),
    Row("--NAME: it takes no value", "check cage.obj model.obj --quiet=maybe"),
    make("--NAME: 'WORD' is not allowed; it must be RANGE", "--smooth -1"),
    Row("NAME: N is not allowed; it must be RANGE", "check cage.obj model.obj --threads 0"),
    Row("--size: 'WORD' is not allowed; it must be WIDTHxHEIGHT, each 1 to N", "render model.obj -o new.png --size 4"),
    make("--NAME: 'WORD' is not allowed; it must be one of NAME", "--mesh pentagons"),
    Row("nu: N is not allowed; it must be above -1 and below 0.5",
        "deform cage.obj cage.obj model.obj -o new.obj --coordinates somigliana --nu 0.5"),
    make("--memory: 'WORD' is not allowed; it must be auto, off, or a size as 4G, 512M or 4000000000",
         "--memory much"),
    Row("progress: 'WORD' is neither auto nor lines", "check cage.obj model.obj --progress bars"),
    Row("rotations: 'WORD' is not allowed; it must be global or local",
        "deform cage.obj cage.obj model.obj -o new.obj --coordinates somigliana --rotations none"),
    Row("shell: 'WORD' is neither bash nor fish nor zsh", "completion tcsh"),
]

# ---- Files

FILES = [
    Row("FILE: cannot be read: REASON", "check missing.obj model.obj"),
    Row("FILE: the file name has no extension; the formats are known by WORD", "check model model.obj"),
    Row('FILE: the file name ends in "WORD"; the formats are known by WORD', "check model.gltf model.obj"),
    Row("FILE: is a directory; a file is needed", "check folder.obj model.obj", {"folder.obj": FOLDER}),
    Row("FILE: is not a regular file", "check pipe.obj model.obj", {"pipe.obj": PIPE}),
    Row("FILE: this model is named twice", "check cage.obj model.obj ./model.obj"),
    Row("FILE: there is no file of this pattern", "deform cage.obj pose.%04d.obj model.obj -o new.%04d.obj"),
    Row("FILE: has more than one place for a frame's number", "deform cage.obj %d.%d.obj model.obj -o new.%04d.obj"),
    make("FILE: its longest side is N; N to N is allowed", "",
         {"model.obj": "v 0 0 0\nv 1e-300 0 0\nv 0 1e-300 0\nf 1 2 3\n"}),
    make("FILE: its longest side is N, too small for a coordinate of N; at resolution N it must be at least N "
         "(move the model towards the origin)", "",
         {"model.obj": "v 1e15 0 0\nv 1000000000000001 0 0\nv 1e15 1 0\nf 1 2 3\n"}),
    Row("FILE: cannot be written: REASON", ["make", "model.obj", "-o", "n" * 300 + ".obj"]),
    Row("FILE: cannot be replaced: REASON", "make model.obj -o old.obj", {"old.obj": READ_ONLY}, as_nobody=True),
    Row("FOLDER: the folder cannot be made: REASON", "jobs model.obj -o model.obj/jobs"),
    Row("standard output: cannot be written: REASON", "man", status=75, output="/dev/full"),
    make("FILE: the folder FOLDER does not exist", "--report no/report.json"),
    make("FOLDER: the folder cannot be made: the folder FOLDER does not exist", "--stages no/stages"),
    make("FOLDER: the folder cannot be made: something else has that name", "--stages model.obj"),
    Row("FILE: is not an ordinary file", "make model.obj -o pipe.obj", {"pipe.obj": PIPE}),
    make("FILE: this file is named twice; all outputs must be different files", "--report ./new.obj"),
    Row("FILE: this file is named twice; it is the input FILE, which would be overwritten",
        "make model.obj -o ./model.obj"),
    make("FILE: pictures are written as .png; the name must end so", "--picture new.jpg"),
    Row("FILE: weights are written as .npy; the name must end so", "bind cage.obj model.obj -o new.dmat"),
    Row("FILE: the name must end in WORD", "report model.obj --csv new.txt"),
    Row("FILE: for several models it must be a folder, which gets a .npy for each",
        "bind cage.obj model.obj cage.obj -o new.npy"),
    Row("FILE: another model has this name too, and the weights of both would be FILE",
        "bind cage.obj model.obj other/model.obj -o new", {"other/model.obj": TETRAHEDRON}),
    Row("FILE: another model has this name too, and the cages of both would be FILE: FILE",
        "jobs model.obj other/model.obj -o new", {"other/model.obj": TETRAHEDRON}),
    Row("FILE: the cage of NAME would replace it; choose another folder", "jobs model.obj -o ."),
    Row("--NAME: it does not go with --fit; the options of vdbcage fit do",
        "jobs --fit cage.obj model.obj -o new --faces 60"),
    Row("--NAME: it needs --fit CAGE", "jobs model.obj -o new --tight 1"),
    Row("'WORD': a job is a line, and cannot have control characters", ["jobs", "mo\ndel.obj", "-o", "new"]),
    Row("FILE: WHAT of point N is N, which does not fit the floats of the file",
        "repair large.obj -o new.stl", {"large.obj": BOX.replace("v -1 -1 -1", "v 1e50 -1 -1")}),
    Row("FILE: it is too large or too small for float32; .obj, .off and .ply files hold float64",
        "make model.obj -o new.stl --effort fast --faces 20 --resolution 16",
        {"model.obj": TETRAHEDRON.replace("1 0 0", "1e50 0 0").replace("0 1 0", "0 1e50 0")}),
    Row("FILE: it is so far from the origin that float32 rounds coordinates by up to N % of its longest side; at most N % "
        "is allowed: move it by WORD first; .obj, .off and .ply files hold float64", "make model.obj -o new.stl",
        {"model.obj": TETRAHEDRON.replace("v ", "v 50000")}),
    Row("--precision: 'float64' is not allowed with FILE: NAME files hold float32; it must be auto or float32, or the "
        "file .obj, .off or .ply", "make model.obj -o new.stl --precision float64"),
    Row("FILE: point N is not finite", "deform cage.obj posed.obj model.obj -o new.obj",
        {"posed.obj": obj([[1e60 * c for c in p] for p in CORNERS], BOX_FACES)}),
]

# ---- Weights: the model has 4 points, the cage 8

CONSTANT = [1 / 8] * 32


def npy(header="{'descr': '<f8', 'fortran_order': False, 'shape': (4, 8), }", values=CONSTANT, version=1, more=b""):
    text = header.encode() + b"\n"
    return b"\x93NUMPY" + bytes([version, 0]) + struct.pack("<H", len(text)) + text + \
        struct.pack(f"<{len(values)}d", *values) + more


def dmat(start="8 4\n", values=CONSTANT, more="\n"):
    return start + "\n".join(map(str, values)) + more


def weighing(message, content, extension="npy", words="", files=None):
    return Row("FILE: " + message, f"deform cage.obj cage.obj model.obj -o new.obj --weights w.{extension} {words}",
               {f"w.{extension}": content, **(files or {})})


def weights_rows(own):
    """`own` is what `bind` writes of the model and the cage."""
    return [
        weighing("it is not a weights file: neither NumPy's (.npy) nor named .dmat", "weights"),
        weighing("it is not a weights file of vdbcage, or truncated", own[:150]),
        weighing("it is a NumPy file of version N; 1.0, 2.0 and 3.0 are read", npy(version=9)),
        weighing("it has no header of a NumPy array, but WORD", npy("weights")),
        weighing("it is truncated", own[:-4]),
        weighing("it has N bytes behind the weights; it should end there", own + b"more"),
        weighing("it is truncated: N rows of N columns need N bytes; it has N", npy(values=[1.0])),
        weighing("it is truncated: N rows of N columns need N numbers, and a line end behind the last",
                 dmat(values=CONSTANT[1:]), "dmat"),
        weighing("it has N handles; NAME coordinates of this cage have N", own.replace(b"(4, 8))", b"(4, 9))")),
        weighing("coordinates: 'WORD' is not a family; there are NAME", own.replace(b"mvc\0", b"xyz\0")),
        weighing("it was made for another cage", own, files={"cage.obj": BOX.replace("2", "3", 1)}),
        weighing("it was made for another model", own, files={"model.obj": TETRAHEDRON.replace("v 0 0 1", "v 0 0 2")}),
        weighing("it holds records; weights are plain numbers, '<f4' or '<f8'",
                 npy("{'descr': [('a', '<f8')], 'fortran_order': False, 'shape': (4, 8), }")),
        weighing("its numbers are WORD; weights are '<f4' or '<f8'",
                 npy("{'descr': '<i4', 'fortran_order': False, 'shape': (4, 8), }")),
        weighing("it has N dimensions (WORD); weights have 2, points x cage points",
                 npy("{'descr': '<f8', 'fortran_order': False, 'shape': (4, 4, 2), }")),
        weighing("it is transposed: it has N rows and N columns; rows are the model's N points, "
                 "columns the cage's N", npy("{'descr': '<f8', 'fortran_order': False, 'shape': (8, 4), }")),
        weighing("it has N rows; rows: the model has N points",
                 npy("{'descr': '<f8', 'fortran_order': False, 'shape': (5, 8), }")),
        weighing("it has N columns; columns: the cage has N points",
                 npy("{'descr': '<f8', 'fortran_order': False, 'shape': (4, 7), }")),
        weighing("line N: WHAT is N; it must not be negative", dmat("-8 4\n"), "dmat"),
        weighing("line N: the first line must be COLUMNS ROWS, and nothing behind it", dmat("8 4 2\n"), "dmat"),
        weighing("line N: the second line must be COLUMNS ROWS, and nothing behind it", dmat("0 0\n8 4 2\n"), "dmat"),
        weighing("line N: there is WORD behind the last weight", dmat(more="\n7\n"), "dmat"),
        weighing("row N: the weight in column N is N in single precision; weights must be finite",
                 npy(values=[1e300] + CONSTANT[1:])),
        weighing("row N: its weights have the sum N; it must be 1 within 0.001, so that the model moves along with "
                 "the cage", npy(values=[1.0] + CONSTANT[1:])),
        weighing("its weights were made elsewhere; they do not go with --coordinates NAME", npy(),
                 words="--coordinates mvc"),
        weighing("its weights were made elsewhere; --inversions needs coordinates that can be computed at other "
                 "points, as those of vdbcage bind", npy(), words="--inversions"),
        weighing("has NAME coordinates; --coordinates asks for NAME", own, words="--coordinates green"),
    ]


# ---- Volumes

def drawing(message, content):
    return Row("FILE: " + message, "render a.vdb -o new.png --size 20x20", {"a.vdb": content})


def damaged(message, content):
    return drawing(f"is damaged: {message} (at byte N)", content)


def named(*names, kind="Tree_float_5_4_3"):
    return volume(*[(name, kind, "", grid()) for name in names])


def of_bools(body):
    return volume(("density", "Tree_bool_5_4_3", "", grid(body)))


def chunk(length, bytes_of_it=b""):
    return tree(child=node(upper=struct.pack("<q", 0), stored=struct.pack("<q", length) + bytes_of_it))


NAN = float("nan")
NAN_TILE, NAN_OUTSIDE = floats(tree(tiles=[tile(NAN)])), floats(tree(background=struct.pack("<f", NAN)))
HALF = struct.pack("<I", 1) + text("is_saved_as_half_float") + text("bool") + text("\1")

VOLUMES = [
    make("--NAME: 'WORD' is not a NAME field; it must be a .vdb file, sphere:X,Y,Z,RADIUS,SCALE or "
         "box:X,Y,Z,X,Y,Z,SCALE", "--scale-field ball:0,0,0"),
    make("--NAME: 'WORD' is a second .vdb file; a NAME field can have one", "--density a.vdb;a.vdb",
         {"a.vdb": floats(tree(child=node()))}),
    make("--NAME: WHAT of a region is N; it must be RANGE", "--scale-field sphere:0,0,0,-1,2"),
    drawing("is not a .vdb file, or is truncated", "short"),
    drawing("is of version N of the .vdb format; N to N can be read", floats(version=999)),
    drawing("holds no grid", volume()),
    drawing("holds several grids but none named NAME: NAME", named("a", "b")),
    drawing("grid 'NAME' is of type 'NAME'; a tree of levels 5, 4 and 3 is needed", named("a", kind="PointDataGrid")),
    make("FILE: grid 'NAME' holds WORD values; float is needed", "--scale-field a.vdb",
         {"a.vdb": named("a", kind="Tree_double_5_4_3")}),
    drawing("grid 'NAME' holds WORD values; float, double, bool or mask is needed",
            named("a", kind="Tree_vec3s_5_4_3")),
    drawing("grid 'NAME' of type NAME cannot be passed by: the file was streamed and has no offsets",
            volume(("a", "Tree_vec3s_5_4_3", "", grid()), ("density", "Tree_float_5_4_3", "", grid()), offsets=0)),
    damaged("grid 'NAME' lies from byte N to N", floats(begin=-1)),
    damaged("metadata have no name or the same",
            one(metadata=struct.pack("<I", 1) + text("") + text("int32") + text("abcd"))),
    damaged("its transform is a 'NAME', which is unknown", one(transform=text("TwistMap"))),
    damaged("the numbers of its transform do not fit each other", one(transform=scale_map(twice=3))),
    damaged("its transform is no frustum", one(transform=frustum(depth=0))),
    damaged("its transform cannot be inverted",
            one(transform=text("AffineMap") + struct.pack("<16d", *[0] * 15 + [1]))),
    damaged("the length of a chunk of N bytes is N", one(compression=6, body=chunk(9000))),
    damaged("a chunk of N bytes cannot be decompressed by Blosc", one(compression=6, body=chunk(20, b"x" * 20))),
    damaged("a chunk of N bytes cannot be decompressed by zlib", one(compression=3, body=chunk(20, b"x" * 20))),
    damaged("leaf nodes have N buffers instead of one", floats(tree(buffers=2))),
    damaged("the origin of a node is not a multiple of N", floats(tree(tiles=[tile(origin=(1, 0, 0))]))),
    damaged("two nodes have the same origin", floats(tree(tiles=[tile(), tile()]))),
    damaged("a tile is where a node is", floats(tree(child=node(active=(0,))))),
    damaged("the two masks of a leaf node differ", floats(tree(child=node(buffer_mask=mask(size=512))))),
    damaged("the two origins of a leaf node differ",
            of_bools(tree(child=node(leaf_origin=struct.pack("<3i", 8, 0, 0)), background=b"\0"))),
    damaged("the code of a node's values is N", floats(tree(child=node(code=7)))),
    damaged("a value is neither 0 nor 1",
            of_bools(tree(child=node(children=(), active=(0,), upper=b"\2"), background=b"\0"))),
    damaged("WHAT is N, neither 0 nor 1", of_bools(tree(tiles=[tile(b"\2")], background=b"\0"))),
    damaged("its compression is N", one(compression=64)),
    damaged("it is said to be both of half floats and not", one(metadata=HALF)),
    damaged("there are N grids", floats(count=-1)),
    damaged("a grid ends N bytes before its end", floats(longer=8)),
    damaged("a grid extends beyond its end", floats(shorter=4)),
    damaged("grid 'NAME' shares the tree of 'NAME', which has none like it", 
            volume(("density", "Tree_float_5_4_3", "b", grid(b"")), ("a", "Tree_float_5_4_3", "", grid()))),
    drawing("it has no active voxels; at least one is needed", floats(tree())),
    drawing("the background of grid 'NAME' is inside: the solid has no end",
            floats(tree(background=struct.pack("<f", 1)))),
    drawing("the surface of the voxels is too large: N WHAT; there may be N",
            floats(tree(tiles=[tile(origin=(8192 * i, 0, 0)) for i in range(60)]))),
    drawing("there are active voxels near WORD; coordinates must be in [-2^30, 2^30)",
            floats(tree(tiles=[tile(origin=(1 << 30, 0, 0))]))),
    drawing("the grid's transform is a frustum; it must be linear",
            one(transform=frustum(), body=tree(child=node()))),
    make("the scale field has a value that is not finite", "--scale-field a.vdb", {"a.vdb": NAN_TILE}),
    make("the background of the scale field is not finite", "--scale-field a.vdb", {"a.vdb": NAN_OUTSIDE}),
    make("the density has a value that is not finite", "--density a.vdb", {"a.vdb": NAN_TILE}),
    make("the background of the density is not finite", "--density a.vdb", {"a.vdb": NAN_OUTSIDE}),
    make("the transform of the scale field must be linear", "--scale-field a.vdb",
         {"a.vdb": one(transform=frustum())}),
    make("the transform of the density must be linear", "--density a.vdb", {"a.vdb": one(transform=frustum())}),
    Row("the radius times the largest scale of the field is N voxels; it must be at most N",
        "make model.obj -o new.obj --resolution 512 --close-radius 0.25 --scale-field sphere:0,0,0,1,8"),
    Row("the scale field needs N samples; there may be 2^28",
        "make model.obj -o new.obj --resolution 1024 --close-radius 0.003 --scale-field sphere:0,0,0,9,2"),
]

# ---- Options, joints, pictures, binding, reports


def sphere(rings, sides):
    """A cage of many points, from pole to pole."""
    from math import cos, pi, sin
    points = [(0, 0, 9)]
    for ring in range(1, rings):
        height, wide = 9 * cos(pi * ring / rings), 9 * sin(pi * ring / rings)
        points += [(wide * cos(2 * pi * i / sides), wide * sin(2 * pi * i / sides), height) for i in range(sides)]
    points.append((0, 0, -9))
    at = lambda ring, i: 2 + (ring - 1) * sides + i % sides
    faces = [(1, at(1, i), at(1, i + 1)) for i in range(sides)]
    for ring in range(1, rings - 1):
        faces += [(at(ring, i), at(ring + 1, i), at(ring + 1, i + 1)) for i in range(sides)]
        faces += [(at(ring, i), at(ring + 1, i + 1), at(ring, i + 1)) for i in range(sides)]
    faces += [(len(points), at(rings - 1, i + 1), at(rings - 1, i)) for i in range(sides)]
    return obj(points, "".join("f %d %d %d\n" % face for face in faces))


def fit(message, files=None, words=""):
    return Row(message, "fit cage.obj model.obj -o new.obj " + words, files)


def bind(message, words="", **files):
    return Row(message, "bind cage.obj model.obj -o new.npy " + words,
               {name + ".obj": content for name, content in files.items()})


def deform(message, words, **files):
    return Row(message, "deform cage.obj cage.obj model.obj -o new.obj " + words,
               {name + ".obj": content for name, content in files.items()})


def pose(message, faces):
    """Of the cage, posed with these faces."""
    return Row(message, "deform cage.obj posed.obj model.obj -o new.obj", {"posed.obj": obj(CORNERS, faces)})


EXCHANGED = BOX_FACES.translate(str.maketrans("12", "21"))
FAR_OFF = TETRAHEDRON.replace("v 1 0 0", "v 1e200 0 0")
OUTSIDE = TETRAHEDRON.replace("v 1 0 0", "v 9 0 0")
# All its points are in the cage. Its face is at a side of it, with the outer side inward.
AT_A_SIDE = "v -1 0 0\nv -1 1 0\nv -1 0 1\nf 1 2 3\n"

OTHERS = [
    make("FILE: there is no joint; a line has X Y Z, or X Y Z X Y Z for a bone", "--joints j", {"j": "# none\n"}),
    make("FILE: line N: WORD is not understood; a line has X Y Z, or X Y Z X Y Z for a bone", "--joints j",
         {"j": "0 0 0 1 1 1 1\n"}),
    make("FILE: line N: the bone has no length", "--joints j", {"j": "0 0 0 0 0 0\n"}),
    make("joints: the one at WORD is outside of the model's bounding box; it must be inside of a limb", "--joints j",
         {"j": "5 5 5\n"}),
    make("--erode-radius: 'N' is not allowed; it must be at most the close radius, N",
         "--close-radius 0.01 --erode-radius 0.02"),
    make("--erode-radius: 'N' is not allowed; it must be at most the close radius, which has to be given too",
         "--erode-radius 0.02"),
    make("--symmetry: 'WORD' is not allowed with --bounding off; it must be auto or off",
         "--bounding off --symmetry x"),
    make("--mesh: 'loops' is not allowed with --bounding off; it must be triangles, triquad or quads",
         "--bounding off --mesh loops"),
    make("--density: 'WORD' is not allowed with --bounding off; it must be none",
         "--bounding off --density sphere:0,0,0,1,2"),
    make("--joints: 'WORD' is not allowed with --bounding off; it must be none", "--bounding off --joints j",
         {"j": "0 0 0\n"}),
    make("--scale-field: 'WORD' is not allowed with --element cube; it must be none, or the element sphere",
         "--element cube --scale-field sphere:0,0,0,1,2"),
    Row("--faces: 'N' is not allowed with --mesh NAME; it must be 6 or more, or the mesh triangles",
        "make model.obj -o new.obj --faces 4 --mesh quads"),
    make("--symmetry: 'WORD' is not allowed: the model misses NAME by N % of its longest side; it may be at most N %",
         "--symmetry x", {"model.obj": "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 1 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n"}),
    make("--skip-done needs --report FILE.json, the record of what it did", "--skip-done"),
    Row("--influence: a panel needs a model and its cage", "render model.obj -o new.png --influence 0"),
    Row("--influence: N is not a vertex of the cage; 0 to N are", "render model.obj cage.obj -o new.png --influence 8"),
    Row("a lone + must stand between two files: FILE + FILE", "render + model.obj -o new.png"),
    Row("a panel has no file; write FILE... / FILE...", "render model.obj / -o new.png"),
    Row("picture: N x N pixels are too few for N panels",
        "render model.obj / model.obj -o new.png --columns 2 --size 1x1"),
    fit("FILE: it is not a closed, oriented 2-manifold (N boundary edges, N edges of more than two faces, N edges whose "
        "faces disagree, N points where surfaces touch); vdbcage repair may help",
        {"cage.obj": BOX.replace("f 1 2 4 3\n", "")}),
    Row("FILE: its extension must be that of the cage, WORD: all else in the file stays",
        "fit cage.obj model.obj -o new.ply"),
    fit("NAME: 'WORD' is not allowed; it must be numbers of points, as 1-20,35,40-44:yz", words="--keep points:all"),
    fit("--symmetry: WORD is not allowed; it must be off, x, y or z", words="--symmetry auto"),
    fit("FILE: it is not symmetric: a face has no mirror image", {"model.obj": BOX, "cage.obj": obj(
        [(0.5, 9, 0.5), (0.5, -9, 0.5), (0.5, 0.5, 9), (0.5, 0.5, -9), (-9, 0.5, 0.5), (10, 0.5, 0.5)],
        "f 5 3 1 4\nf 5 2 3\nf 5 4 2\nf 6 1 3\nf 6 4 1\nf 6 3 2\nf 6 2 4\n")}, "--symmetry x"),
    fit("FILE: it is not symmetric: point N has no mirror image of its own",
        {"model.obj": BOX, "cage.obj": TETRAHEDRON}, "--symmetry x"),
    fit("FILE: face N lies across the plane of symmetry, where it needs edges", {"model.obj": BOX}, "--symmetry x"),
    fit("--place: WORD is not allowed; it must be turn, or nothing", words="--place=up"),
    Row("FILE: it is inside of FILE, which bounds it: give the cage first, then the model",
        "fit cage.obj model.obj -o new.obj",
        {"model.obj": obj([(-9, -9, -9), (60, -9, -9), (-9, 60, -9), (-9, -9, 60)], TETRAHEDRON[32:])}),
    fit("--keep: N is not allowed; the cage has N points", words="--keep points:8"),
    fit("FILE: no place was found where WORD",
        {"model.obj": obj([tuple(3 * x for x in p) for p in CORNERS], BOX_FACES)}, "--keep points:0"),
    bind("FILE: it is not closed and oriented (N boundary edges, N edges whose faces disagree); vdbcage repair may "
         "help", cage=BOX.replace("f 1 2 4 3\n", "")),
    bind("FILE: it faces inward; turn its faces around",
         cage=obj(CORNERS, "".join("f " + " ".join(line.split()[:0:-1]) + "\n" for line in BOX_FACES.splitlines()))),
    bind("FILE: it is flat; it must have a volume to deform what is in it", cage=POINTS + "f 1 2 3\nf 3 2 1\n"),
    bind("FILE: NAME coordinates are not defined at N of N points, first at point N, WORD; all must be inside of the "
         "cage",
         "--coordinates harmonic --resolution 16", model=OUTSIDE),
    bind("FILE: NAME coordinates are not defined at N of N points, first at point N, WORD; none may be so far away",
         "--coordinates mvc", model=FAR_OFF),
    bind("loose points: 'WORD' is not allowed; it must be ride or stay", "--loose fly"),
    deform("inversions: two points are looked at for each triangle; REASON",
           "--inversions --coordinates harmonic --resolution 16", model=AT_A_SIDE),
    bind("FILE: it has N points and N triangles; biharmonic coordinates allow N of both together",
         "--coordinates biharmonic", cage=sphere(40, 60)),
    bind("coordinates: 'WORD' is not a family; there are NAME", "--coordinates linear"),
    bind("NAME: only NAME coordinates have it; these are NAME", "--resolution 32"),
    Row("FILE: it has N points, N triangles and N quads; the cage has N points, N triangles and N quads",
        "deform cage.obj model.obj model.obj -o new.obj"),
    pose("FILE: N of its N faces are not the cage's, and no other order of its points makes them so",
         BOX_FACES.replace("1 2 4 3", "1 2 3 4")),
    pose("FILE: its points are in another order than the cage's, and it has N quads; the cage has N; keep the quads, or "
         "the order", EXCHANGED.replace("f 2 1 4 3\n", "f 2 1 4\nf 2 4 3\n")),
    pose("FILE: its points are in another order than the cage's, and its faces do not tell which is which; keep the "
         "order", EXCHANGED),
    Row("POSED_CAGE and OUT: both or none must have a frame number, as in cage.%04d.obj",
        "deform cage.obj cage.%04d.obj model.obj -o new.obj"),
    Row("--compare is of one pose; POSED_CAGE must not have a frame number",
        "deform cage.obj cage.%04d.obj model.obj -o new.png --compare"),
    deform("--resolution is of weights that are computed; it does not go with --weights",
           "--weights w.npy --resolution 32"),
    deform("--compare shows all families, and inversions too; it does not go with --weights, --coordinates or "
           "--inversions", "--compare --inversions"),
    Row("FILE: it is no report of vdbcage make or fit", "report model.obj"),
    Row("FOLDER: there are no reports of vdbcage make or fit", "report ."),
    Row("FILE: it is no PNG picture: REASON", "report r.json --html new.html", {"r.json": REPORT, "r.png": "no picture"}),
    Row("FILE: it is no PNG picture: it has N x N pixels", "report r.json --html new.html",
        {"r.json": REPORT, "r.png": png(1000000, 1000000)}),
]

# ---- What is missing on a machine

MACHINE = [
    Row("not enough memory", "make model.obj -o new.obj --resolution 2048 --voxelizer cpu --threads 1 --memory off",
        status=75, limits="-v 1500000"),
    Row("--resolution: 'WORD' would take about N WORD of memory, and N WORD is allowed; with N it would fit",
        "make model.obj -o new.obj --resolution 2048 --memory 200M", status=75),
    make("--resolution: 'WORD' would take about N WORD of memory, and N WORD is allowed; no resolution would fit",
         "--memory 1M", status=75),
    Row("FILE: there is not enough memory to read it", "check large.obj model.obj --threads 1", {"large.obj": 1 << 33},
        status=75, limits="-v 1500000"),
    Row("not enough threads can be started; look at limits on processes (ulimit -u)",
        "make model.obj -o new.obj --effort fast", status=75, limits="-u 1", as_nobody=True),
    Row("OpenGL: EGL cannot make a 4.5 core context (WORD)", "render model.obj -o new.png", status=75,
        environment={"MESA_GL_VERSION_OVERRIDE": "4.1"}),
    Row("OpenGL: OSMesa cannot make a 4.5 core context", "render model.obj -o new.png", status=75,
        environment={"MESA_GL_VERSION_OVERRIDE": "4.1"}),
    Row("OpenGL: REASON", "render model.obj -o new.png", {"libEGL.so.1": "", "libOSMesa.so.8": ""}, status=75,
        environment={"LD_LIBRARY_PATH": "."}),
]

# Only a build without the part has them.
WITHOUT_GPL_PART = [
    Row("this vdbcage was built without its GPL part (VDBCAGE_WITH_CGAL_GPL), and so without repair",
        "repair cage.obj -o new.obj"),
    make("voxelizer cgal: this build was made without VDBCAGE_WITH_CGAL_GPL and has none", "--voxelizer cgal",
         status=75),
]


def all_rows(own_weights):
    return [*COMMAND_LINE, *FILES, *MODELS, *weights_rows(own_weights), *VOLUMES, *OTHERS, *MACHINE]
