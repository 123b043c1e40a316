#version 450 core
// The rectangle of an item as two triangles, in a picture that has a pixel for each column. All corners of pixels are
// far from their centres, so the rasterizer makes exactly the item's pixels, each once, however it rounds.

#include "item.glsl"

uniform int firstPlane;
uniform vec2 perPixel; // 2 / size of the picture

flat out int item;

void main()
{
    item = gl_VertexID / 6;
    const int corner = int[6](0, 1, 2, 2, 1, 3)[gl_VertexID % 6];
    const ivec4 columns = columnsOf(item);
    const ivec2 pixel = ivec2((corner & 1) == 0 ? columns.z : columns.w + 1,
                              ((corner & 2) == 0 ? columns.x : columns.y + 1) - firstPlane);
    gl_Position = vec4(vec2(pixel) * perPixel - 1.0, 0.0, 1.0);
}
