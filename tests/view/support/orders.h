#pragma once

#include <memory>

#include <support/shapes.h>
#include <tools/view/jobs/cage_result.h>
#include <tools/view/state/opened_mesh.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage::test {

inline view::OpenedMeshPtr opened(Mesh mesh, const std::string& name = "/no/model.obj")
{
    view::OpenedMesh file;
    file.path = name;
    file.mesh = std::move(mesh);
    return std::make_shared<const view::OpenedMesh>(std::move(file));
}

inline view::PosableCagePtr posable(const view::MeshPtr& cage)
{
    return std::make_shared<view::PosableCage>(cage);
}

inline view::PosableCagePtr posable(Mesh cage)
{
    return posable(std::make_shared<const Mesh>(std::move(cage)));
}

inline view::Order orderOf(const view::OpenedMeshPtr& model, int faces, Effort effort = Effort::fair)
{
    view::Order order;
    order.model = model;
    order.options.faces = faces;
    order.options.effort = effort;
    return order;
}

} // namespace vdbcage::test
