#version 450 core
// Faces of a mesh, for shading, for depth alone or for a tint.

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 pointColour; // sRGB

uniform vec4 origin;  // xyz: what the matrices count coordinates from
uniform vec4 section; // the same; what it gives less than 0 is cut off
uniform mat4 toClip;
uniform mat4 toView; // a rotation and a shift; the eye is at the origin and looks along -z

out vec3 viewPosition;
out vec3 viewNormal;
out vec3 ownColour;
out float gl_ClipDistance[1];

void main()
{
    const vec4 place = vec4(position - origin.xyz, 1.0);
    viewPosition = (toView * place).xyz;
    viewNormal = mat3(toView) * normal;
    ownColour = pointColour;
    gl_Position = toClip * place;
    gl_ClipDistance[0] = dot(section, place);
}
