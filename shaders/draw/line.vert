#version 450 core
// One line segment an instance, drawn as a strip of four corners: a rectangle on the screen of constant width.

layout(location = 0) in vec3 from;
layout(location = 1) in vec3 to;

uniform vec4 origin;    // xyz: what the matrix counts coordinates from
uniform vec4 section;   // the same; what it gives less than 0 is cut off
uniform mat4 toClip;
uniform vec4 eye;       // xyz: where the eye is; w: the part of the way to it by which lines stand out of faces
uniform vec2 viewport;  // pixels
uniform float width;    // pixels
uniform float fadeLength; // pixels; edges fade out as they get shorter than this, 0: they do not

out float strength;
out float gl_ClipDistance[1];

vec4 project(vec3 point)
{
    return toClip * vec4(mix(point - origin.xyz, eye.xyz, eye.w), 1.0);
}

float side(vec3 point)
{
    return dot(section, vec4(point - origin.xyz, 1.0));
}

void main()
{
    vec4 ends[2] = vec4[2](project(from), project(to));
    float sides[2] = float[2](side(from), side(to));
    // The part behind the near plane has no place on the screen.
    const vec2 ahead = vec2(ends[0].z + ends[0].w, ends[1].z + ends[1].w);
    if (min(ahead.x, ahead.y) < 0.0 && max(ahead.x, ahead.y) > 0.0) {
        const int behind = ahead.x < 0.0 ? 0 : 1;
        const float share = ahead[behind] / (ahead[behind] - ahead[1 - behind]);
        ends[behind] = mix(ends[behind], ends[1 - behind], share);
        sides[behind] = mix(sides[behind], sides[1 - behind], share);
    }
    const vec2 first = ends[0].xy / ends[0].w * 0.5 * viewport;
    const vec2 second = ends[1].xy / ends[1].w * 0.5 * viewport;
    const float span = distance(first, second);
    const vec2 along = span > 1e-6 ? (second - first) / span : vec2(1.0, 0.0);
    const vec2 across = vec2(-along.y, along.x);

    const int end = gl_VertexID & 1;
    const float edge = (gl_VertexID & 2) == 0 ? -0.5 : 0.5;
    // Half a width beyond both ends, so that lines which meet leave no notch.
    const vec2 shift = width * (edge * across + (end == 0 ? -0.5 : 0.5) * along);
    vec4 corner = ends[end];
    corner.xy += shift / (0.5 * viewport) * corner.w;
    gl_Position = corner;
    gl_ClipDistance[0] = sides[end];

    strength = fadeLength > 0.0 ? smoothstep(0.25, 1.0, span / fadeLength) : 1.0;
}
