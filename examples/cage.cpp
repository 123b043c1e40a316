// Makes a cage of at most 200 triangles around a model:  example_cage model.obj cage.obj

#include <iostream>

#include <vdbcage/check/check.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/mesh_io.h>
#include <vdbcage/pipeline/pipeline.h>

int main(int count, char** words)
try {
    if (count != 3) throw vdbcage::InputError("usage: example_cage MODEL CAGE");
    const vdbcage::Mesh model = vdbcage::readMesh(words[1]);

    vdbcage::CageOptions options;
    options.faces = 200;
    options.precision = vdbcage::precisionOf(words[2]); // .stl holds float32: certified as the file will have it
    const vdbcage::Mesh cage = vdbcage::makeCage(model, options);
    vdbcage::writeMesh(cage, words[2]);

    // makeCage() returns certified cages only. The same proof, for any mesh as a cage of any model:
    const vdbcage::CageCheck check = vdbcage::checkCage(vdbcage::readMesh(words[2]), model);
    std::cout << check.triangles << " triangles, " << (check.bounding() ? "bounding" : "NOT bounding")
              << ", mean distance to the model " << 100 * check.meanDistance << " % of its longest side\n";
    return check.bounding() && check.triangles <= 200 ? 0 : 1;
} catch (const vdbcage::Error& error) { // of a file or an option, in one line
    std::cerr << "example_cage: " << error.what() << '\n';
    return 1;
}
