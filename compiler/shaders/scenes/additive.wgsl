// additive: the light that f gives off inside solids, added up without marching: each solid's share is the integral of f
// along the ray, in closed form where f has one. Where solids overlap their light adds up, and the camera may be in them.
//
// Settings (see the record for ranges):
// | shape                  |         | of the solids: 0 box, 1 ball, 2 cylinder, 3 cone, 4 a mesh from a file |
// | box, center            | world   | half size of a solid, and the middle of all of them |
// | copies, step, turn     |         | how many, from one to the next; degrees about z from one to the next |
// | density                |         | f is of 0 the world's coordinates, 1 the solid's own |
// | color, intensity       | linear  | of the light of f = 1 along one world unit |
// | shift                  | world   | f is taken this far ahead for blue, and behind for red |
// | ground, ball, ball_at  | world   | what hides light behind it: a ground, and a ball of this radius |
// | exposure, tone, gamma  |         | of the radiance; 0 Reinhard, 1 none; exponent 1/gamma after that |
// | camera                 |         | where it is and how it sees |
// | light_yaw, light_pitch | degrees | of the light on ground and ball; yaw from the camera or from +x |
// | backdrop, background   | linear  | behind the light: 0 one colour, 1 nothing |
//
// Where f is undefined on a ray, the solid gives no light on it; light less than none is taken from that of other solids.

struct View {
    center: vec2f,     // world coordinates of the centre of the whole image
    size: vec2f,       // whole image, pixels
    tile: vec2f,       // pixel of the whole image at this tile's top-left corner
    pixel: f32,        // world units per pixel
    time: f32,         // seconds
    samples: u32,      // supersamples per axis, >= 1
    zero: u32,         // always 0, but the shader compiler does not know
    tile_size: vec2u,  // this tile, pixels
}

struct Camera {
    eye: vec3f,
    yaw: f32,
    aim: vec3f,
    pitch: f32,
    up: vec3f,
    distance: f32,
    fov: f32,
    extent: f32,
    camera: u32,
    projection: u32,
}

struct Settings {
    box: vec3f,
    shape: u32,
    center: vec3f,
    copies: u32,
    step: vec3f,
    turn: f32,
    shift: vec3f,
    density: u32,
    color: vec3f,
    intensity: f32,
    ball_at: vec3f,
    ball: f32,
    ground: u32,
    exposure: f32,
    tone: u32,
    gamma: f32,
    camera: Camera,
    light_yaw: f32,
    light_pitch: f32,
    light_from: u32,
    background: vec3f,
    backdrop: u32,
}

struct NearRay {
    origin: vec3f,
    direction: vec3f,
    start: f32,
}

struct MeshCursor {
    node: u32,
    triangle: u32,
}

struct MeshHit {
    t: f32,
    side: f32,
    cursor: MeshCursor,
}

struct Shear {
    origin: vec3f,
    axes: vec3u,
    rate: vec3f,
}

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<uniform> params: array<vec4f, 16>;
@group(0) @binding(2) var<uniform> settings: Settings;

// ∫ f(o + t d) dt from t = a to t = b
fn field_integral(o: vec3f, d: vec3f, a: f32, b: f32) -> f32 { return 0.0; }

fn is_nan(x: f32) -> bool { return false; }
fn near_ray(pixel: vec2f, camera: Camera, center: vec3f, half_size: vec3f) -> NearRay { return NearRay(); }
fn light_toward(camera: Camera, yaw: f32, pitch: f32, origin: u32) -> vec3f { return vec3f(); }
fn shape_span(shape: u32, origin: vec3f, direction: vec3f, size: vec3f) -> vec2f { return vec2f(); }
fn ball_span(origin: vec3f, direction: vec3f, size: vec3f) -> vec2f { return vec2f(); }
fn shear_of(origin: vec3f, direction: vec3f) -> Shear { return Shear(); }
fn mesh_next(origin: vec3f, direction: vec3f, shear: Shear, start: f32, from_: MeshCursor) -> MeshHit { return MeshHit(); }
fn wrap_diffuse(n: vec3f, l: vec3f, wrap: f32) -> f32 { return 0.0; }
fn displayed(radiance: vec3f, exposure: f32, tone: u32, gamma: f32) -> vec3f { return vec3f(); }

const FAR: f32 = 1e30;
const BRIGHTEST: f32 = 1e30;
const MESH: u32 = 4u;
const STONE: vec3f = vec3f(0.016, 0.017, 0.020);

// Half size of all solids together.
fn reach() -> vec3f {
    return settings.box + 0.5 * f32(settings.copies - 1u) * abs(settings.step);
}

// A ray in the coordinates of a solid: moved to its middle, and turned about z.
struct Local {
    origin: vec3f,
    direction: vec3f,
}

fn local_ray(ray: NearRay, copy: u32) -> Local {
    let place = f32(copy) - 0.5 * f32(settings.copies - 1u);
    let p = ray.origin - settings.center - place * settings.step;
    let d = ray.direction;
    if settings.turn == 0.0 {
        return Local(p, d);
    }
    let angle = f32(copy) * settings.turn * 0.017453292519943295;
    let c = cos(angle);
    let s = sin(angle);
    return Local(
        vec3f(c * p.x + s * p.y, c * p.y - s * p.x, p.z),
        vec3f(c * d.x + s * d.y, c * d.y - s * d.x, d.z),
    );
}

// Light of a stretch of a ray.
fn stretch_light(origin: vec3f, direction: vec3f, from_: f32, to: f32) -> vec3f {
    let plain = all(settings.shift == vec3f(0.0));
    var light = vec3f();
    for (var channel = view.zero; channel < select(3u, 1u, plain); channel++) {
        let ahead = select(f32(channel) - 1.0, 0.0, plain);
        let sum = field_integral(origin + ahead * settings.shift, direction, from_, to);
        light[channel] = select(clamp(sum, -BRIGHTEST, BRIGHTEST), 0.0, is_nan(sum));
    }
    return select(light, light.xxx, plain);
}

// Light of one solid on a ray up to t = end. A mesh has a share for each crossing of its surface, of the way from the middle of
// the ray to there: with a plus where the ray leaves, with a minus where it enters. What the camera is inside of has been
// entered behind it, and that share is that of the camera's place.
fn solid_light(ray: NearRay, copy: u32, end: f32) -> vec3f {
    let own = local_ray(ray, copy);
    let origin = select(ray.origin, own.origin, settings.density == 1u);
    let direction = select(ray.direction, own.direction, settings.density == 1u);
    let meshed = settings.shape == MESH;
    let scale = min(settings.box.x, min(settings.box.y, settings.box.z));
    let middle = -dot(own.origin, own.direction);
    let shear = shear_of(own.origin / scale, own.direction / scale);
    var cursor = MeshCursor(view.zero, 0u);
    var around = 0.0;
    var light = vec3f();
    var more = end > ray.start;
    // ends: a mesh has finitely many faces, and the cursor passes them all; a solid has one turn
    while more {
        var from_ = middle;
        var to = ray.start;
        var weight = -around;
        if meshed {
            let hit = mesh_next(own.origin / scale, own.direction / scale, shear, ray.start, cursor);
            cursor = hit.cursor;
            more = hit.side != 0.0;
            if more {
                around += hit.side;
                weight = hit.side;
                to = min(hit.t, end);
            }
        } else {
            let span = shape_span(settings.shape, own.origin, own.direction, settings.box);
            from_ = max(span.x, ray.start);
            to = min(span.y, end);
            weight = select(0.0, 1.0, to > from_);
            more = false;
        }
        if weight != 0.0 {
            light += weight * stretch_light(origin, direction, from_, to);
        }
    }
    return light;
}

// What hides light: distance on the ray, and its colour.
struct Wall {
    t: f32,
    colour: vec3f,
}

fn lit_wall(t: f32, normal: vec3f, shade: f32) -> Wall {
    let toward = light_toward(settings.camera, settings.light_yaw, settings.light_pitch, settings.light_from);
    return Wall(t, STONE * (0.25 + 0.75 * wrap_diffuse(normal, toward, 0.3)) * shade);
}

fn ground_of(ray: NearRay) -> Wall {
    let level = settings.center.z - reach().z;
    let t = (level - ray.origin.z) / ray.direction.z;
    if settings.ground == 0u || ray.direction.z > -1e-6 || t <= ray.start {
        return Wall(FAR, settings.background);
    }
    let away = length((ray.origin + t * ray.direction).xy - settings.center.xy) / length(reach());
    let wall = lit_wall(t, vec3f(0.0, 0.0, 1.0), 1.0);
    return Wall(t, mix(settings.background, wall.colour, exp2(-0.35 * away)));
}

fn wall_of(ray: NearRay) -> Wall {
    let ground = ground_of(ray);
    let from_ball = ray.origin - settings.ball_at;
    let span = ball_span(from_ball, ray.direction, vec3f(max(settings.ball, 1e-20)));
    if settings.ball > 0.0 && span.x <= span.y && span.x > ray.start && span.x < ground.t {
        return lit_wall(span.x, normalize(from_ball + span.x * ray.direction), 1.0);
    }
    return ground;
}

// Radiance of all solids on a ray up to t = end.
fn radiance(ray: NearRay, end: f32) -> vec3f {
    var light = vec3f();
    for (var k = view.zero; k < settings.copies; k++) {
        light += solid_light(ray, k, end);
    }
    return settings.intensity * settings.color * light;
}

fn shade(pixel: vec2f) -> vec4f {
    let ray = near_ray(pixel, settings.camera, settings.center, reach());
    let wall = wall_of(ray);
    let shown = displayed(radiance(ray, wall.t), settings.exposure, settings.tone, settings.gamma);
    if settings.backdrop == 1u && wall.t == FAR {
        // light hides nothing, but what is brighter than its alpha cannot be told in most files
        return vec4f(shown, max(shown.r, max(shown.g, shown.b)));
    }
    return vec4f(clamp(shown + wall.colour, vec3f(0.0), vec3f(1.0)), 1.0);
}
