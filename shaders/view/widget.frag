#version 450 core
// A widget's triangle. Its colours and those of its picture are times their alpha.

layout(binding = 0) uniform sampler2D picture;

in vec4 tint;
in vec2 at;

layout(location = 0) out vec4 result;

void main()
{
    result = tint * texture(picture, at);
}
