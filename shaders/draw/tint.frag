#version 450 core
// Faces of one plain colour.

layout(location = 0) out vec4 result;

#include "face.glsl"

void main()
{
    result = faceColour();
}
