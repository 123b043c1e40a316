// vdbcage-bench: what cages cost and how good they are, as JSON lines on standard output. Each whole run (`cage`, or no
// subcommand) is a process of its own; closing, voxelize and deform run in this process.

#include <cstdio>
#include <exception>
#include <string>

#include "bench.h"

int main(int argc, char** argv)
{
    using namespace vdbcage;
    try {
        if (argc > 1 && std::string(argv[1]) == "cage") return bench::runCage(argc, argv);
        if (argc > 1 && std::string(argv[1]) == "closing") return bench::runClosing(argc, argv);
        if (argc > 1 && std::string(argv[1]) == "voxelize") return bench::runVoxelize(argc, argv);
        if (argc > 1 && std::string(argv[1]) == "deform") return bench::runDeform(argc, argv);
        return bench::runStages(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "vdbcage-bench: error: %s\n", error.what());
        return 1;
    }
}
