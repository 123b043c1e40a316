// The colour of the face that is drawn, and its opacity.

uniform vec4 colour;        // sRGB and opacity
uniform vec4 quadColour;    // instead of `colour` where a quad is; the same if they are not told apart
uniform vec4 markedColour, selectedColour; // of faces with these flags
uniform int triangleCount;  // triangles come first, then two for each quad
uniform bool hasLooks;
uniform usamplerBuffer looks; // for each face red, green, blue (0 to 255) and flags

vec4 faceColour()
{
    vec4 result = gl_PrimitiveID < triangleCount ? colour : quadColour;
    if (hasLooks) {
        const int beyond = gl_PrimitiveID - triangleCount;
        const uvec4 look = texelFetch(looks, beyond < 0 ? gl_PrimitiveID : triangleCount + beyond / 2);
        result.rgb *= vec3(look.rgb) / 255.0;
        if ((look.a & 1u) != 0u) result = vec4(markedColour.rgb, max(result.a, markedColour.a));
        if ((look.a & 2u) != 0u) result = vec4(selectedColour.rgb, max(result.a, selectedColour.a));
    }
    return result;
}
