// The middle of the picture, and its height.
const vec2 center = vec2(/*CENTER*/);
const float height = /*HEIGHT*/;

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    float pixel_size = height / iResolution.y;
    vec2 p = center + pixel_size * (fragCoord - 0.5 * iResolution.xy);
    vec2 w = /*VALUE*/;
    // the phase as hue, and rings where the modulus doubles
    float phase = atan(w.y, w.x);
    vec3 hue = 0.5 + 0.5 * cos(phase - vec3(0.0, 2.0943951, 4.1887902));
    float ring = fract(log2(max(length(w), 1e-30)));
    vec3 color = hue * (0.55 + 0.45 * ring);
    fragColor = vec4(pow(color, vec3(1.0 / 2.2)), 1.0);
}
