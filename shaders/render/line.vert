#version 450 core
// One line segment an instance, drawn as a strip of four corners: a rectangle on the screen of constant width.

layout(location = 0) in vec3 from;
layout(location = 1) in vec3 to;

uniform mat4 toClip;
uniform vec4 eye;       // xyz: where the eye is; w: the part of the way to it by which lines stand out of faces
uniform vec2 viewport;  // pixels
uniform float width;    // pixels
uniform float fadeLength; // pixels; edges fade out as they get shorter than this, 0: they do not

out float strength;

vec4 project(vec3 point)
{
    return toClip * vec4(mix(point, eye.xyz, eye.w), 1.0);
}

void main()
{
    const vec4 ends[2] = vec4[2](project(from), project(to));
    const vec2 first = ends[0].xy / ends[0].w * 0.5 * viewport;
    const vec2 second = ends[1].xy / ends[1].w * 0.5 * viewport;
    const float span = distance(first, second);
    const vec2 along = span > 1e-6 ? (second - first) / span : vec2(1.0, 0.0);
    const vec2 across = vec2(-along.y, along.x);

    const int end = gl_VertexID & 1;
    const float side = (gl_VertexID & 2) == 0 ? -0.5 : 0.5;
    // Half a width beyond both ends, so that lines which meet leave no notch.
    const vec2 shift = width * (side * across + (end == 0 ? -0.5 : 0.5) * along);
    vec4 corner = ends[end];
    corner.xy += shift / (0.5 * viewport) * corner.w;
    gl_Position = corner;

    strength = fadeLength > 0.0 ? smoothstep(0.25, 1.0, span / fadeLength) : 1.0;
}
