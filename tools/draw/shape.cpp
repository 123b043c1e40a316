#include <tools/draw/shape.h>

#include <string>
#include <utility>

#include <vdbcage/core/error.h>

namespace vdbcage::draw {

namespace {

static_assert(sizeof(FaceLook) == 4, "a texel of GL_RGBA8UI");

constexpr auto vectorSize = static_cast<GLsizei>(sizeof(Vec3f));

template <typename Value>
gl::Buffer makeReplaceable(const gl::Api& api, const std::vector<Value>& values)
{
    return gl::makeBuffer(api, values.size() * sizeof(Value), values.data(), GL_DYNAMIC_STORAGE_BIT);
}

template <typename Value>
void replace(const gl::Api& api, const gl::Buffer& buffer, const std::vector<Value>& values)
{
    if (values.empty()) return;
    api.NamedBufferSubData(buffer.name(), 0, static_cast<GLsizeiptr>(values.size() * sizeof(Value)), values.data());
}

/// Makes attribute `attribute` of `layout` take three floats from binding `binding`, `offset` bytes into each element.
void describe(const gl::Api& api, const gl::VertexArray& layout, GLuint attribute, GLuint binding, GLuint offset)
{
    api.VertexArrayAttribFormat(layout.name(), attribute, 3, GL_FLOAT, GL_FALSE, offset);
    api.VertexArrayAttribBinding(layout.name(), attribute, binding);
    api.EnableVertexArrayAttrib(layout.name(), attribute);
}

void requireOneForEach(const char* what, std::size_t given, const char* of, std::size_t count)
{
    if (given == 0 || given == count) return;
    throw InputError("picture", std::to_string(given) + " " + what + " were given for a mesh of " +
                                    std::to_string(count) + " " + of + "; none or one for each is needed");
}

} // namespace

Shape::Shape(const gl::Api& api, Geometry geometry)
    : api_(&api), geometry_(std::move(geometry)), positions_(makeReplaceable(api, geometry_.positions())),
      normals_(makeReplaceable(api, geometry_.normals())), indices_(gl::makeBuffer(api, geometry_.triangles())),
      segments_(makeReplaceable(api, segments())), faces_(gl::makeVertexArray(api)), edges_(gl::makeVertexArray(api))
{
    api.VertexArrayVertexBuffer(faces_.name(), 0, positions_.name(), 0, vectorSize);
    api.VertexArrayVertexBuffer(faces_.name(), 1, normals_.name(), 0, vectorSize);
    for (GLuint attribute = 0; attribute < 3; ++attribute) describe(api, faces_, attribute, attribute, 0);
    api.VertexArrayElementBuffer(faces_.name(), indices_.name());
    setPointColours({});

    api.VertexArrayVertexBuffer(edges_.name(), 0, segments_.name(), 0, 2 * vectorSize);
    api.VertexArrayBindingDivisor(edges_.name(), 0, 1);
    describe(api, edges_, 0, 0, 0);
    describe(api, edges_, 1, 0, static_cast<GLuint>(vectorSize));
    gl::throwIfFailed(api, "making a shape");
}

void Shape::setPoints(const std::vector<openvdb::Vec3d>& points)
{
    geometry_.setPoints(points);
    replace(*api_, positions_, geometry_.positions());
    replace(*api_, normals_, geometry_.normals());
    replace(*api_, segments_, segments());
}

void Shape::setPointColours(const std::vector<Colour>& colours)
{
    requireOneForEach("colours", colours.size(), "points", geometry_.pointCount());
    std::vector<Colour> own;
    for (const Geometry::Index point : geometry_.pointOfVertex()) {
        if (!colours.empty()) own.push_back(colours[point]);
    }
    const bool single = own.empty();
    if (single) own.push_back({1, 1, 1});
    colours_ = gl::makeBuffer(*api_, own);
    api_->VertexArrayVertexBuffer(faces_.name(), 2, colours_.name(), 0, vectorSize);
    // With a divisor all vertices of the single instance take the first colour.
    api_->VertexArrayBindingDivisor(faces_.name(), 2, single ? 1 : 0);
}

void Shape::setFaceLooks(const std::vector<FaceLook>& looks)
{
    requireOneForEach("looks", looks.size(), "faces", geometry_.triangleCount() + geometry_.quadCount());
    looksTexture_ = gl::Texture();
    looks_ = gl::Buffer();
    if (looks.empty()) return;
    looks_ = gl::makeBuffer(*api_, looks);
    looksTexture_ = gl::makeBufferTexture(*api_, GL_RGBA8UI, looks_);
}

void Shape::drawFaces() const
{
    api_->BindVertexArray(faces_.name());
    api_->DrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * geometry_.triangles().size()), GL_UNSIGNED_INT, nullptr);
}

void Shape::drawEdges() const
{
    api_->BindVertexArray(edges_.name());
    api_->DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(geometry_.edges().size()));
}

std::vector<std::array<Vec3f, 2>> Shape::segments() const
{
    std::vector<std::array<Vec3f, 2>> segments;
    segments.reserve(geometry_.edges().size());
    for (const auto& [from, to] : geometry_.edges()) {
        segments.push_back({geometry_.positions()[from], geometry_.positions()[to]});
    }
    return segments;
}

} // namespace vdbcage::draw
