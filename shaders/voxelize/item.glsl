// The work, cut into items: a triangle and a rectangle of columns of its box.

layout(std430, binding = 0) readonly buffer Items {
    int items[]; // 12 each: three corners in lattice units, the rectangle's x and y (first + 65536 * last), counted
};

/// First and last x, then first and last y, of an item's columns.
ivec4 columnsOf(int item)
{
    const int x = items[12 * item + 9], y = items[12 * item + 10];
    return ivec4(x & 0xffff, x >> 16, y & 0xffff, y >> 16);
}

ivec3 cornerOf(int item, int corner)
{
    const int at = 12 * item + 3 * corner;
    return ivec3(items[at], items[at + 1], items[at + 2]);
}

/// Whether its crossings count.
bool isCounted(int item)
{
    return items[12 * item + 11] != 0;
}
