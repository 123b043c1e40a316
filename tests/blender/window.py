"""The add-on in a window, by timers and events: see window.sh. Takes the pictures of blender.md on the way."""

import os
import pathlib
import struct
import sys
import traceback

import bpy
import numpy
from mathutils import Quaternion, Vector

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from documented import Documented  # noqa: E402
from support import BISHOP, COMMAND, MODULE, load, part, positions, preferences, select, set_positions  # noqa: E402

LONG = {"faces": 2000, "effort": "best", "mesh": "quads"}  # no machine is done before it is cancelled
pictures = pathlib.Path(sys.argv[sys.argv.index("--") + 1])


def check(holds, text):
    print(("ok: " if holds else "FAILED: ") + text, flush=True)
    if not holds:
        raise AssertionError(text)


class Window:
    """The window and its 3D viewport."""

    def __init__(self):
        self.window = bpy.context.window_manager.windows[0]
        self.area = next(area for area in self.window.screen.areas if area.type == "VIEW_3D")
        self.region, self.sidebar = (next(region for region in self.area.regions if region.type == kind)
                                     for kind in ("WINDOW", "UI"))
        self.space = self.area.spaces[0]

    def context(self):
        return bpy.context.temp_override(window=self.window, area=self.area, region=self.region)

    def event(self, kind, value, x, y):
        self.window.event_simulate(type=kind, value=value, x=x, y=y)

    def look(self, place, distance):
        """Looks from the left and a little from above."""
        view = self.space.region_3d
        view.view_rotation = Quaternion((0.62, 0.38, -0.36, -0.58)).normalized()
        view.view_location = Vector(place)
        view.view_distance = distance

    def picture(self, name):
        """Keeps what is on the display. By software Blender's own screenshots are black from 4.3 on."""
        xwd = (pictures / "Xvfb_screen0").read_bytes()
        header = struct.unpack(">25I", xwd[:100])
        start, width, height, row, colours = (header[i] for i in (0, 4, 5, 12, 19))
        rows = numpy.frombuffer(xwd, numpy.uint8, height * row, start + 12 * colours).reshape(height, row)
        pixels = rows[::-1, :4 * width].reshape(height, width, 4)[..., [2, 1, 0, 3]] / numpy.float32(255)
        pixels[..., 3] = 1
        check(pixels.std() > 0.1, f"there is something to see: {name}")
        image = bpy.data.images.new(name, width, height)
        image.pixels.foreach_set(pixels.ravel())
        image.filepath_raw, image.file_format = str(pictures / f"{name}.png"), "PNG"
        image.save()
        bpy.data.images.remove(image)


def running():
    return bpy.context.window_manager.vdbcage.is_active


def cages():
    return [thing.name for thing in bpy.data.objects if "vdbcage_report" in thing]


def temporary():
    return [name for name in os.listdir(bpy.app.tempdir) if not name.startswith("vdbcage_weights_")]


def invoke(window, operator, **options):
    with window.context():
        return operator("INVOKE_DEFAULT", **options)


def open_tab(window):
    """Opens the sidebar and clicks along its tabs until the panel is drawn."""
    panel = part("panel")

    drawn = []
    draw = panel.VDBCAGE_PT_cage.draw

    def drawing(self, context):
        drawn.append(True)
        draw(self, context)

    panel.VDBCAGE_PT_cage.draw = drawing
    window.space.show_region_ui = True
    yield
    bar = window.sidebar
    for y in range(bar.y + bar.height - 20, bar.y, -30):
        if drawn:
            break
        for kind, value in (("MOUSEMOVE", "NOTHING"), ("LEFTMOUSE", "PRESS"), ("LEFTMOUSE", "RELEASE")):
            window.event(kind, value, bar.x + bar.width - 12, y)
            yield  # Blender 5 takes no two at once
    panel.VDBCAGE_PT_cage.draw = draw
    check(bool(drawn), "the tab Cage is opened by a click")


def cancelling(window):
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    bpy.context.scene.vdbcage.mesh = "triangles"
    model = load(BISHOP)
    select(model)
    yield
    check(invoke(window, bpy.ops.vdbcage.make_cage, **LONG) == {"RUNNING_MODAL"}, "Make Cage returns at once")
    yield
    check(running() and cages() == [], "it runs")
    try:
        invoke(window, bpy.ops.vdbcage.make_cage)
        check(False, "a second one was started")
    except RuntimeError as error:
        check("A command of vdbcage still runs" in str(error), "a second one is refused meanwhile")
    model.location.x += 1
    with window.context():
        bpy.ops.view3d.view_selected()
    yield
    window.picture("running")
    bpy.ops.vdbcage.cancel()
    while running():
        yield
    check(cages() == [] and temporary() == [], "Cancel ends it and leaves nothing")

    invoke(window, bpy.ops.vdbcage.make_cage, **LONG)
    yield
    place = (window.region.x + 200, window.region.y + 200)
    window.event("ESC", "RELEASE", *place)  # what is left where Esc ended something else
    yield
    check(running(), "letting go of Esc does not end it")
    window.event("ESC", "PRESS", *place)
    while running():
        yield
    window.event("ESC", "RELEASE", *place)
    check(cages() == [] and temporary() == [], "Esc ends it and leaves nothing")

    invoke(window, bpy.ops.vdbcage.make_cage, **LONG)
    yield
    bpy.ops.preferences.addon_disable(module=MODULE)
    check(temporary() == [], "it ends with the add-on")
    bpy.ops.preferences.addon_enable(module=MODULE)
    preferences().command = COMMAND
    yield
    check(not running(), "and does not seem to run after that")

    other = load(BISHOP)
    select(model, other)
    invoke(window, bpy.ops.vdbcage.make_cage, faces=50)
    other.location.x += 5
    while running():
        yield
    check(cages() == [] and temporary() == [], "models that moved apart meanwhile get no cage")
    bpy.data.objects.remove(other)
    select(model)

    invoke(window, bpy.ops.vdbcage.make_cage, faces=50)
    bpy.data.objects.remove(model)
    while running():
        yield
    check(cages() == [] and temporary() == [], "a model that was deleted meanwhile gets no cage")

    model = load(BISHOP)
    select(model)
    bpy.context.scene.vdbcage.faces = 60
    invoke(window, bpy.ops.vdbcage.make_cage)
    while running():
        yield
    check(cages() == ["bishop Cage"] and temporary() == [], "the cage is made")
    cage = bpy.data.objects["bishop Cage"]
    check(len(cage.data.polygons) <= 60, "with what the panel shows")
    yield from fitting(window, cage)
    invoke(window, bpy.ops.vdbcage.pose, coordinates="mvc")
    bpy.data.objects.remove(cage)
    while running():
        yield
    check(model.data.shape_keys is None and temporary() == [], "a cage that was deleted meanwhile poses nothing")


def fitting(window, cage):
    """`cage` is a certified one, and its model is selected."""
    labels = set()

    def run():
        invoke(window, bpy.ops.vdbcage.fit_cage)
        while running():
            labels.add(bpy.context.window_manager.vdbcage.label)
            yield

    settings = bpy.context.scene.vdbcage_fit
    shape = 0.9 * positions(cage, world=False)  # it cuts the model
    set_positions(cage, shape)
    cage.vertex_groups.new(name="all").add(list(range(len(shape))), 1, "REPLACE")
    settings.keep = "all"
    yield from run()
    check(any(face.select for face in cage.data.polygons) and not all(face.select for face in cage.data.polygons),
          "faces that hold a cage back are selected")
    check("Fit Cage: fit" in labels, "the panel shows its stage")
    settings.keep = ""
    invoke(window, bpy.ops.vdbcage.fit_cage)
    cage.data.vertices[0].co.x += 0.01
    while running():
        yield
    check(cage["vdbcage_report"]["kind"] == "make", "a cage that was edited meanwhile is not fitted")
    set_positions(cage, shape)
    yield from run()
    check(cage["vdbcage_report"]["kind"] == "fit" and temporary() == [], "the cage is fitted")


def documented(window):
    """The pictures are what the page says."""
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    window.space.overlay.show_floor = window.space.overlay.show_axis_x = window.space.overlay.show_axis_y = False
    folder = pictures / "walk"
    folder.mkdir()
    docs = Documented(folder)
    window.look((0, 15, 68), 250)
    bpy.context.scene.vdbcage.mesh = "triquad"  # as the page says
    for text, picture in (("make_cage", "cage"), ("turn @", "bound"), ("SHAPE_KEY", "pose"), ("show_stages", "stages")):
        while True:
            with window.context():
                block = docs.run()
            yield
            if text in block:
                break
        if picture == "cage":
            model, cage = bpy.data.objects["creature"], bpy.data.objects["creature Cage"]
            rest = positions(model)
        if picture == "stages":
            for thing in bpy.data.collections["creature Stages"].objects:
                thing.hide_set(not thing.name.endswith("dilated"))
            cage.hide_set(True)
            model.modifiers[-1].show_viewport = False
        yield
        window.picture(picture)
    check(abs(positions(model) - rest).max() < 1e-3, "without its point cache the model is at rest")


def steps():
    window = Window()
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    yield
    yield from open_tab(window)
    yield from documented(window)
    yield from cancelling(window)


def tick(all_steps=steps()):
    try:
        next(all_steps)
        return 0.2
    except StopIteration:
        os._exit(0)
    except BaseException:
        traceback.print_exc()
        sys.stderr.flush()
        os._exit(1)


bpy.context.preferences.view.show_splash = False
preferences().command = COMMAND
bpy.app.timers.register(tick, first_interval=1)
