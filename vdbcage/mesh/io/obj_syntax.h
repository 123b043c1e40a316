#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

#include <vdbcage/mesh/io/text_cursor.h>

/// Code shared by the two readers of OBJ files. One makes a Mesh, the other replaces positions in the text.
namespace vdbcage::detail {

constexpr TextSyntax objSyntax{'#', /*continuesLines=*/true};

/// Returns whether the format has this keyword, in any of its versions.
inline bool isObjKeyword(std::string_view word)
{
    constexpr std::array<std::string_view, 45> keywords{
        "vn",     "vt",     "vp",   "v",      "f",      "fo",       "s",        "g",          "o",
        "usemtl", "mtllib", "p",    "l",      "curv",   "curv2",    "surf",     "mg",         "cstype",
        "deg",    "bmat",   "step", "parm",   "trim",   "hole",     "scrv",     "sp",         "end",
        "con",    "bevel",  "lod",  "usemap", "maplib", "c_interp", "d_interp", "shadow_obj", "trace_obj",
        "ctech",  "stech",  "call", "csh",    "bsp",    "bzp",      "cdc",      "cdp",        "res"};
    return std::find(keywords.begin(), keywords.end(), word) != keywords.end();
}

/// Returns whether a statement that begins with `word` ends with its line, even after a backslash. Statements of names
/// do, since the last name may be a path that ends with a backslash, and so do remarks. Keywords of the format or of a
/// program are words of letters.
inline bool endsWithLine(std::string_view word)
{
    constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_";
    constexpr std::array<std::string_view, 6> ofNames{"o", "g", "usemtl", "mtllib", "usemap", "maplib"};
    return letters.find(word.front()) == std::string_view::npos ||
           std::find(ofNames.begin(), ofNames.end(), word) != ofNames.end();
}

inline bool isObjFace(std::string_view keyword)
{
    return keyword == "f" || keyword == "fo";
}

/// One corner of a face: v, v/vt, v//vn or v/vt/vn, as in the file; missing parts are 0.
struct ObjCorner {
    std::int64_t point = 0, texture = 0, normal = 0;
    int form = 0; ///< equal for corners that have the same parts
};

/// Reads a corner, as far as the text is one. Returns false if there is none.
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
