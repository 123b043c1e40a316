"""Volumes as bytes: right .vdb files, and wrong ones."""

import struct


def text(word):
    return struct.pack("<I", len(word)) + word.encode()


def scale_map(scale=1.0, twice=2.0):
    """The transform of equal voxels: the scale, and what follows from it."""
    numbers = [scale] * 3 + [scale] * 3 + [1 / scale] * 3 + [1 / scale ** 2] * 3 + [1 / scale / twice] * 3
    return text("UniformScaleMap") + struct.pack("<15d", *numbers)


def frustum(depth=1.0):
    return text("NonlinearFrustumMap") + struct.pack("<8d", 0, 0, 0, 10, 10, 10, 0.5, depth) + scale_map()


def mask(*bits, size):
    words = bytearray(size // 8)
    for bit in bits:
        words[bit // 8] |= 1 << bit % 8
    return bytes(words)


def tile(value=1.0, origin=(0, 0, 0), active=1):
    return struct.pack("<3i", *origin) + (struct.pack("<f", value) if isinstance(value, float) else value) + \
        bytes([active])


def node(leaf_mask=None, buffer_mask=None, code=0, stored=None, children=(0,), active=(), upper=b"", origin=(0, 0, 0),
         leaf_origin=b""):
    """One leaf node with its values, and the nodes above it."""
    leaf_mask = mask(*range(60), size=512) if leaf_mask is None else leaf_mask
    nodes = struct.pack("<3i", *origin)
    nodes += mask(*children, size=32768) + mask(*active, size=32768) + bytes([0]) + upper
    nodes += mask(0, size=4096) + mask(size=4096) + bytes([0]) + upper
    nodes += leaf_mask
    values = (leaf_mask if buffer_mask is None else buffer_mask) + leaf_origin
    return nodes, values + bytes([code]) + (struct.pack("<60f", *[1] * 60) if stored is None else stored)


def tree(tiles=(), child=None, background=struct.pack("<f", 0), buffers=1, children=None):
    nodes, values = child or (b"", b"")
    return struct.pack("<i", buffers) + background + \
        struct.pack("<2I", len(tiles), (child is not None) if children is None else children) + \
        b"".join(tiles) + nodes + values


def grid(body=None, compression=2, metadata=b"\0\0\0\0", transform=None):
    return struct.pack("<I", compression) + metadata + (transform or scale_map()) + \
        (tree(tiles=[tile()]) if body is None else body)


def volume(*grids, version=224, offsets=1, count=None, begin=0, longer=0, shorter=0):
    """A file of grids: name, type, parent, bytes of the grid."""
    start = struct.pack("<q", 0x56444220) + struct.pack("<3I", version, 10, 0) + bytes([offsets]) + b"u" * 36
    start += struct.pack("<I", 0) + struct.pack("<i", len(grids) if count is None else count)
    for name, kind, parent, body in grids:
        start += text(name) + text(kind) + text(parent)
        at = len(start) + 24
        start += struct.pack("<3q", at + begin, at, at + len(body) + longer - shorter) + body
    return start + b"\0" * longer


def floats(body=None, name="density", **of_file):
    return volume((name, "Tree_float_5_4_3", "", grid(body) if body is not None else grid()), **of_file)


def one(**of_grid):
    return volume(("density", "Tree_float_5_4_3", "", grid(**of_grid)))
