#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include <tools/view/posing/posing.h>
#include <tools/view/state/commands/line.h>

/// Verbs that write a file of the scene's results. Each is a line (see line.h) with a writer:
///
///     static Write writer(const SaveSource& source, const fs::path& file); // \throw InputError nothing to write yet
namespace vdbcage::view {

/// The data that is saved.
struct SaveSource {
    const State& state;
    const PosableCagePtr& cage;
    const Planner& planner;
    const Posing& posing;
};

/// A function that writes the file, on any thread. \throw InputError, IoError, Cancelled
using Write = std::function<void(Interrupter*)>;

/// NAME FILE
struct SaveFile {
    static constexpr bool isRecorded = true;
    /// Whether it writes a file for each frame; its path gets a place for their numbers then (see files::patternFor).
    static constexpr bool isSequence = false;
    std::string path;

    SaveFile() = default;
    explicit SaveFile(std::string file) : path(std::move(file)) {}

    static std::string read(const Arguments& arguments) { return arguments[0]; }
    std::string text() const { return written(path); }
};

struct SavePosedCage : SaveFile {
    using SaveFile::SaveFile;
    static LineInfo info() { return {"save-posed-cage", "FILE", 1, 1, "writes the posed cage"}; }
    static Write writer(const SaveSource& source, const std::filesystem::path& file);
};
struct SavePosedModel : SaveFile {
    using SaveFile::SaveFile;
    static LineInfo info()
    {
        return {"save-posed-model", "FILE", 1, 1, "writes the model, posed by the cage; all else of an OBJ file stays"};
    }
    static Write writer(const SaveSource& source, const std::filesystem::path& file);
};
struct SavePosedCages : SaveFile {
    using SaveFile::SaveFile;
    static constexpr bool isSequence = true;
    static LineInfo info()
    {
        return {"save-posed-cages", "PATTERN", 1, 1,
                "writes the posed cage of every frame from the first key to the last: cage.%04d.obj"};
    }
    static Write writer(const SaveSource& source, const std::filesystem::path& file);
};
struct SavePosedModels : SaveFile {
    using SaveFile::SaveFile;
    static constexpr bool isSequence = true;
    static LineInfo info()
    {
        return {"save-posed-models", "PATTERN", 1, 1,
                "writes the posed model of every frame from the first key to the last: out.%04d.obj"};
    }
    static Write writer(const SaveSource& source, const std::filesystem::path& file);
};
struct SaveColours : SaveFile {
    using SaveFile::SaveFile;
    static LineInfo info()
    {
        return {"save-colours", "FILE.ply", 1, 1,
                "writes the posed model in its colours: influence, stretch or inverted"};
    }
    static Write writer(const SaveSource& source, const std::filesystem::path& file);
};
struct SaveWeights : SaveFile {
    using SaveFile::SaveFile;
    static LineInfo info()
    {
        return {"save-weights", "FILE.npy", 1, 1, "writes the weights by which the cage moves the model"};
    }
    static Write writer(const SaveSource& source, const std::filesystem::path& file);
};
struct SaveCage : SaveFile {
    using SaveFile::SaveFile;
    static LineInfo info() { return {"save-cage", "FILE", 1, 1, "writes the cage"}; }
    static Write writer(const SaveSource& source, const std::filesystem::path& file);
};
struct SaveReport : SaveFile {
    using SaveFile::SaveFile;
    static LineInfo info() { return {"save-report", "FILE.json", 1, 1, "writes options, times, memory and verdict"}; }
    static Write writer(const SaveSource& source, const std::filesystem::path& file);
};
struct SaveOptions : SaveFile {
    using SaveFile::SaveFile;
    static LineInfo info() { return {"save-options", "FILE", 1, 1, "writes the options, for `preset FILE`"}; }
    static Write writer(const SaveSource& source, const std::filesystem::path& file);
};

/// Returns the cage of the present options, or the one that was opened. \throw InputError naming the verb: it is not
/// there yet
CageResultPtr currentCage(const Planner& planner, const std::string& verb);

} // namespace vdbcage::view
