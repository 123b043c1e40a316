#include <vdbcage/vdbcage.h>

int main(int, char** argv)
{
    const vdbcage::Mesh model = vdbcage::readMesh(argv[1]);
    vdbcage::CageOptions options;
    options.faces = 200;
    const vdbcage::Mesh cage = vdbcage::makeCage(model, options);
    vdbcage::writeMesh(cage, argv[2]);
    return vdbcage::checkCage(cage, model).bounding() ? 0 : 1;
}
