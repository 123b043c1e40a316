"""Twists a model by its cage, with NumPy:  python3 twist.py model.obj twisted.obj"""

import sys

import numpy

import vdbcage


def twisted(points, bottom, top):
    """Turns points around the y axis: not at all at the height `bottom`, by a quarter turn at `top`."""
    x, y, z = points.T
    angle = numpy.pi / 2 * numpy.clip((y - bottom) / (top - bottom), 0, 1)
    return numpy.stack([x * numpy.cos(angle) + z * numpy.sin(angle), y, z * numpy.cos(angle) - x * numpy.sin(angle)], 1)


def main(model_path, twisted_path):
    model = vdbcage.Mesh.read(model_path)
    cage = vdbcage.make_cage(model, faces=200)
    bottom, top = model.points[:, 1].min(), model.points[:, 1].max()

    # Binding computes the weights once, which takes longest. Each pose is then a product with them.
    binding = vdbcage.Binding(cage, model.points)
    cage_points = twisted(cage.points, bottom, top)
    posed = binding.pose(cage_points)
    vdbcage.Mesh(posed, model.triangles, model.quads).write(twisted_path)

    # The same by hand: a row a point of the model, a column a point of the cage.
    weights = binding.weights()
    size = numpy.ptp(model.points, 0).max()
    by_hand = numpy.abs(weights @ cage_points - posed).max() / size
    difference = numpy.abs(twisted(model.points, bottom, top) - posed).max() / size
    print(f"{len(posed)} points, {weights.shape[1]} weights each; within {difference:.3f} of the twist itself")
    return 0 if cage.check.bounding and by_hand < 1e-5 and difference < 0.1 else 1


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    try:
        sys.exit(main(*sys.argv[1:]))
    except vdbcage.Error as error:  # of a file or an argument, in one line
        sys.exit(f"twist.py: {error}")
