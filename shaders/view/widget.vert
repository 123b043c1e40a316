#version 450 core
// A corner of a widget's triangle.

layout(location = 0) in vec2 place;   // pixels from the top left
layout(location = 1) in vec2 texel;
layout(location = 2) in vec4 colour;  // not times its alpha

uniform vec2 size; // pixels of the target

out vec4 tint; // times its alpha
out vec2 at;

void main()
{
    tint = vec4(colour.rgb * colour.a, colour.a);
    at = texel;
    gl_Position = vec4(2.0 * place.x / size.x - 1.0, 1.0 - 2.0 * place.y / size.y, 0.0, 1.0);
}
