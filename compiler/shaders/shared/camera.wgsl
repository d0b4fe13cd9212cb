// Perspective cameras. Space is right-handed with z up.

struct Ray {
    origin: vec3f,
    direction: vec3f,  // of length 1
}

// Unit vector of the direction with the given yaw (from +x towards +y) and pitch (up from the ground), radians.
fn direction_from_angles(yaw: f32, pitch: f32) -> vec3f {
    return vec3f(cos(pitch) * cos(yaw), cos(pitch) * sin(yaw), sin(pitch));
}

// Tangent of half the field of view, per half an image side: the shorter side of the image spans `fov` (radians).
// Returned as the slope per pixel.
fn slope_per_pixel(size: vec2f, fov: f32) -> f32 {
    return 2.0 * tan(0.5 * fov) / max(min(size.x, size.y), 1.0);
}

// The ray through a point of the image (pixels, y down) of a camera at `distance` from `aim`, in the direction
// (yaw, pitch) as seen from `aim`, looking at `aim`, with horizontal horizon.
fn orbit_ray(pixel: vec2f, size: vec2f, aim: vec3f, yaw: f32, pitch: f32, distance: f32, fov: f32) -> Ray {
    let back = direction_from_angles(yaw, pitch);
    let right = vec3f(-sin(yaw), cos(yaw), 0.0);
    let up = cross(back, right);
    let offset = (pixel - 0.5 * size) * slope_per_pixel(size, fov);
    return Ray(aim + distance * back, normalize(offset.x * right - offset.y * up - back));
}
