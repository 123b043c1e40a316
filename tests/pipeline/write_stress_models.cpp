// write_stress_models DIR: every stress model as an OFF file, so that other programs can judge its cages.

#include <exception>
#include <filesystem>
#include <iostream>

#include <vdbcage/mesh/mesh_io.h>

#include "stress_models.h"

int main(int argc, char** argv)
{
    if (argc != 2) {
        std::cerr << "usage: write_stress_models DIR\n";
        return 1;
    }
    try {
        const std::filesystem::path folder = argv[1];
        std::filesystem::create_directories(folder);
        for (const vdbcage::test::StressModel& model : vdbcage::test::stressModels()) {
            vdbcage::writeMesh(model.mesh, folder / (model.name + ".off"));
        }
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
        return 1;
    }
}
