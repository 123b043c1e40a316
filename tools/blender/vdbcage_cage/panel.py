# SPDX-License-Identifier: Apache-2.0 OR GPL-3.0-or-later
"""The panel: 3D Viewport > Sidebar > Cage."""

import bpy

from . import links


class _Panel:
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Cage"


def _column(layout):
    layout.use_property_split = True
    layout.use_property_decorate = False
    return layout.column()


def _optional(column, settings, name):
    """A value behind a box to tick: off means that vdbcage chooses it."""
    row = column.row(heading=settings.bl_rna.properties[name].name)
    row.prop(settings, f"use_{name}", text="")
    value = row.row()
    value.active = getattr(settings, f"use_{name}")
    value.prop(settings, name, text="")


class VDBCAGE_PT_cage(_Panel, bpy.types.Panel):
    bl_label = "Cage"

    def draw(self, context):
        settings = context.scene.vdbcage
        column = _column(self.layout)
        column.prop(settings, "faces")
        column.prop(settings, "mesh")
        column.prop(settings, "effort")
        column.prop(settings, "surface")
        running = context.window_manager.vdbcage
        if running.is_active:
            column = self.layout.column()
            column.use_property_split = False
            progress = column.row()
            progress.enabled = False
            progress.prop(running, "percent", text=running.label, slider=True)
            column.operator("vdbcage.cancel", icon="CANCEL")
        else:
            row = self.layout.row()
            row.scale_y = 1.4
            row.operator("vdbcage.make_cage", icon="MESH_ICOSPHERE")
        self._facts(context)

    def _facts(self, context):
        """What is known of the cage of the active object."""
        thing = context.object
        if thing is None:
            return
        cage = thing if "vdbcage_report" in thing else links.cage_of(context, thing)
        if cage is None or "vdbcage_report" not in cage:
            return
        report = cage["vdbcage_report"]
        check = report["check"]
        box = self.layout.box().column(align=True)
        box.label(text=cage.name, icon="CHECKMARK" if check["bounding"] else "ERROR")
        faces = check["triangles"] + check["quads"]
        if report["kind"] == "fit":
            box.label(text=f"{faces} faces, {report['moved_points']} points moved")
            box.label(text="Certified when it was fitted")
        else:
            box.label(text=f"{faces} faces, made in {report['seconds']:.1f} s")
            box.label(text="Certified when it was made" if check["bounding"] else "Not certified")
        box.label(text=f"Distance {100 * check['mean_distance']:.2f} % of the size")


class VDBCAGE_PT_more(_Panel, bpy.types.Panel):
    bl_label = "More Options"
    bl_parent_id = "VDBCAGE_PT_cage"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        settings = context.scene.vdbcage
        column = _column(self.layout)
        _optional(column, settings, "resolution")
        _optional(column, settings, "close_radius")
        column.prop(settings, "smooth")
        column.prop(settings, "symmetry")
        column.prop(settings, "more")


class VDBCAGE_PT_fit(_Panel, bpy.types.Panel):
    bl_label = "Fit"
    bl_parent_id = "VDBCAGE_PT_cage"

    def draw(self, context):
        settings = context.scene.vdbcage_fit
        column = _column(self.layout)
        _cage(column, context)
        column.prop(settings, "tight", slider=True)
        cage = links.active_cage(context)
        if cage is None:
            column.prop(settings, "keep")
        else:
            column.prop_search(settings, "keep", cage, "vertex_groups")
        self.layout.operator("vdbcage.fit_cage", icon="MOD_SHRINKWRAP")


class VDBCAGE_PT_stages(_Panel, bpy.types.Panel):
    bl_label = "Stages"
    bl_parent_id = "VDBCAGE_PT_cage"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        column = _column(self.layout)
        column.prop(context.scene, "vdbcage_stages", text="Folder")
        self.layout.operator("vdbcage.show_stages", icon="VOLUME_DATA")


class VDBCAGE_PT_bind(_Panel, bpy.types.Panel):
    bl_label = "Bind"

    def draw(self, context):
        settings = context.scene.vdbcage_bind
        column = _column(self.layout)
        _cage(column, context)
        column.prop(settings, "method")
        if settings.method == "MESH_DEFORM":
            column.prop(settings, "precision")
            if settings.precision > 5:
                self.layout.label(text="Each step takes ten times as long", icon="TIME")
        row = self.layout.row(align=True)
        row.operator("vdbcage.bind", icon="LINKED")
        row.operator("vdbcage.rebind", icon="FILE_REFRESH")


class VDBCAGE_PT_pose(_Panel, bpy.types.Panel):
    bl_label = "Pose"

    def draw(self, context):
        settings = context.scene.vdbcage_pose
        column = _column(self.layout)
        column.prop(settings, "coordinates", text="By")
        column.prop(settings, "target")
        if settings.target == "POINT_CACHE":
            column.prop(settings, "directory")
            frames = column.column(align=True)
            frames.prop(context.scene, "frame_start", text="First Frame")
            frames.prop(context.scene, "frame_end", text="Last")
        row = self.layout.row(align=True)
        row.operator("vdbcage.pose", icon="SHAPEKEY_DATA" if settings.target == "SHAPE_KEY" else "FILE_CACHE")
        row.operator("vdbcage.set_rest", icon="LOOP_BACK")


def _cage(column, context):
    """Where the cage of the active model is chosen, also one that was drawn by hand."""
    thing = context.object
    if thing is not None and thing.type == "MESH":
        column.prop(thing.vdbcage, "cage")


CLASSES = (VDBCAGE_PT_cage, VDBCAGE_PT_fit, VDBCAGE_PT_more, VDBCAGE_PT_stages, VDBCAGE_PT_bind, VDBCAGE_PT_pose)
