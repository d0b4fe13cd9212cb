// A cloud with single scattering: for each step towards the eye a march to the light, as the source does it; the way
// through the box is jittered.

fn hash(v: u32) -> u32 {
    let state = v * 747796405u + 2891336453u;
    let word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

// The dot product with one of the twelve slopes of Perlin's cube.
fn slope(word: u32, p: vec3f) -> f32 {
    let k = f32(word >> 20u) * (3.0 / 4096.0);
    let r = fract(k);
    let s = select(-1.0, 1.0, r < 0.5);
    let t = select(-1.0, 1.0, abs(r - 0.5) < 0.25);
    return s * select(p.x, p.y, k < 1.0) + t * select(p.y, p.z, k < 2.0);
}

fn noise(p: vec3f, seed: u32) -> f32 {
    let cell = floor(p);
    let i = bitcast<vec3u>(vec3i(cell));
    let t = p - cell;
    let u = t - 1.0;
    let s = t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
    let low = hash(i.z + seed);
    let high = hash(i.z + 1u + seed);
    let a = hash(i.y + low);
    let b = hash(i.y + 1u + low);
    let c = hash(i.y + high);
    let d = hash(i.y + 1u + high);
    let front = mix(
        mix(slope(hash(i.x + a), t), slope(hash(i.x + 1u + a), vec3f(u.x, t.yz)), s.x),
        mix(slope(hash(i.x + b), vec3f(t.x, u.y, t.z)), slope(hash(i.x + 1u + b), vec3f(u.xy, t.z)), s.x),
        s.y,
    );
    let back = mix(
        mix(slope(hash(i.x + c), vec3f(t.xy, u.z)), slope(hash(i.x + 1u + c), vec3f(u.x, t.y, u.z)), s.x),
        mix(slope(hash(i.x + d), vec3f(t.x, u.yz)), slope(hash(i.x + 1u + d), u), s.x),
        s.y,
    );
    return 0.96 * mix(front, back, s.z);
}

// Cosine and sine of 2.5.
const TURN: vec2f = vec2f(-0.80114362, 0.59847214);

fn density(p: vec3f) -> f32 {
    let falloff = 0.3 - 1.5 * smoothstep(0.1, 1.0, length(p / BOX));
    var q = 1.2 * (vec3f(TURN.x * p.x - TURN.y * p.y, TURN.y * p.x + TURN.x * p.y, p.z) + 3.0);
    var sum = 0.0;
    var weight = 1.0;
    for (var k = 0u; k < 5u; k++) {
        sum += weight * noise(q, hash(k));
        q = 2.0 * vec3f(0.8 * q.x - 0.6 * q.y, 0.48 * q.x + 0.64 * q.y - 0.6 * q.z, 0.36 * q.x + 0.48 * q.y + 0.8 * q.z) + vec3f(0.37, 0.71, 0.19);
        weight *= 0.5;
    }
    return max(0.35 + falloff + 1.6 * sum / 1.9375, 0.0);
}

const BOX: vec3f = vec3f(2.0, 2.0, 1.25);
const DIAGONAL: f32 = 6.1846584;
// per unit where the density is 1
const SIGMA: f32 = 12.8;
const SUN: vec3f = vec3f(-0.09603435, 0.78213704, 0.61566148);
const SUNLIGHT: vec3f = vec3f(36.0, 30.0, 23.0);
const AMBIENT: vec3f = vec3f(0.16, 0.24, 0.38);
const G: f32 = 0.2;
// yaw 32°, pitch -8°
const FROM: vec3f = vec3f(0.83979495, 0.52476213, -0.13917310);
const TOP: vec3f = vec3f(0.11802548, 0.07375051, 0.99026807);

fn box_span(o: vec3f, d: vec3f) -> vec2f {
    let m = 1.0 / d;
    let n = -m * o;
    let k = abs(m) * BOX;
    let a = n - k;
    let b = n + k;
    return vec2f(max(max(a.x, a.y), a.z), min(min(b.x, b.y), b.z));
}

// Optical depth from a point to where the light enters the box.
fn depth_to_light(p: vec3f, jitter: f32) -> f32 {
    let extent = max(box_span(p, SUN).y, 0.0);
    let count = max(ceil(extent / DIAGONAL * 20.0), 1.0);
    let ds = extent / count;
    var tau = 0.0;
    for (var k = 0.0; k < count; k += 1.0) {
        tau += density(p + (k + jitter) * ds * SUN);
    }
    return SIGMA * tau * ds;
}

fn shade(pixel: vec2f) -> vec3f {
    let slope = 2.0 * 0.23086819 / min(view.size.x, view.size.y);
    let at = (pixel - 0.5 * view.size) * slope;
    let o = 6.6 * FROM;
    let d = normalize(at.x * RIGHT - at.y * TOP - FROM);
    let background = vec3f(0.20, 0.36, 0.66) * mix(vec3f(1.0), vec3f(0.60, 0.68, 0.80), 1.0 - exp2(-2.5 * clamp(d.z, 0.0, 1.0)));
    let span = box_span(o, d);
    if span.y <= max(span.x, 0.0) {
        return background;
    }
    let cosine = dot(d, SUN);
    let base = 1.0 + G * G - 2.0 * G * cosine;
    let direct = SUNLIGHT * (1.0 - G * G) / (4.0 * PI * base * sqrt(base));
    let count = ceil((span.y - span.x) / DIAGONAL * 96.0);
    let ds = (span.y - span.x) / count;
    let jitter = phase(pixel);
    // what comes through at last, so that no more light is left out than by the scene
    let bright = direct + AMBIENT;
    let least = 0.0005 / max(1.1 * max(bright.x, max(bright.y, bright.z)), 1.0);
    var light = vec3f();
    var through = 1.0;
    for (var k = 0.0; k < count && through > least; k += 1.0) {
        let p = o + (span.x + (k + jitter) * ds) * d;
        let rho = density(p);
        if rho > 0.0 {
            let alpha = 1.0 - exp(-SIGMA * rho * ds);
            light += through * alpha * (direct * exp(-depth_to_light(p, fract(jitter + 0.618034 * k))) + AMBIENT);
            through *= 1.0 - alpha;
        }
    }
    let exposed = 1.1 * light;
    return exposed / (1.0 + exposed) + through * background;
}
