// Half the sides of the box that the light is in.
const vec3 half_size = vec3(/*BOX*/);
const vec3 tint = vec3(1.0, 0.62, 0.3);

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 at = (2.0 * fragCoord - iResolution.xy) / iResolution.y;
    float turn = 0.3 * iTime;
    float far = 3.2 * length(half_size);
    vec3 forward = -vec3(cos(turn) * 0.9, sin(turn) * 0.9, 0.43588989);
    vec3 right = vec3(-sin(turn), cos(turn), 0.0);
    vec3 up = cross(right, forward);
    vec3 o = -far * forward;
    vec3 d = normalize(2.2 * forward + at.x * right + at.y * up);
    // where the ray is in the box
    vec3 e = vec3(d.x == 0.0 ? 1e-20 : d.x, d.y == 0.0 ? 1e-20 : d.y, d.z == 0.0 ? 1e-20 : d.z);
    vec3 to_walls = half_size / abs(e);
    vec3 to_middle = -o / e;
    vec3 enter = to_middle - to_walls;
    vec3 leave = to_middle + to_walls;
    float a = max(max(enter.x, enter.y), max(enter.z, 0.0));
    float b = min(leave.x, min(leave.y, leave.z));
    float light = 0.0;
    if (a < b) {
        light = max(/*INTEGRAL*/, 0.0);
    }
    vec3 color = 1.0 - exp(-light * tint);
    fragColor = vec4(pow(color, vec3(1.0 / 2.2)), 1.0);
}
