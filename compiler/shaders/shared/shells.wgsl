// Families of level sets in a box: the colour and opacity of each layer that a ray meets, in order.

// How the layers look.
struct Shells {
    family: Family,
    opaque_level: i32,        // the one that is highlighted
    opaque_opacity: f32,
    ghost_opacity: f32,       // of the others, seen face on
    lighting: f32,            // 0: all colours as they are
    lamp: Lamp,
    palette: u32,
}

const SHELL_INK: vec3f = vec3f(0.012, 0.014, 0.02);

// A family of `count` levels around `middle`, and which of them is highlighted: the `number`-th from the lowest, for 0 the
// one in the middle.
fn family_around(middle: f32, spacing: f32, count: u32) -> Family {
    return Family(middle - 0.5 * f32(count - 1u) * spacing, spacing, count);
}

fn highlighted_level(number: u32, count: u32) -> i32 {
    return select(i32(min(number, count)) - 1, i32((count - 1u) / 2u), number == 0u);
}

// From the palette's colour for low values to that for high ones.
fn shell_colour(level: i32, count: u32, palette: u32) -> vec3f {
    let reach = max(0.5 * f32(count - 1u), 0.5);
    return palette_colour(palette, 0.85 * (f32(level) - 0.5 * f32(count - 1u)) / reach);
}

// A level set where the ray meets it. The side of smaller values is paler. A translucent shell of constant thickness is
// the more opaque the more it is seen from the side: 1 - (1 - opacity)^(1/cos), up to a cosine of 1/8.
fn shell_layer(level: i32, touching: bool, gradient: vec3f, direction: vec3f, shells: Shells) -> Layer {
    let uphill = direction_or(gradient, -direction);
    let outside = dot(uphill, direction) <= 0.0;
    let n = select(-uphill, uphill, outside);
    let own = shell_colour(level, shells.family.count, shells.palette);
    let colour = select(mix(own, vec3f(1.0), 0.3), own, outside || touching);
    // white paint reflects four fifths
    let lit = lit_colour(0.8 * colour, n, -direction, 1.0, shells.lamp);
    var opacity = shells.opaque_opacity;
    if level != shells.opaque_level {
        let slant = max(-dot(n, direction), 0.125);
        opacity = 1.0 - pow(max(1.0 - shells.ghost_opacity, 0.0), 1.0 / slant);
    }
    return Layer(mix(colour, lit, shells.lighting), opacity);
}

// A wall of the box: on the far one a tint by value, on both a line for each level. `rate` is the change of value per
// pixel, negative where it is not known.
fn shell_wall(value: f32, rate: f32, behind: bool, width: f32, shells: Shells, pixel: vec2f) -> Layer {
    if is_undefined(value) {
        return Layer(vec3f(0.45), select(0.12, 0.30, behind) * hatch(pixel, 1.0, 7.0, 0.3, sample_window()));
    }
    let family = shells.family;
    let count = f32(family.count);
    let u = clamp((value - family.lowest) / family.spacing, -1e9, 1e9);
    let tint = palette_colour(shells.palette, clamp((2.0 * u - count + 1.0) / max(count, 2.0), -1.0, 1.0));
    let wall = Layer(mix(tint, vec3f(1.0), 0.25), select(0.0, 0.30, behind));
    if rate <= 0.0 || u < -0.5 || u > count - 0.5 {
        return wall;
    }
    let own = shell_colour(i32(clamp(floor(u + 0.5), 0.0, count - 1.0)), family.count, shells.palette);
    let ink = select(0.55, 0.9, behind) * even_lines(u, min(rate / family.spacing, 1e9), width);
    return layer_over(Layer(mix(0.35 * own, SHELL_INK, 0.2), ink), wall);
}

// The edges of the box at the point of one of its faces at distance t.
fn edge_layer(sight: Sight, t: f32, n: vec3f, center: vec3f, half_size: vec3f, width: f32, behind: bool) -> Layer {
    return Layer(SHELL_INK, select(0.8, 0.6, behind) * box_edges(sight, t, n, center, half_size, width));
}

// Layers of a ray that are composited at most, and what has to come through for more of them to be looked for.
const MOST_LAYERS: u32 = 96u;
const THINNEST_SHELL: f32 = 0.002;

// The formula, as in the template.
fn field(p: vec3f) -> f32 { return 0.0; }
fn field_ray(o: vec3f, d: vec3f, t: f32) -> vec2f { return vec2f(); }
fn field_grad(p: vec3f) -> vec4f { return vec4f(); }
// The template's: what bounds the way of a ray at distance t, in front of the levels or, where `last`, behind them.
fn seen_bound(seen: Seen, jet: vec4f, t: f32, last: bool, sight: Sight, shells: Shells, pixel: vec2f) -> Seen { return Seen(); }

// The levels that a ray meets from `part.x` to `part.y`, and its bounds; `steps` are for the diagonal of the box.
fn seen_shells(before: Seen, sight: Sight, part: vec2f, half_size: vec3f, steps: u32, shells: Shells, pixel: vec2f) -> Seen {
    let d = sight.ray.direction;
    let origin = sight.ray.origin + part.x * d;
    let extent = part.y - part.x;
    let count = f32(max(u32(ceil(extent / (2.0 * length(half_size)) * f32(steps))), 1u));
    let stride = extent / count * d;
    let small = turn_size(stride);
    var walk: Walk;
    var seen = before;
    // One place evaluates the gradient: first at the bound in front, then where a level is met, at last at the bound behind.
    for (var k = view.zero; k < MOST_LAYERS && seen.through > THINNEST_SHELL; k++) {
        var aim: Aim;
        var met = false;
        // ends: each turn goes at least one step on, or behind an edge or a pole within one
        while k > 0u && walk.k <= count && !met {
            var value: f32;
            // ends: each turn goes one step on
            loop {
                value = field(origin + walk.k * stride);
                if !walks_over(walk, value, count, small) {
                    break;
                }
                walk = walk_on(walk, value);
            }
            // first for an extremum at the end of what has been searched, then in the step up to the sample
            var turning = true;
            aim = aim_at_turn(walk, value, count, shells.family, small);
            // ends: a search takes 48 samples at most, and each of those that follow begins nearer to the end of the step
            while turning || is_searching(aim.search) {
                if is_searching(aim.search) {
                    let goal = goal_of(aim, walk);
                    aim.search = search_on(aim.search, field_ray(origin, stride, aim.search.k), goal, count, 1e-3);
                    if !turning && has_rest(aim.search) {
                        let stopped = walk;
                        walk = walk_to_rest(stopped, aim.search, goal, shells.family);
                        aim = aim_at_rest(stopped, walk, value, aim.search, shells.family);
                    }
                } else {
                    turning = false;
                    if !has_met(aim.search) {
                        aim = aim_in_step(walk, value, shells.family);
                    }
                }
            }
            met = has_met(aim.search);
            if !met {
                walk = walk_from(walk, value, shells.family);
            }
        }
        let last = k > 0u && !met;
        let place = select(select(aim.search.k, count, last), 0.0, k == 0u);
        let jet = field_grad(origin + place * stride);
        if met {
            let level = select(walk.band - 1, walk.band, aim.upper);
            let touching = aim.search.state == SEARCH_TOUCHED;
            seen = seen_behind(seen, shell_layer(level, touching, jet.xyz, d, shells));
            walk = walk_behind(walk, aim.search, aim.upper, shells.family);
            continue;
        }
        seen = seen_bound(seen, jet, select(part.x, part.y, last), last, sight, shells, pixel);
        if last {
            break;
        }
        walk = walk_begun(jet.w, dot(jet.xyz, d) > 0.0, shells.family);
    }
    return seen;
}
