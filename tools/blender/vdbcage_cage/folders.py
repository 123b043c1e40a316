# SPDX-License-Identifier: Apache-2.0 OR GPL-3.0-or-later
"""Where files go that a .blend needs later."""

import os

import bpy

from .command import CommandError


def folder(chosen, default, what):
    """The folder that the user chose, or else `default`, beside the .blend. An absolute path. Raises CommandError."""
    if not chosen:
        if not bpy.data.filepath:
            raise CommandError(f"{what} beside the .blend. Save it first, or choose a folder")
        chosen = f"//{default}"
    return os.path.abspath(bpy.path.abspath(chosen))


def stored(path):
    """A path as the .blend keeps it: relative to itself, so that both can be moved, where that is possible."""
    here = bpy.data.filepath
    if not here or os.path.splitdrive(path)[0] != os.path.splitdrive(here)[0]:  # Windows: it is on another drive
        return path
    return bpy.path.relpath(path)
