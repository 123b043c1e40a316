#version 450 core
// A matt surface under three soft lamps that move with the camera, brighter sky than ground, and a little gloss.

in vec3 viewPosition;
in vec3 viewNormal;
in vec3 ownColour;

layout(location = 0) out vec4 result;

#include "face.glsl"

const vec3 keyLamp = normalize(vec3(-0.45, 0.65, 0.75));
const vec3 fillLamp = normalize(vec3(0.85, 0.05, 0.45));
const vec3 backLamp = normalize(vec3(0.25, 0.55, -0.80));

float soft(vec3 normal, vec3 lamp, float wrap)
{
    return max(0.0, (dot(normal, lamp) + wrap) / (1.0 + wrap));
}

void main()
{
    const vec4 face = faceColour();
    vec3 normal = normalize(viewNormal);
    if (!gl_FrontFacing) normal = -normal;
    const vec3 toEye = normalize(-viewPosition);

    const vec3 key = vec3(1.00, 0.97, 0.93) * 0.82 * soft(normal, keyLamp, 0.15);
    const vec3 fill = vec3(0.90, 0.95, 1.00) * 0.18 * soft(normal, fillLamp, 0.30);
    const vec3 back = vec3(0.92, 0.96, 1.00) * 0.26 * soft(normal, backLamp, 0.10);
    const vec3 sky = mix(vec3(0.13, 0.12, 0.115), vec3(0.30, 0.31, 0.33), 0.5 + 0.5 * normal.y);
    const float gloss = 0.06 * pow(max(0.0, dot(normal, normalize(keyLamp + toEye))), 28.0);

    // Darker where the surface turns away, so that a light model stands out from a white background.
    const float turn = mix(0.70, 1.0, smoothstep(0.0, 0.65, dot(normal, toEye)));
    const vec3 albedo = turn * pow(face.rgb * ownColour, vec3(2.2));
    const float inside = gl_FrontFacing ? 1.0 : 0.55; // one sees where a surface is open or turned inside out
    const vec3 light = inside * (albedo * (key + fill + back + sky) + gloss);
    result = vec4(pow(clamp(light, 0.0, 1.0), vec3(1.0 / 2.2)), face.a);
}
