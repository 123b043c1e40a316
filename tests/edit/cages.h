#pragma once

#include <map>
#include <string>
#include <utility>

#include <vdbcage/mesh/mesh_io.h>
#include <vdbcage/pipeline/pipeline.h>

namespace vdbcage::test {

/// A model of data/ and its cages, made once.
class CagedModel {
public:
    explicit CagedModel(const std::string& name)
        : pipeline_(readMesh(std::string(VDBCAGE_SOURCE_DIR "/data/") + name + ".obj"))
    {
    }

    const Mesh& model() const { return pipeline_.model(); }
    const Mesh& cage(int faces, CageFaces kind = CageFaces::triangles)
    {
        const auto found = cages_.find({faces, kind});
        if (found != cages_.end()) return found->second;
        CageOptions options;
        options.faces = faces;
        options.mesh = kind;
        options.effort = Effort::fast;
        return cages_[{faces, kind}] = pipeline_.run(options);
    }

private:
    Pipeline pipeline_;
    std::map<std::pair<int, CageFaces>, Mesh> cages_;
};

inline CagedModel& caged(const char* name)
{
    static std::map<std::string, CagedModel> models;
    const auto found = models.find(name);
    return found != models.end() ? found->second : models.emplace(name, CagedModel(name)).first->second;
}

} // namespace vdbcage::test
