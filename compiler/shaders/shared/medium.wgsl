// A medium that emits and absorbs light, made of the values of a function. Along a ray its radiance is
// L = ∫ c(t) σ(t) T(t) dt with the transmittance T(t) = exp(-∫ σ) (N. Max, "Optical models for direct volume rendering",
// IEEE TVCG 1, 1995): the transfer function gives colour c and extinction σ of each value.

struct Medium {
    scale: f32,        // |f| of extinction `density`
    power: f32,        // extinction is density (|f|/scale)^power
    density: f32,      // per world unit
    signs: u32,        // 0 both, 1 positive values alone, 2 negative values alone
    positive: vec3f,   // colour of f > 0, emitted at |f| = scale; twice as bright for large values
    negative: vec3f,   // colour of f < 0
    core: f32,         // how far large values are white
    lighting: f32,     // how far light and shade modulate the emission
    light: vec3f,      // towards the light
}

// The settings of a medium and of how it is seen.
struct Gas {
    positive: vec3f,
    color_scale: f32,
    negative: vec3f,
    power: f32,
    density: f32,     // optical depth of half the shortest side of the box where |f| = color_scale
    signs: u32,
    core: f32,
    lighting: f32,
    exposure: f32,    // of the radiance, and what follows: see `displayed`
    tone: u32,
    gamma: f32,
    jitter: f32,      // how far stretches begin at another place in each sample
    steps: u32,       // stretches along the diagonal of the box
}

// The medium of the settings in a box of this half size.
fn medium_of(gas: Gas, half_size: vec3f, light: vec3f) -> Medium {
    return Medium(
        select(gas.color_scale, 1.0, gas.color_scale <= 1e-37),
        gas.power,
        gas.density / min(half_size.x, min(half_size.y, half_size.z)),
        gas.signs,
        gas.positive,
        gas.negative,
        gas.core,
        gas.lighting,
        light,
    );
}

// A way that is cut into stretches: see `stretch_at`.
struct Stretches {
    extent: f32,
    count: f32,
    phase: f32,
}

// A way in a box whose diagonal has `steps` stretches.
fn stretches_of(extent: f32, half_size: vec3f, steps: u32, jitter: f32, pixel: vec2f) -> Stretches {
    let count = max(ceil(extent / (2.0 * length(half_size)) * f32(steps)), 1.0);
    return Stretches(extent, count, mix(0.5, sample_phase(pixel), jitter));
}

// Of one point: emitted colour, and extinction per world unit.
struct Matter {
    colour: vec3f,
    extinction: f32,
}

// Ratios |f|/scale above this count as this.
const DENSEST_RATIO: f32 = 1e6;

// What a value with its gradient is made of. Undefined values are empty; infinite ones are as the largest.
fn matter_of(jet: vec4f, medium: Medium) -> Matter {
    let below = jet.w < 0.0;
    let empty = is_nan(jet.w) | ((medium.signs == 1u) & below) | ((medium.signs == 2u) & !below);
    let x = select(min(abs(jet.w) / medium.scale, DENSEST_RATIO), 0.0, empty);
    let extinction = medium.density * raised(x, medium.power);
    let own = select(medium.positive, medium.negative, below);
    let level = x / (1.0 + x);
    let colour = 2.0 * level * mix(own, vec3f(1.0), medium.core * level);
    return Matter(colour * emission_shade(select(jet.xyz, -jet.xyz, below), medium), extinction);
}

// x^power for x >= 0 and a power above 0. The square, which is the usual one, needs no logarithm.
fn raised(x: f32, power: f32) -> f32 {
    if power == 2.0 {
        return x * x;
    }
    return select(pow(max(x, 1e-30), power), 0.0, x <= 0.0);
}

// Light and shade of an emitting medium by the direction in which its density falls, as if that were a normal: where
// `uphill` has no direction there is none.
fn emission_shade(uphill: vec3f, medium: Medium) -> f32 {
    let n = direction_or(-uphill, vec3f());
    let directed = dot(n, n) > 0.5;
    return select(1.0, mix(1.0, 0.25 + 1.15 * wrap_diffuse(n, medium.light, 0.5), medium.lighting), directed);
}

// 1 - exp(-x) for x >= 0, without cancellation.
fn absorbed_part(x: f32) -> f32 {
    return unkept_part(x, exp(-x));
}

// The same where `kept`, which is exp(-x), is known.
fn unkept_part(x: f32, kept: f32) -> f32 {
    return select(1.0 - kept, x * (1.0 - x * (0.5 - x / 6.0)), x < 0.02);
}

// A stretch of uniform matter behind what has been seen: right for any length.
fn seen_through(seen: Seen, matter: Matter, length: f32) -> Seen {
    let depth = min(matter.extinction * length, 80.0);
    let kept = exp(-depth);
    return Seen(seen.light + seen.through * unkept_part(depth, kept) * matter.colour, seen.through * kept);
}

// A way of this extent is cut into `count` stretches of equal length whose borders are moved by a part of it, `phase` in
// 0..1, and one more for what remains: the first and the last are shorter. Begin and end of the k-th, 0 ≤ k ≤ count.
fn stretch_at(k: f32, count: f32, phase: f32, extent: f32) -> vec2f {
    let length = extent / count;
    let place = k + phase;
    return vec2f(max((place - 1.0) * length, 0.0), min(place * length, extent));
}

fn stretch_of(k: f32, stretches: Stretches) -> vec2f {
    return stretch_at(k, stretches.count, stretches.phase, stretches.extent);
}

// A way of this extent is cut into `count` parts whose borders are moved by up to half a part to both sides, as `phase` in 0..1 is:
// the first and the last are longer or shorter. Begin and end of the k-th, 0 ≤ k < count.
fn part_at(k: f32, count: f32, phase: f32, extent: f32) -> vec2f {
    let length = extent / count;
    let middle = k + phase;
    return vec2f(select((middle - 0.5) * length, 0.0, k == 0.0), select((middle + 0.5) * length, extent, k + 1.0 >= count));
}

// A medium in front of a picture.
fn gas_over(seen: Seen, behind: vec4f, gas: Gas) -> vec4f {
    let shown = displayed(seen.light, gas.exposure, gas.tone, gas.gamma);
    return seen_over(Seen(shown, seen.through), behind);
}

// A number in (0, 1) for each sample of each pixel, evenly spread over neighbours: the rank-1 lattice of the plastic
// number (M. Roberts, 2018) in 32-bit fixed point, with other axes than that of the dither.
fn sample_phase(pixel: vec2f) -> f32 {
    let place = vec2u(max(floor(pixel * f32(max(view.samples, 1u))), vec2f(0.0)));
    let lattice = place.x * 2447445414u + place.y * 3242174889u;
    return (f32(lattice >> 8u) + 0.5) / 16777216.0;
}

// Radiance to display light: exposure, then Reinhard's curve c/(1 + c) (E. Reinhard et al., "Photographic tone
// reproduction for digital images", SIGGRAPH 2002, equation 3) where `tone` is 0, then the exponent 1/gamma.
fn displayed(radiance: vec3f, exposure: f32, tone: u32, gamma: f32) -> vec3f {
    let exposed = max(radiance * exposure, vec3f(0.0));
    let curved = select(exposed, exposed / (1.0 + exposed), tone == 0u);
    let shown = min(curved, vec3f(1.0));
    if gamma == 1.0 { // a power is good to fewer digits
        return shown;
    }
    return pow(max(shown, vec3f(1e-20)), vec3f(1.0 / gamma));
}
