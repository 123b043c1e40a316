#!/usr/bin/python3
"""The tables and figures of "Cage Generation with User Interaction in Cage Modeler", measured on our own models of the
same kinds and sizes, as one page of HTML. Needs a build with tests, NumPy and matplotlib.
"""

import argparse
import base64
import html
import io
import json
import math
import os
import pathlib
import re
import subprocess
import tempfile

import matplotlib
import matplotlib.pyplot as plt
import numpy as np

# Published wall seconds in 32, 64 and 128 voxels. Of the machine: 4 cores of an i7-8550U.
RESOLUTIONS = [32, 64, 128]
PUBLISHED = {
    "bishop": {"total": [0.97, 5.24, 105], "cgal": [0.87, 3.61, 31.9], "gl": [0.39, 0.42, 0.42]},
    "bench": {"total": [1.83, 5.56, 94], "cgal": [8.8, 9.9, 15.6], "gl": [1.46, 1.65, 1.40]},
}
# The paper's settings: cubes of half a size of 1/16, eroded by 0.4 of it; no guard.
PLAIN = ["--bounding", "off", "--element", "cube", "--close-radius", "0.0625", "--erode-radius", "0.025"]

STYLE = """
body { font: 15px/1.5 system-ui, sans-serif; margin: 2rem auto; max-width: 70rem; padding: 0 1rem; color: #1d2530;
       background: #fff; }
h1 { font-size: 1.6rem; margin: 0 0 1rem; }
h2 { font-size: 1.2rem; margin: 2.5rem 0 .5rem; padding-top: .75rem; border-top: 1px solid #d9dee5; }
p { max-width: 46rem; margin: .5rem 0; }
figure { margin: 1.25rem 0; }
figure img { max-width: 100%; }
figcaption, caption { color: #4c5866; font-size: .9rem; text-align: left; padding: .35rem 0; max-width: 60rem; }
.wide { overflow-x: auto; margin: 1.25rem 0; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
th { text-align: left; font-weight: 600; vertical-align: bottom; border-bottom: 2px solid #c5ccd6; }
th, td { padding: .25rem .9rem .25rem 0; }
td { border-bottom: 1px solid #eceff3; white-space: nowrap; }
.number { text-align: right; }
"""


class Page:
    def __init__(self):
        self.body = []

    def heading(self, text, *paragraphs):
        self.body += [f"<h2>{html.escape(text)}</h2>"] + [f"<p>{html.escape(p)}</p>" for p in paragraphs]

    def table(self, caption, head, rows):
        def cell(kind, text, is_number):
            return f'<{kind} class="{"number" if is_number else "word"}">{html.escape(text)}</{kind}>'

        def is_number(text):  # also with a unit; a lone - stands for none
            return re.fullmatch(r"-|[-+]?[\d.]+( \S+)?", text)

        rows = [[str(text) for text in row] for row in rows]
        head = [cell("th", text, any(is_number(row[i]) for row in rows)) for i, text in enumerate(head)]
        lines = ["".join(cell("td", text, is_number(text)) for text in row) for row in rows]
        self.body.append(f'<div class="wide"><table><caption>{html.escape(caption)}</caption>\n' +
                         "\n".join(f"<tr>{line}</tr>" for line in ["".join(head), *lines]) + "</table></div>")

    def figure(self, kind, data, caption):
        self.body.append(f'<figure><img alt="{html.escape(caption)}" src="data:image/{kind};base64,'
                         f'{base64.b64encode(data).decode()}"><figcaption>{html.escape(caption)}</figcaption></figure>')

    def plots(self, across, panels, caption):
        """Both axes are logarithms. A panel has a title, an axis and series: (name, x, y, is it published?)."""
        picture, axes = plt.subplots(1, len(panels), figsize=(6.2 * len(panels), 4.2))
        for place, (title, up, series) in zip(axes, panels):
            for name, x, y, is_published in series:
                if len(x) > 1:
                    name += f": exponent {np.polyfit(np.log(x), np.log(y), 1)[0]:.2f}"
                place.loglog(x, y, "o--" if is_published else "o-", label=name,
                             markerfacecolor="white" if is_published else None)
            place.set(title=title, xlabel=across, ylabel=up)
            place.grid(True, which="both", color="#e4e8ed")
            place.legend(fontsize="small")
        bytes_ = io.BytesIO()
        picture.tight_layout()
        picture.savefig(bytes_, format="svg", metadata={"Date": None})
        plt.close(picture)
        self.figure("svg+xml", bytes_.getvalue(), caption)

    def text(self, title):
        return (f'<!DOCTYPE html>\n<html lang="en">\n<head><meta charset="utf-8"><title>{title}</title>'
                f"<style>{STYLE}</style></head>\n<body><h1>{title}</h1>\n" + "\n".join(self.body) + "</body></html>\n")


def seconds(value):
    """With two or three digits, below 0.1 in milliseconds; - for none."""
    if not value:
        return "-"
    unit, value = (" ms", 1000 * value) if value < 0.1 else ("", value)
    return f"{value:.{max(0, 2 - max(0, math.floor(math.log10(value))))}f}{unit}"


def percent(share):
    return f"{100 * share:.2f} %"


class Programs:
    """The programs of a build. They work in a folder."""

    def __init__(self, programs, folder, threads):
        self.programs, self.folder, self.threads = programs.resolve(), folder, ["--threads", str(threads)]

    def run(self, name, *words):
        return subprocess.run([self.programs / name, *map(str, words)], cwd=self.folder, check=True,
                              stdout=subprocess.PIPE, text=True).stdout

    def bench(self, *words):
        return [json.loads(line) for line in self.run("vdbcage-bench", *words, *self.threads).splitlines()]

    def cage(self, model, file, *options):
        """The report of making it."""
        self.run("vdbcage", "make", model, "-q", "-o", file, "--report", "report.json", *options, *self.threads)
        return json.loads((self.folder / "report.json").read_text())

    def sheet(self, panels, columns):
        """A picture of panels, which are lists of files."""
        words = [word for panel in panels for word in ["/", *panel]][1:]
        rows = -(-len(panels) // columns)
        self.run("vdbcage", "render", *words, "-o", "sheet.png", "--same-view", "--columns", columns, "--size",
                 f"{230 * columns}x{200 * rows}")
        return (self.folder / "sheet.png").read_bytes()


def points_and_faces(file):
    lines = [line.split() for line in file.read_text().splitlines()]
    return (np.array([line[1:] for line in lines if line[:1] == ["v"]], float),
            [[int(word) - 1 for word in line[1:]] for line in lines if line[:1] == ["f"]])


def bow(file, posed):
    """The bishop bows to the front: its axis bends to an arc between two heights, without stretching."""
    low, high, angle = 1.2, 6.2, 1.1
    points, faces = points_and_faces(file)
    bent = np.clip(points[:, 1], low, high) - low
    above, turn, radius = points[:, 1] - low - bent, angle / (high - low) * bent, (high - low) / angle
    z = radius * (1 - np.cos(turn)) + above * np.sin(turn) + points[:, 2] * np.cos(turn)
    y = low + radius * np.sin(turn) + above * np.cos(turn) - points[:, 2] * np.sin(turn)
    with posed.open("w") as out:
        out.writelines(f"v {x!r} {y!r} {z!r}\n" for x, y, z in np.column_stack([points[:, 0], y, z]).tolist())
        out.writelines("f " + " ".join(str(i + 1) for i in face) + "\n" for face in faces)


def divided(points, triangles):
    """Each triangle as four."""
    ends = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2))
    edges, middles = np.unique(ends, axis=0, return_inverse=True)
    ab, bc, ca = middles.reshape(-1, 3).T + len(points)
    a, b, c = triangles.T
    return (np.vstack([points, points[edges].mean(axis=1)]),
            np.vstack([np.column_stack(t) for t in [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]]))


def write_ply(file, points, triangles):
    faces = np.empty(len(triangles), [("corners", "u1"), ("points", "<i4", 3)])
    faces["corners"], faces["points"] = 3, triangles
    file.write_bytes(b"ply\nformat binary_little_endian 1.0\n"
                     b"element vertex %d\nproperty double x\nproperty double y\nproperty double z\n"
                     b"element face %d\nproperty list uchar int vertex_indices\nend_header\n"
                     % (len(points), len(triangles)) + points.astype("<f8").tobytes() + faces.tobytes())


def add_machine(page, programs, arguments):
    report = programs.cage("bishop.obj", "cage.obj", "--effort", "fast")
    processor = re.search(r"model name\s*: (.*)", pathlib.Path("/proc/cpuinfo").read_text())
    page.heading("Two ways to a cage",
                 'What the paper "Cage Generation with User Interaction in Cage Modeler" measures, measured on '
                 "vdbcage. Its models are not public, so these are our own of the same kinds and sizes. Its figures "
                 "stand beside ours where there are any; they are wall seconds on four cores of an i7-8550U.",
                 "Bounding is what vdbcage does by default: every cage is certified to hold the whole model. Plain is "
                 "the way of the paper, with its settings (cubes of a sixteenth of the longest side, eroded by 0.4 of "
                 "that, HC Laplacian smoothing, quadric decimation); nothing holds such a cage off the model.")
    page.table("Where this was measured", ["", ""], [
        ["vdbcage", f"{report['vdbcage']}, commit {report['commit'] or 'unknown'}"],
        ["processor", f"{processor[1] if processor else 'unknown'}, {arguments.threads} threads"],
        ["resolutions", f"{arguments.resolutions}, of whole runs up to {arguments.whole_runs}"],
    ])
    models = [(name, *points_and_faces(programs.folder / f"{name}.obj")) for name in arguments.models]
    page.table("The models", ["model", "points", "triangles"],
               [[name, len(points), sum(len(face) - 2 for face in faces)] for name, points, faces in models])


def add_stages(page, programs, arguments):
    page.heading("Time by stage and resolution",
                 "The paper's users wait for dilation and erosion: 96 of 105 seconds for the bishop in 128 voxels. "
                 "Here a closing takes milliseconds, as trees of voxels are closed without a grid of distances, and "
                 "the cube by three passes of words of 64 voxels. What takes time is to decimate and tighten under a "
                 "guard that keeps the cage off the model, and that hardly depends on the resolution.")
    for name in arguments.models:
        model = f"{name}.obj"
        voxels = {line["resolution"]: line["cpu"]["wall_seconds"] for line in programs.bench(
            "voxelize", model, "--voxelizers", "cpu", "--resolutions", ",".join(map(str, arguments.resolutions)))}
        rows, series, published = [], {}, PUBLISHED.get(name, {}).get("total", [])
        for resolution in arguments.resolutions:
            [volume] = programs.bench("closing", "--model", model, "--resolution", resolution, "--element", "cube",
                                      "--radius", max(1, resolution // 16), "--alone")
            times = {"voxelize": voxels[resolution]} | {
                part: volume[part]["wall_seconds"] for part in ["dilation", "erosion", "closing"]}
            row = [resolution, *map(seconds, [dict(zip(RESOLUTIONS, published)).get(resolution), *times.values()])]
            memory = {}
            if resolution <= arguments.whole_runs:
                [plain] = programs.bench(model, "--resolutions", resolution, *PLAIN)
                [bounding] = programs.bench(model, "--resolutions", resolution)
                remeshing = sum(plain["stage_seconds"].get(stage, 0) for stage in ["surface", "smooth", "decimate"])
                row.append(seconds(remeshing))
                for way, run in [("plain", plain), ("bounding", bounding)]:
                    times[f"{way}, total"], memory[way] = run["wall_seconds"], run["memory_peak_mib"]
                    row += [seconds(run["wall_seconds"]), f"{run['memory_peak_mib']:.0f}"]
            rows.append(row + ["-"] * (11 - len(row)))
            for part, value in times.items() | memory.items():
                series.setdefault(part, []).append((resolution, value))
        page.table(f"{name}: seconds where nothing else is said, and memory in MiB. Dilation and erosion, by a "
                   "sixteenth, are measured one by one; a closing does both at once. Totals are of whole runs, reading "
                   "and certifying included; a bounding run also tries the halves of its resolution.",
                   ["voxels", "paper, total", "voxelize", "dilation", "erosion", "closing", "remeshing", "plain, total",
                    "MiB", "bounding, total", "MiB"], rows)
        lines = {part: (part, *zip(*points), False) for part, points in series.items()}
        times = [lines[part] for part in ["voxelize", "dilation", "erosion", "plain, total", "bounding, total"]]
        if published:
            times.append(("the paper, total", RESOLUTIONS, published, True))
        page.plots("voxels along the longest side",
                   [(f"{name}: time", "seconds", times),
                    (f"{name}: memory", "MiB", [lines["plain"], lines["bounding"]])],
                   "Time and memory against the resolution. An exponent of 3 is that of a dense grid, 2 that of a "
                   "surface.")


def add_voxelizers(page, programs, arguments):
    page.heading("Voxelizers side by side",
                 "All of them give the same voxels here, bit for bit. gl runs the paper's way, in shaders; without "
                 "hardware these are run by the processor.")
    rows, device = [], ""
    for name in arguments.models:
        published = PUBLISHED.get(name, {"cgal": [0] * 3, "gl": [0] * 3})
        first, *lines = programs.bench("voxelize", f"{name}.obj", "--voxelizers", arguments.voxelizers, "--resolutions",
                                       ",".join(map(str, RESOLUTIONS)))
        device = first["device"]
        for line, cgal, gl in zip(lines, published["cgal"], published["gl"]):
            rows.append([name, line["resolution"], seconds(cgal), seconds(gl)] +
                        [seconds(line.get(way, {}).get("wall_seconds")) for way in ["cgal", "gl", "cpu"]])
    page.table(f"Seconds. OpenGL here: {device}.",
               ["model", "voxels", "paper, CGAL", "paper, OpenGL", "cgal", "gl", "cpu"], rows)


def add_cages(page, programs, arguments, column, choices):
    """Cages of all models by one option: `choices` has its values by their names. Bounding ones have our own settings
    beside it, plain ones the paper's with 64 voxels, its middle resolution."""
    rows, sheets = [], {}
    for name in arguments.models:
        panels = sheets[name] = []
        plain = PLAIN if column == "voxels" else [*PLAIN, "--resolution", 64]
        for way, settings in [("bounding", []), ("plain", plain)]:
            for choice, options in choices.items():
                panels.append([f"{name}.obj", f"cage{len(panels)}.obj"])
                check = programs.cage(*panels[-1], *settings, *options)["check"]
                verdict = "certified" if check["bounding"] else "cuts the model" if check["valid"] else "not valid"
                rows.append([name, way, choice, check["triangles"], check["quads"], percent(check["mean_distance"]),
                             percent(check["max_distance"]),
                             f"{check['volume_ratio']:.2f}" if check["volume_ratio"] > 0 else "-", verdict])
        sheets[name] = programs.sheet(panels, len(choices))
    page.table("Distances are parts of the model's longest side.", [
        "model", "way", column, "triangles", "quads", "mean distance", "largest", "volume, of the model's", "verdict"],
        rows)
    for name, sheet in sheets.items():
        page.figure("png", sheet, f"{name}, {column} {', '.join(choices)}: bounding above, plain below.")


def add_poses(page, programs, arguments):
    page.heading("Deforming by either",
                 "The same pose of a cage of triangles and of a tri-quad one, and what it does to the model's surface. "
                 "Distortion 1 is none.")
    rows = []
    for name in [name for name in arguments.models if name in ("bishop", "creature")]:
        for mesh in ["triangles", "triquad"]:
            programs.cage(f"{name}.obj", "cage.obj", "--mesh", mesh)
            if name == "bishop":
                bow(programs.folder / "cage.obj", programs.folder / "posed.obj")
            else:
                programs.run("vdbcage-walk", "cage.obj", "walk")
                (programs.folder / "walk/walk.0003.obj").replace(programs.folder / "posed.obj")
            table = programs.run("vdbcage", "deform", "cage.obj", "posed.obj", f"{name}.obj", "-o", "families.png",
                                 "--compare", *programs.threads)
            for line in table.splitlines()[1:]:
                if len(cells := re.split(r"\s{2,}", line.strip())) == 5:
                    rows.append([name, mesh, *cells])
            page.figure("png", (programs.folder / "families.png").read_bytes(),
                        f"{name}, {mesh}, by {', '.join(row[2] for row in rows if row[:2] == [name, mesh])}.")
    page.table("Distortion of the model's surface, by area: mean, and what 99 % do not exceed; triangles inside out.",
               ["model", "cage", "coordinates", "mean", "99 %", "volume, of that at rest", "inverted"], rows)


def add_scaling(page, programs, arguments):
    page.heading("Time and memory by the model's size",
                 "The creature, its triangles cut into four again and again. The voxels, the closing and the cage are "
                 "the same each time, so that what grows is reading, voxelizing, the trees over the triangles and the "
                 "certificate.")
    points, faces = points_and_faces(programs.folder / "creature.obj")
    triangles = np.array([[face[0], face[i], face[i + 1]] for face in faces for i in range(1, len(face) - 1)])
    stages = ["read", "voxelize", "guard", "decimate", "tighten", "certify"]
    rows, counts, times, others, memory = [], [], [], [], []
    for i in range(arguments.divisions + 1):
        if i > 0:
            points, triangles = divided(points, triangles)
        write_ply(programs.folder / "divided.ply", points, triangles)
        [run] = programs.bench("divided.ply", "--resolutions", 64)
        spent = run["stage_seconds"]
        counts.append(len(triangles))
        times.append(run["wall_seconds"])
        others.append(run["wall_seconds"] - spent["decimate"] - spent["tighten"])
        memory.append(run["memory_peak_mib"])
        rows.append([len(triangles), *(seconds(spent.get(stage)) for stage in stages), seconds(run["wall_seconds"]),
                     f"{run['memory_peak_mib']:.0f}"])
    page.table("Seconds by stage of a bounding run of 400 faces in 64 voxels, and memory in MiB.",
               ["triangles", *stages, "total", "MiB"], rows)
    page.plots("triangles of the model", [
        ("Time", "seconds", [("a whole run", counts, times, False),
                             ("all but decimate, tighten", counts, others, False)]),
        ("Memory", "MiB", [("a whole run", counts, memory, False)])], "Time and memory against the triangles.")


def main():
    def numbers(text):
        return [int(number) for number in text.split(",")]

    parser = argparse.ArgumentParser(description=__doc__)
    known = ["bishop", "bench", "creature", "botijo"]
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True, help="the page to write")
    parser.add_argument("--programs", type=pathlib.Path, default="build/release/bin", help="their folder [%(default)s]")
    parser.add_argument("--models", nargs="+", choices=known, default=known)
    parser.add_argument("--resolutions", type=numbers, default="32,64,128,256,512,1024", help="of stages [%(default)s]")
    parser.add_argument("--whole-runs", type=int, default=256, help="the finest resolution of whole runs [%(default)s]")
    parser.add_argument("--divisions", type=int, default=3, help="times that triangles are cut into four [%(default)s]")
    parser.add_argument("--voxelizers", default="cpu,gl,cgal", help="cgal needs the GPL part [%(default)s]")
    parser.add_argument("--threads", type=int, default=len(os.sched_getaffinity(0)), help="[all]")
    arguments = parser.parse_args()
    least = max(RESOLUTIONS[0], min(arguments.resolutions))
    if arguments.whole_runs < least:
        parser.error(f"--whole-runs: {arguments.whole_runs} is not allowed; it must be {least} or more")
    matplotlib.use("svg")
    with tempfile.TemporaryDirectory() as folder:
        programs = Programs(arguments.programs, pathlib.Path(folder), arguments.threads)
        programs.run("vdbcage-data", ".", *{*arguments.models, "bishop", "creature"})
        page = Page()
        add_machine(page, programs, arguments)
        add_stages(page, programs, arguments)
        add_voxelizers(page, programs, arguments)
        page.heading("Cages by resolution",
                     "In the paper the resolution decides how close a cage is: the surface of the voxels is all there "
                     "is, and what was dilated and not eroded stays as an offset. Here the cage is tightened onto the "
                     "model itself. So it hugs the model in 32 voxels as in 128, and twice the voxels never make it "
                     "looser.")
        add_cages(page, programs, arguments, "voxels", {
            str(n): ["--resolution", n] for n in RESOLUTIONS if n <= arguments.whole_runs})
        page.heading("Smoothing",
                     "The paper smooths the surface of the voxels before it is decimated, 3 times by default. Plain "
                     "cages do so here. Bounding ones are smoothed at the end, each vertex as far as the guard allows, "
                     "so that they grow rounder and looser, and stay certified.")
        add_cages(page, programs, arguments, "sweeps", {str(n): ["--smooth", n] for n in [0, 3, 9]})
        page.heading("Triangles and tri-quad",
                     "Tri-quad cages have quads where two triangles are flat enough. As a quad counts once, they have "
                     "more vertices for as many faces. In bounding ones every quad is convex and holds the model under "
                     "both of its diagonals.")
        add_cages(page, programs, arguments, "faces", {
            "triangles": ["--mesh", "triangles"], "tri-quad": ["--mesh", "triquad"]})
        add_poses(page, programs, arguments)
        add_scaling(page, programs, arguments)
    arguments.output.write_text(page.text("vdbcage beside the paper it implements"))


if __name__ == "__main__":
    main()
