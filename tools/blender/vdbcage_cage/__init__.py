# SPDX-License-Identifier: Apache-2.0
"""Cages in Blender: made, bound, posed and looked into, by the command `vdbcage`."""

bl_info = {  # of Blender 3.4 to 4.1; later ones read blender_manifest.toml
    "name": "vdbcage",
    "description": "Coarse, tight cages that are certified to bound a model, and posing by them",
    "author": "The vdbcage authors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "3D Viewport > Sidebar > Cage",
    "category": "Rigging",
}

from . import bind, links, make, panel, pose, running, stages  # noqa: E402 (Blender reads bl_info first)

_modules = (links, running, make, stages, bind, pose, panel)


def register():
    for module in _modules:
        module.register()


def unregister():
    for module in reversed(_modules):
        module.unregister()
