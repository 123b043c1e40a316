// vdbcage-bench: costs and quality of cages, as JSON lines on standard output. Each whole run (`cage`, or no
// subcommand) is a process of its own; closing, voxelize, deform, fit and view run in this process. paper.py makes a
// page of them.

#include <cstdio>
#include <exception>
#include <string>

#include <vdbcage/core/error.h>

#include "bench.h"

int main(int argc, char** argv)
{
    using namespace vdbcage;
    try {
        if (argc > 1 && std::string(argv[1]) == "cage") return bench::runCage(argc, argv);
        if (argc > 1 && std::string(argv[1]) == "closing") return bench::runClosing(argc, argv);
        if (argc > 1 && std::string(argv[1]) == "voxelize") return bench::runVoxelize(argc, argv);
        if (argc > 1 && std::string(argv[1]) == "deform") return bench::runDeform(argc, argv);
        if (argc > 1 && std::string(argv[1]) == "fit") return bench::runFit(argc, argv);
        if (argc > 1 && std::string(argv[1]) == "view") {
#ifdef VDBCAGE_HAS_VIEW
            return bench::runView(argc, argv);
#else
            throw InputError("view", "this build was made without the window (VDBCAGE_BUILD_VIEW)");
#endif
        }
        return bench::runStages(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "vdbcage-bench: error: %s\n", error.what());
        return 1;
    }
}
