#version 450 core
// One column of an item, a pixel: nothing is drawn, the voxels go into an image of words.

#include "item.glsl"

layout(binding = 0, r32ui) uniform uimageBuffer grid;

flat in int item;

#include "face.glsl"

void orWord(int at, uint bits)
{
    imageAtomicOr(grid, at, bits);
}

void xorWord(int at, uint bits)
{
    imageAtomicXor(grid, at, bits);
}

void main()
{
    const Face face = makeFace(cornerOf(item, 0), cornerOf(item, 1), cornerOf(item, 2), isCounted(item));
    const ivec2 column = ivec2(gl_FragCoord.yx) + ivec2(firstPlane, 0) - face.middle.xy;
    const Row row = makeRow(face, column.x);
    if (row.touchedY.x <= column.y && column.y <= row.touchedY.y) scanColumn(face, row, column.y);
}
