"""Runs unittest modules of this folder: blender --background --factory-startup --python run.py -- test_make"""

import pathlib
import sys
import unittest

sys.dont_write_bytecode = True  # Blender 4.3 leaves Python's variables of the environment alone
sys.path.insert(0, str(pathlib.Path(__file__).parent))
names = sys.argv[sys.argv.index("--") + 1:]
unittest.main(module=None, argv=["blender", "-v", *names])
