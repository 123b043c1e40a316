"""The zip: installed, enabled, and fit for later versions of Blender."""

import ast
import re
import subprocess
import tomllib
import unittest
import zipfile

import addon_utils
import bpy
from support import ADDON, IS_EXTENSION, MODULE, SOURCE, Case

OPERATORS = {"bind", "cancel", "fit_cage", "make_cage", "pose", "rebind", "set_rest", "show_stages"}


class Addon(Case):
    def test_it_is_installed_and_can_be_disabled(self):
        self.assertEqual(set(dir(bpy.ops.vdbcage)), OPERATORS)
        bpy.ops.preferences.addon_disable(module=MODULE)
        self.assertEqual(set(dir(bpy.ops.vdbcage)), set())
        for kind, name in ((bpy.types.Scene, "vdbcage"), (bpy.types.Scene, "vdbcage_bind"),
                           (bpy.types.Scene, "vdbcage_fit"), (bpy.types.Scene, "vdbcage_pose"),
                           (bpy.types.Scene, "vdbcage_stages"),
                           (bpy.types.Object, "vdbcage"), (bpy.types.WindowManager, "vdbcage")):
            self.assertFalse(hasattr(kind, name), name)
        bpy.ops.preferences.addon_enable(module=MODULE)
        self.assertEqual(set(dir(bpy.ops.vdbcage)), OPERATORS)

    def test_every_operator_and_property_is_described(self):
        for name in OPERATORS:
            kind = getattr(bpy.ops.vdbcage, name).get_rna_type()
            self.assertTrue(kind.description, name)
            for one in kind.properties:
                if one.identifier != "rna_type":
                    self.assertTrue(one.name, (name, one.identifier))

    def test_the_zip_has_one_folder(self):
        with zipfile.ZipFile(ADDON) as zipped:
            names = [name for name in zipped.namelist() if not name.endswith("/")]
        self.assertTrue(all(name.startswith("vdbcage_cage/") for name in names), names)
        self.assertIn("vdbcage_cage/__init__.py", names)
        self.assertIn("vdbcage_cage/blender_manifest.toml", names)
        self.assertEqual(len(names), len(set(names)))

    def test_the_manifest_is_what_blender_4_2_asks_for(self):
        with zipfile.ZipFile(ADDON) as zipped:
            manifest = tomllib.loads(zipped.read("vdbcage_cage/blender_manifest.toml").decode())
        for key in ("schema_version", "id", "version", "name", "tagline", "maintainer", "type", "blender_version_min",
                    "license"):
            self.assertTrue(manifest[key], key)
        self.assertEqual(manifest["schema_version"], "1.0.0")
        self.assertEqual(manifest["type"], "add-on")
        self.assertEqual(manifest["blender_version_min"], "4.2.0")
        self.assertTrue(manifest["id"].isidentifier() and "__" not in manifest["id"])
        self.assertRegex(manifest["version"], r"^\d+\.\d+\.\d+$")
        self.assertIn("SPDX:GPL-3.0-or-later", manifest["license"])  # Blender's own site takes nothing else
        self.assertLessEqual(len(manifest["tagline"]), 64)
        self.assertRegex(manifest["tagline"], r"\w$")
        self.assertEqual(set(manifest["permissions"]), {"files"})
        for reason in manifest["permissions"].values():
            self.assertLessEqual(len(reason), 64)
            self.assertRegex(reason, r"\w$")
        self.assertLessEqual(set(manifest["tags"]), {"3D View", "Add Mesh", "Animation", "Import-Export", "Mesh",
                                                     "Modeling", "Object", "Rigging"})

    @unittest.skipUnless(IS_EXTENSION, "Blender before 4.2 has no extensions")
    def test_blender_takes_it_for_a_valid_extension(self):
        def extension(*words):
            done = subprocess.run([bpy.app.binary_path, "--command", "extension", *map(str, words)],
                                  stdin=subprocess.DEVNULL, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        extension("validate", ADDON)
        with zipfile.ZipFile(ADDON) as zipped:
            zipped.extractall(self.folder)
        extension("build", "--source-dir", self.folder / "vdbcage_cage", "--output-dir", self.folder)
        built, = self.folder.glob("*.zip")
        extension("validate", built)
        with zipfile.ZipFile(ADDON) as ours, zipfile.ZipFile(built) as theirs:
            self.assertEqual({name.removeprefix("vdbcage_cage/"): ours.read(name) for name in ours.namelist()},
                             {name: theirs.read(name) for name in theirs.namelist()})

    def test_all_versions_are_the_same(self):
        addon = next(module for module in addon_utils.modules() if module.__name__ == MODULE)
        version = ".".join(map(str, addon.bl_info["version"]))
        header = (SOURCE / "vdbcage" / "core" / "version.h").read_text()
        self.assertIn(f'#define VDBCAGE_VERSION "{version}"', header)
        with zipfile.ZipFile(ADDON) as zipped:
            self.assertEqual(tomllib.loads(zipped.read("vdbcage_cage/blender_manifest.toml").decode())["version"],
                             version)

    def test_other_blenders_can_read_it(self):
        """Python 3.10 is that of Blender 3.4. The rest are names that Blender 4 took away."""
        gone = r"calc_normals\b|use_auto_smooth|calc_normals_split|bpy\.ops\.[a-z_.]+\(\{|bgl\b|sys\.executable"
        with zipfile.ZipFile(ADDON) as zipped:
            for name in zipped.namelist():
                if name.endswith(".py"):
                    text = zipped.read(name).decode()
                    ast.parse(text, feature_version=(3, 10))
                    self.assertIsNone(re.search(gone, text), name)
