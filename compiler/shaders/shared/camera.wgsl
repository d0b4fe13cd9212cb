// Cameras. Space is right-handed with z up.

struct Ray {
    origin: vec3f,
    direction: vec3f,  // of length 1
}

// Where a camera is and how it sees: settings of every scene of space. Angles in degrees.
struct Camera {
    eye: vec3f,        // of the look-at camera
    yaw: f32,          // of the orbiting camera about z, from +x towards +y
    aim: vec3f,        // what the look-at camera looks at
    pitch: f32,        // of the orbiting camera above the ground
    up: vec3f,         // direction that the look-at camera shows upwards
    distance: f32,     // from the orbiting camera to the centre; 0: the box fills the view
    fov: f32,          // perspective: angle across the shorter side of the image
    extent: f32,       // orthographic: world units across the shorter side; 0: the box fills the view
    camera: u32,       // 0 orbits the centre of the box, 1 looks from `eye` at `aim`
    projection: u32,   // 0 perspective, 1 orthographic
}

// What is seen through a point of the image.
struct Sight {
    ray: Ray,
    forward: vec3f,  // the way the camera looks, of length 1
    slope: f32,      // a pixel in world units: at distance 1 along `forward` in perspective, anywhere else
    parallel: bool,  // whether all rays are parallel
    before: f32,     // how far from the camera the ray begins
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

// How far away a box of this half size fills a field of view of `fov` radians.
fn fitting_distance(half_size: vec3f, fov: f32) -> f32 {
    return 0.98 * length(half_size) / sin(0.5 * fov);
}

// From the camera's point of view: where it is, and three unit vectors at right angles, `back` towards the viewer.
struct CameraAxes {
    eye: vec3f,
    right: vec3f,
    up: vec3f,
    back: vec3f,
}

const CAMERA_DEGREE: f32 = 0.017453292519943295;

fn camera_fov(camera: Camera) -> f32 {
    return clamp(camera.fov, 1.0, 120.0) * CAMERA_DEGREE;
}

// Around the centre of the box, with horizontal horizon. An orthographic one begins so far away that all of the box is
// in front of it, and of the ground beneath when it is seen from above.
fn orbit_axes(camera: Camera, center: vec3f, half_size: vec3f) -> CameraAxes {
    let yaw = camera.yaw * CAMERA_DEGREE;
    let back = direction_from_angles(yaw, clamp(camera.pitch, -89.0, 89.0) * CAMERA_DEGREE);
    let right = vec3f(-sin(yaw), cos(yaw), 0.0);
    return CameraAxes(center + orbit_distance(camera, half_size) * back, right, cross(back, right), back);
}

fn orbit_distance(camera: Camera, half_size: vec3f) -> f32 {
    let fitting = select(fitting_distance(half_size, camera_fov(camera)), 8.0 * length(half_size), camera.projection == 1u);
    return select(fitting, camera.distance, camera.distance > 0.0 && camera.projection == 0u);
}

// From `eye` to `aim`, with the projection of `up` upwards. Where that has no direction some other one is up. All
// that is seen hangs on these directions: they are rounded with care.
fn look_at_axes(camera: Camera) -> CameraAxes {
    let back = scaled_direction(camera.eye - camera.aim, vec3f(0.0, 0.0, 1.0));
    let spare = cross(select(vec3f(0.0, 0.0, 1.0), vec3f(0.0, 1.0, 0.0), abs(back.z) > 0.9), back);
    let right = normalize(scaled_direction(cross(scaled_direction(camera.up, vec3f(0.0, 0.0, 1.0)), back), spare));
    return CameraAxes(camera.eye, right, cross(back, right), back);
}

fn camera_axes(camera: Camera, center: vec3f, half_size: vec3f) -> CameraAxes {
    if camera.camera == 1u {
        return look_at_axes(camera);
    }
    return orbit_axes(camera, center, half_size);
}

// A pixel in world units: at distance 1 in perspective, anywhere in an orthographic picture.
fn pixel_slope(camera: Camera, half_size: vec3f) -> f32 {
    let fitting = 1.96 * length(half_size);
    let extent = select(fitting, camera.extent, camera.extent > 0.0);
    return select(slope_per_pixel(view.size, camera_fov(camera)), extent / max(min(view.size.x, view.size.y), 1.0), camera.projection == 1u);
}

// What a camera sees through a point of the image, pixels, y down. In perspective the ray begins at the camera, in an
// orthographic picture on the plane through it.
fn sight_at(pixel: vec2f, camera: Camera, center: vec3f, half_size: vec3f) -> Sight {
    let axes = camera_axes(camera, center, half_size);
    let slope = pixel_slope(camera, half_size);
    let offset = (pixel - 0.5 * view.size) * slope;
    let across = offset.x * axes.right - offset.y * axes.up;
    if camera.projection == 1u {
        return Sight(Ray(axes.eye + across, -axes.back), -axes.back, slope, true, 0.0);
    }
    return Sight(Ray(axes.eye, normalize(across - axes.back)), -axes.back, slope, false, 0.0);
}

// A ray as it is seen from where it passes the centre of a scene: however far away the camera is, its origin is only as far
// from the centre as the ray is, and rounded accordingly.
struct NearRay {
    origin: vec3f,     // in the plane through the centre at right angles to the view
    direction: vec3f,  // of length 1
    start: f32,        // where the camera is on it
}

fn near_ray(pixel: vec2f, camera: Camera, center: vec3f, half_size: vec3f) -> NearRay {
    let axes = camera_axes(camera, center, half_size);
    let offset = (pixel - 0.5 * view.size) * pixel_slope(camera, half_size);
    let across = offset.x * axes.right - offset.y * axes.up;
    var middle = center;
    var away = orbit_distance(camera, half_size);
    if camera.camera == 1u { // not from the eye, which may be far away
        let behind = dot(center - camera.aim, axes.back);
        middle = camera.aim + behind * axes.back;
        away = length(camera.eye - camera.aim) - behind;
    }
    if camera.projection == 1u {
        return NearRay(middle + across, -axes.back, -away);
    }
    let along = across - axes.back;
    return NearRay(middle + away * across, normalize(along), -away * length(along));
}

// A sight whose ray begins where it comes near the box, if the camera is not there: what lies on it is then rounded to the
// size of the box and not to the camera's distance.
fn sight_near(pixel: vec2f, camera: Camera, center: vec3f, half_size: vec3f) -> Sight {
    let sight = sight_at(pixel, camera, center, half_size);
    let near = near_ray(pixel, camera, center, half_size);
    // the box is within this from the place of the ray that is nearest to its centre
    let back = dot(near.origin - center, near.direction) + 1.01 * length(half_size);
    let before = -near.start - back;
    if before <= 0.0 {
        return sight;
    }
    return Sight(Ray(near.origin - back * near.direction, near.direction), sight.forward, sight.slope, sight.parallel, before);
}

// A pixel in world units at t along a sight, on a plane at right angles to the camera's view.
fn sight_footprint(sight: Sight, t: f32) -> f32 {
    return select((sight.before + t) * dot(sight.ray.direction, sight.forward) * sight.slope, sight.slope, sight.parallel);
}

// Towards a light at `yaw` about z and `pitch` above the ground, degrees. `origin` says where yaw is counted from: 0 from
// where the camera is, 1 from +x.
fn light_toward(camera: Camera, yaw: f32, pitch: f32, origin: u32) -> vec3f {
    var from_x = camera.yaw;
    if camera.camera == 1u {
        let back = camera.eye - camera.aim;
        let upright = abs(back.x) + abs(back.y) <= 1e-6 * abs(back.z);
        from_x = select(atan2(back.y, back.x) / CAMERA_DEGREE, 0.0, upright);
    }
    return direction_from_angles((select(from_x, 0.0, origin == 1u) + yaw) * CAMERA_DEGREE, pitch * CAMERA_DEGREE);
}
