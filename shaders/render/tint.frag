#version 450 core

uniform vec4 colour; // sRGB and opacity

layout(location = 0) out vec4 result;

void main()
{
    result = colour;
}
