// vdbcage-data DIR [NAME...]: writes our own models as OBJ files into DIR, the same bytes on every machine.

#include <cstdio>
#include <cstring>
#include <exception>

#include "model.h"

namespace {

struct Entry {
    const char* name;
    const char* about;
    data::Model (*make)();
    bool byDefault;
};

const Entry entries[] = {
    {"bishop", "A lathed chess bishop with its mitre slot: one closed skin, genus 0.", data::makeBishop, true},
    {"bench", "A slatted park bench: closed parts that touch and overlap.", data::makeBench, true},
    {"botijo", "A Spanish water jug, hollow: one closed skin, genus 5.", data::makeBotijo, true},
    {"creature", "An ibex: one closed organic skin, genus 0.", data::makeCreature, true},
    {"open_shell", "A cloak without thickness: an open sheet with three boundary loops.", data::makeOpenShell, true},
    {"soup", "A heap of broken parts: intersecting, non-manifold, flipped, doubled and degenerate faces.",
     data::makeSoup, true},
    {"creature_2m", "The ibex in about two million triangles, for benchmarks.", data::makeCreature2m, false},
};

const Entry* find(const char* name)
{
    for (const Entry& entry : entries)
        if (std::strcmp(entry.name, name) == 0) return &entry;
    return nullptr;
}

void write(const Entry& entry, const std::filesystem::path& folder)
{
    data::writeObj(entry.make(), entry.about, folder / (std::string(entry.name) + ".obj"));
}

} // namespace

int main(int argc, char** argv)
{
    const bool asksForHelp = argc == 2 && (std::strcmp(argv[1], "--help") == 0 || std::strcmp(argv[1], "-h") == 0);
    if (argc < 2 || argv[1][0] == '-') {
        std::fputs("usage: vdbcage-data DIR [NAME...]\nWithout a name, all but those marked *:\n", stderr);
        for (const Entry& entry : entries)
            std::fprintf(stderr, "  %-12s%c %s\n", entry.name, entry.byDefault ? ' ' : '*', entry.about);
        return asksForHelp ? 0 : 1;
    }
    for (int i = 2; i < argc; ++i) {
        if (!find(argv[i])) {
            std::fprintf(stderr, "vdbcage-data: no model is named '%s'\n", argv[i]);
            return 1;
        }
    }
    try {
        std::filesystem::create_directories(argv[1]);
        for (const Entry& entry : entries)
            if (argc == 2 && entry.byDefault) write(entry, argv[1]);
        for (int i = 2; i < argc; ++i) write(*find(argv[i]), argv[1]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "vdbcage-data: %s\n", error.what());
        return 1;
    }
    return 0;
}
