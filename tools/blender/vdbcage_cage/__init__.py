# SPDX-License-Identifier: Apache-2.0 OR GPL-3.0-or-later
"""Cages in Blender: made, fitted, bound, posed and looked into, by the command `vdbcage`."""

bl_info = {  # of Blender 3.4 to 4.1; later ones read blender_manifest.toml
    "name": "vdbcage",
    "description": "Coarse, tight cages that are certified to bound a model, and posing by them",
    "author": "The vdbcage authors",
    "version": (0, 2, 0),
    "blender": (3, 4, 0),
    "location": "3D Viewport > Sidebar > Cage",
    "category": "Rigging",
}

import bpy  # noqa: E402 (Blender reads bl_info first)

from . import bind, fit, links, make, panel, pose, running, stages  # noqa: E402

# Each has its CLASSES, and where they are kept its PROPERTIES: of what, by what name, and of what kind.
_modules = (links, running, make, fit, stages, bind, pose, panel)


def register():
    for module in _modules:
        for one in module.CLASSES:
            bpy.utils.register_class(one)
        for owner, name, kind in getattr(module, "PROPERTIES", ()):
            setattr(owner, name, kind)


def unregister():
    running.end(bpy.context)
    for module in reversed(_modules):
        for owner, name, _ in getattr(module, "PROPERTIES", ()):
            delattr(owner, name)
        for one in reversed(module.CLASSES):
            bpy.utils.unregister_class(one)
