#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <tools/draw/colour.h>
#include <tools/draw/geometry.h>
#include <vdbcage/gl/objects.h>

namespace vdbcage::draw {

/// The look of one face, beside that of its layer.
struct FaceLook {
    /// Flags can be combined; selected is drawn over marked.
    enum Flag : std::uint8_t { plain = 0, marked = 1, selected = 2 };

    std::array<std::uint8_t, 3> colour{255, 255, 255}; ///< sRGB, a factor of the layer's colour
    std::uint8_t flags = plain;
};

/// A Geometry in a device's memory, made once. Points, colours and looks are replaced without remaking it; a shape
/// whose points were replaced makes the bytes of a new one that has the same sharp edges. Its context must be current
/// whenever it is made, changed, drawn and destroyed, and must outlive it.
class Shape {
public:
    /// \throw DeviceError (out of memory)
    Shape(const gl::Api& api, Geometry geometry);

    const Geometry& geometry() const { return geometry_; }

    /// Calls Geometry::setPoints and uploads the result: 24 bytes per vertex and 24 per edge. \throw InputError
    void setPoints(const std::vector<openvdb::Vec3d>& points);

    /// Sets a colour for each point of the mesh, a factor of the layer's colour; empty: none.
    /// \throw InputError if there is neither none nor one for each; DeviceError
    void setPointColours(const std::vector<Colour>& colours);

    /// Sets a look for each face of the mesh, triangles first; empty: all have their layer's look. Uploads 4 bytes per
    /// face.
    /// \throw InputError if there is neither none nor one for each; DeviceError
    void setFaceLooks(const std::vector<FaceLook>& looks);

    /// Draws with the program in use: attributes 0 to 2 are position, normal and colour of points.
    void drawFaces() const;
    /// Draws four corners of a strip for each edge; attributes 0 and 1 are its ends.
    void drawEdges() const;
    /// Returns the looks as a buffer texture of GL_RGBA8UI; of name 0 if there are none.
    const gl::Texture& looks() const { return looksTexture_; }

private:
    std::vector<std::array<Vec3f, 2>> segments() const;

    const gl::Api* api_;
    Geometry geometry_;
    gl::Buffer positions_, normals_, indices_, segments_;
    gl::Buffer colours_; ///< one per vertex, or a single white
    gl::Buffer looks_;
    gl::Texture looksTexture_;
    gl::VertexArray faces_, edges_;
};

} // namespace vdbcage::draw
