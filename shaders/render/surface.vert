#version 450 core
// Faces of a mesh, for shading, for depth alone or for a tint.

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 pointColour; // sRGB

uniform mat4 toClip;
uniform mat4 toView; // a rotation and a shift; the eye is at the origin and looks along -z

out vec3 viewPosition;
out vec3 viewNormal;
out vec3 ownColour;

void main()
{
    viewPosition = (toView * vec4(position, 1.0)).xyz;
    viewNormal = mat3(toView) * normal;
    ownColour = pointColour;
    gl_Position = toClip * vec4(position, 1.0);
}
