#version 450 core
// The columns of items one after the other, each item an invocation.

layout(local_size_x = 64) in;

#include "item.glsl"

layout(std430, binding = 1) buffer Grid {
    uint grid[];
};

uniform int itemCount;

#include "face.glsl"

void orWord(int at, uint bits)
{
    atomicOr(grid[at], bits);
}

void xorWord(int at, uint bits)
{
    atomicXor(grid[at], bits);
}

void main()
{
    const int item = int(gl_GlobalInvocationID.x);
    if (item >= itemCount) return;
    const Face face = makeFace(cornerOf(item, 0), cornerOf(item, 1), cornerOf(item, 2), isCounted(item));
    const ivec4 columns = columnsOf(item) - face.middle.xxyy;
    for (int x = columns.x; x <= columns.y; ++x) {
        const Row row = makeRow(face, x);
        const ivec2 ys = both(row.touchedY, columns.zw);
        for (int y = ys.x; y <= ys.y; ++y) scanColumn(face, row, y);
    }
}
