// nested: the level sets f = level + k spacing inside a box, one opaque, the others translucent; composited from front
// to back in the order in which a ray meets them. On the walls each level has its line.
//
// Settings (see the record for ranges):
// | box, center              | world   | half size and centre of the box |
// | level                    | value   | of f in the middle of the family |
// | spacing, color_scale     | value   | between levels; 0: half of color_scale |
// | count                    |         | number of levels |
// | highlight                |         | number of the opaque level, from the lowest; 0: the middle one |
// | highlight_opacity        |         | of it |
// | ghost_opacity            |         | of the others, face on |
// | steps                    |         | samples along the diagonal of the box |
// | isoline_width            | pixels  | of the lines on the walls |
// | wall_opacity, edge_width |         | of the walls; pixels, of the box's edges |
// | lighting                 |         | 0: flat colours |
// | camera                   |         | where it is and how it sees |
// | light_yaw, light_pitch   | degrees | of the light; yaw from the camera or from +x |
// | light_strength, ambient  |         | of the sun, and of sky and ground |
// | palette                  |         | colours of values |
// | backdrop, background     |         | 0 ground and sky, 1 plain, 2 transparent; colour of the horizon |
//
// Where f is undefined there is no surface, and the walls are hatched. A constant has no surface. A sign change where f
// does not shrink towards the level (a pole, a jump) is none either.

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
    center: vec3f,
    level: f32,
    spacing: f32,
    count: u32,
    highlight: u32,
    highlight_opacity: f32,
    ghost_opacity: f32,
    color_scale: f32,
    steps: u32,
    isoline_width: f32,
    wall_opacity: f32,
    lighting: f32,
    camera: Camera,
    light_yaw: f32,
    light_pitch: f32,
    light_from: u32,
    light_strength: f32,
    ambient: f32,
    backdrop: u32,
    background: vec3f,
    edge_width: f32,
    palette: u32,
    colours: array<vec4f, 129>,  // of a named palette
}

struct Ray {
    origin: vec3f,
    direction: vec3f,  // of length 1
}

struct Sight {
    ray: Ray,
    forward: vec3f,
    slope: f32,
    parallel: bool,
    before: f32,
}

struct Family {
    lowest: f32,
    spacing: f32,
    count: u32,
}

struct Lamp {
    toward: vec3f,
    strength: f32,
    surroundings: vec3f,
    ambient: f32,
}

struct Shells {
    family: Family,
    opaque_level: i32,
    opaque_opacity: f32,
    ghost_opacity: f32,
    lighting: f32,
    lamp: Lamp,
    palette: u32,
}

struct Layer {
    colour: vec3f,
    opacity: f32,
}

struct Seen {
    light: vec3f,
    through: f32,
}

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<uniform> params: array<vec4f, 16>;
@group(0) @binding(2) var<uniform> settings: Settings;

fn field(p: vec3f) -> f32 { return 0.0; }
// f and df/dt at o + t d
fn field_ray(o: vec3f, d: vec3f, t: f32) -> vec2f { return vec2f(); }
// (∂f/∂x, ∂f/∂y, ∂f/∂z, f)
fn field_grad(p: vec3f) -> vec4f { return vec4f(); }

fn light_toward(camera: Camera, yaw: f32, pitch: f32, origin: u32) -> vec3f { return vec3f(); }
fn sight_at(pixel: vec2f, camera: Camera, center: vec3f, half_size: vec3f) -> Sight { return Sight(); }
fn screen_rate(sight: Sight, t: f32, n: vec3f, gradient: vec3f) -> f32 { return 0.0; }
fn box_span(origin: vec3f, direction: vec3f, center: vec3f, half_size: vec3f) -> vec2f { return vec2f(); }
fn box_normal(p: vec3f, center: vec3f, half_size: vec3f) -> vec3f { return vec3f(); }
fn family_around(middle: f32, spacing: f32, count: u32) -> Family { return Family(); }
fn highlighted_level(number: u32, count: u32) -> i32 { return 0; }
fn shell_wall(value: f32, rate: f32, behind: bool, width: f32, shells: Shells, pixel: vec2f) -> Layer { return Layer(); }
fn edge_layer(sight: Sight, t: f32, n: vec3f, center: vec3f, half_size: vec3f, width: f32, behind: bool) -> Layer { return Layer(); }
fn seen_shells(before: Seen, sight: Sight, part: vec2f, half_size: vec3f, steps: u32, shells: Shells, pixel: vec2f) -> Seen { return Seen(); }
fn seen_over(seen: Seen, behind: vec4f) -> vec4f { return vec4f(); }
fn stage_at(backdrop: u32, ray: Ray, center: vec3f, half_size: vec3f, background: vec3f) -> vec4f { return vec4f(); }
fn seen_nothing() -> Seen { return Seen(); }
fn seen_behind(seen: Seen, layer: Layer) -> Seen { return Seen(); }

fn colour_entry(k: u32) -> vec3f {
    return settings.colours[k].rgb;
}

fn shells() -> Shells {
    let scale = select(settings.color_scale, 1.0, settings.color_scale <= 1e-37);
    let spacing = max(select(0.5 * scale, settings.spacing, settings.spacing > 0.0), 1e-37);
    return Shells(
        family_around(settings.level, spacing, settings.count),
        highlighted_level(settings.highlight, settings.count),
        settings.highlight_opacity,
        settings.ghost_opacity,
        settings.lighting,
        lamp(),
        settings.palette,
    );
}

fn lamp() -> Lamp {
    let toward = light_toward(settings.camera, settings.light_yaw, settings.light_pitch, settings.light_from);
    return Lamp(toward, settings.light_strength, settings.background, settings.ambient);
}

// A wall at distance t, behind what has been seen: its edges, lines and tint. There is none where the ray begins in the box.
fn seen_bound(seen: Seen, jet: vec4f, t: f32, last: bool, sight: Sight, shells: Shells, pixel: vec2f) -> Seen {
    if t <= 0.0 {
        return seen;
    }
    let n = box_normal(sight.ray.origin + t * sight.ray.direction, settings.center, settings.box);
    let rate = screen_rate(sight, t, n, jet.xyz);
    let wall = shell_wall(jet.w, rate, last, settings.isoline_width, shells, pixel);
    let edges = edge_layer(sight, t, n, settings.center, settings.box, settings.edge_width, last);
    return seen_behind(seen_behind(seen, edges), Layer(wall.colour, wall.opacity * settings.wall_opacity));
}

fn shade(pixel: vec2f) -> vec4f {
    let sight = sight_at(pixel, settings.camera, settings.center, settings.box);
    let span = box_span(sight.ray.origin, sight.ray.direction, settings.center, settings.box);
    let start = max(span.x, 0.0);
    var seen = seen_nothing();
    if span.y > start {
        seen = seen_shells(seen, sight, vec2f(start, span.y), settings.box, settings.steps, shells(), pixel);
    }
    let colour = seen_over(seen, stage_at(settings.backdrop, sight.ray, settings.center, settings.box, settings.background));
    // opaque where nothing else is asked for: then no alpha is computed
    return vec4f(colour.rgb, select(1.0, colour.a, settings.backdrop == 2u));
}
