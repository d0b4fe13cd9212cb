// The middle of the picture, and its height.
const vec2 center = vec2(/*CENTER*/);
const float height = /*HEIGHT*/;
// From one level line to the next.
const float spacing = /*SPACING*/;

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    float pixel_size = height / iResolution.y;
    vec2 p = center + pixel_size * (fragCoord - 0.5 * iResolution.xy);
    vec3 g = /*GRADIENT*/;
    float level = g.z / spacing;
    // the distance to the nearest level line in pixels, by the exact gradient
    float apart = abs(level - floor(level + 0.5)) * spacing / max(length(g.xy) * pixel_size, 1e-20);
    float warm = 0.5 + 0.5 * g.z / (1.0 + abs(g.z));
    vec3 color = mix(vec3(0.03, 0.13, 0.36), vec3(0.95, 0.55, 0.13), warm);
    color *= 0.35 + 0.65 * clamp(apart - 0.5, 0.0, 1.0);
    fragColor = vec4(pow(color, vec3(1.0 / 2.2)), 1.0);
}
