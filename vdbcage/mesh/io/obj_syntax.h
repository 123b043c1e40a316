#pragma once

#include <cstdint>
#include <string_view>

#include <vdbcage/mesh/io/text_cursor.h>

/// What the two readers of OBJ files share. One makes a Mesh, the other replaces positions in the text.
namespace vdbcage::detail {

constexpr TextSyntax objSyntax{'#', /*continuesLines=*/true};

/// Whether it is a statement of names. The last may be a path that ends with a backslash, which continues no line.
inline bool isObjNameStatement(std::string_view keyword)
{
    return keyword == "o" || keyword == "g" || keyword == "usemtl" || keyword == "mtllib" || keyword == "usemap" ||
           keyword == "maplib";
}

inline bool isObjFace(std::string_view keyword)
{
    return keyword == "f" || keyword == "fo";
}

/// One corner of a face: v, v/vt, v//vn or v/vt/vn, as it stands; 0 for what is not given.
struct ObjCorner {
    std::int64_t point = 0, texture = 0, normal = 0;
    int form = 0; ///< the same for corners that give the same parts
};

/// Reads a corner as far as it is one. False if there is none.
inline bool readObjCorner(TextCursor& in, ObjCorner& corner)
{
    if (!in.integerPrefix(corner.point)) return false;
    if (!in.skipCharacter('/')) return true;
    corner.form = 1;
    if (in.integerPrefix(corner.texture)) corner.form += 1;
    if (!in.skipCharacter('/')) return true;
    corner.form += 2;
    if (in.integerPrefix(corner.normal)) corner.form += 2;
    return true;
}

} // namespace vdbcage::detail
