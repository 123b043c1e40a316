#version 450 core

in float strength;

uniform vec4 colour; // sRGB and opacity

layout(location = 0) out vec4 result;

void main()
{
    result = vec4(colour.rgb, colour.a * strength);
}
