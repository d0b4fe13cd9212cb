// The levels of a function along a ray, in the order in which the ray meets them, found by one evaluation at a time: the
// scene evaluates value and slope where `March.t` says and hands them to `march_on`, until a level is met or the ray has
// ended. So a scene has one call of the formula, however many ways to search there are.
//
// The ray is sampled at equal steps. Between two samples the levels are those that lie between their values, each
// bracketed by the signs of f - level and refined by Newton's method with the exact slope, kept within the bracket and
// helped by bisection where it is slow. Where both samples lie between the same two levels but the slopes lead to one of
// them and back, the extremum is looked for. A sign change over which |f - level| does not shrink with the bracket is a
// pole or a jump, and no level. Where f ceases to be defined within a step, the step ends there.

// The levels lowest + k spacing, 0 ≤ k < count.
struct Family {
    lowest: f32,
    spacing: f32,
    count: u32,
}

// f on the ray; nothing else of it counts where it is not valid.
struct Probe {
    t: f32,
    u: f32,      // (f - lowest)/spacing
    slope: f32,  // du/dt
    valid: bool,
}

struct March {
    t: f32,           // where f is to be evaluated next
    state: u32,
    hit: bool,        // whether a level was met; to be set to false by who has seen it
    hit_level: i32,   // which
    hit_t: f32,       // where
    touching: bool,   // whether f only touches it
    near: Probe,      // how far the ray has been searched
    far: Probe,       // the end of what is searched
    later: Probe,     // the end of the step, where `split`
    split: bool,
    band: i32,        // number of levels at or below f at `near`
    k: u32,           // steps taken
    count: u32,       // steps in all
    step: f32,
    low: Probe,       // of a search, its bracket
    high: Probe,
    nearest: Probe,   // of a search for an extremum, the sample nearest to the level
    low_weight: f32,
    high_weight: f32,
    width: f32,       // of a search for a root, that of the bracket before
    before: f32,      // of a search for a root, the greatest distance from the level at its start
    rounds: u32,
    level: i32,       // of a search
}

const MARCH_WALK: u32 = 0u;
const MARCH_EDGE: u32 = 1u;
const MARCH_DIP: u32 = 2u;
const MARCH_ROOT: u32 = 3u;
const MARCH_DONE: u32 = 4u;
// Values in spacings are kept within this, so that differences and ratios of them are finite.
const MARCH_LARGEST: f32 = 1e30;

// A march over 0..extent in `count` steps, at least one; nothing is to be done where the extent is not positive.
fn march_over(extent: f32, count: u32) -> March {
    var m = March();
    m.count = max(count, 1u);
    m.step = extent / f32(m.count);
    m.state = select(MARCH_DONE, MARCH_WALK, extent > 0.0);
    return m;
}

fn march_is_done(m: March) -> bool {
    return m.state == MARCH_DONE;
}

fn probe_of(t: f32, jet: vec2f, family: Family) -> Probe {
    let u = clamp((jet.x - family.lowest) / family.spacing, -MARCH_LARGEST, MARCH_LARGEST);
    let slope = select(clamp(jet.y / family.spacing, -MARCH_LARGEST, MARCH_LARGEST), 0.0, is_nan(jet.y));
    return Probe(t, u, slope, !is_nan(jet.x));
}

// Whether f and df/dt at m.t are the end of a step in which there is nothing to search, and not the last one. Scenes walk
// such steps in a loop of their own, by `march_stride`, so that rays side by side walk together to where each has
// something to search, and then search together.
fn march_strides(m: March, jet: vec2f, family: Family) -> bool {
    if m.state != MARCH_WALK || m.k == 0u || m.k >= m.count {
        return false;
    }
    let probe = probe_of(m.t, jet, family);
    if !probe.valid || !m.near.valid {
        return probe.valid == m.near.valid;
    }
    return band_of(probe, family) == m.band && dip_level(m.near, probe, m.band, family) < 0;
}

// The step that `march_strides` is true of.
fn march_stride(before: March, jet: vec2f, family: Family) -> March {
    var m = before;
    m.near = probe_of(m.t, jet, family);
    m.k++;
    m.t = f32(m.k) * m.step;
    return m;
}

// Takes f and df/dt at m.t.
fn march_on(m: March, jet: vec2f, family: Family) -> March {
    let probe = probe_of(m.t, jet, family);
    switch m.state {
        case MARCH_EDGE: { return edge_on(m, probe, family); }
        case MARCH_DIP: { return dip_on(m, probe, family); }
        case MARCH_ROOT: { return root_on(m, probe, family); }
        default: { return walk_on(m, probe, family); }
    }
}

// Number of levels at or below f.
fn band_of(probe: Probe, family: Family) -> i32 {
    return i32(clamp(floor(probe.u) + 1.0, 0.0, f32(family.count)));
}

fn walk_on(before: March, probe: Probe, family: Family) -> March {
    var m = before;
    if m.k == 0u {
        m.far = probe;
        return step_on(m, family);
    }
    m.far = probe;
    return settle(m, family);
}

// Goes on to the rest of the step, or to the next one.
fn step_on(before: March, family: Family) -> March {
    var m = before;
    m.near = m.far;
    m.band = band_of(m.near, family);
    if m.split {
        m.split = false;
        m.far = m.later;
        if m.far.valid {
            return search_rest(m, family);
        }
        m.near = m.far;
    }
    m.k++;
    m.t = f32(m.k) * m.step;
    m.state = select(MARCH_WALK, MARCH_DONE, m.k > m.count);
    return m;
}

// What there is to be done between `near` and `far`.
fn settle(before: March, family: Family) -> March {
    var m = before;
    if m.near.valid && m.far.valid {
        if band_of(m.far, family) != m.band {
            return root_between(m, family);
        }
        let level = dip_level(m.near, m.far, m.band, family);
        if !m.split && level >= 0 {
            return dip_between(m, level);
        }
    } else if m.near.valid != m.far.valid && !m.split {
        return edge_between(m);
    }
    return step_on(m, family);
}

// `settle` for the rest of a step that was split, both of whose ends are valid.
fn search_rest(before: March, family: Family) -> March {
    var m = before;
    if band_of(m.far, family) != m.band {
        return root_between(m, family);
    }
    m.near = m.far;
    m.k++;
    m.t = f32(m.k) * m.step;
    m.state = select(MARCH_WALK, MARCH_DONE, m.k > m.count);
    return m;
}

// ---- Where f ceases to be defined, by bisection from the valid side ------------------------------------------

fn edge_between(before: March) -> March {
    var m = before;
    m.state = MARCH_EDGE;
    m.rounds = 0u;
    m.low = m.near;
    m.high = m.far;
    if !m.near.valid {
        m.low = m.far;
        m.high = m.near;
    }
    m.t = 0.5 * (m.low.t + m.high.t);
    return m;
}

fn edge_on(before: March, probe: Probe, family: Family) -> March {
    var m = before;
    if probe.valid {
        m.low = probe;
    } else {
        m.high = probe;
    }
    m.rounds++;
    m.t = 0.5 * (m.low.t + m.high.t);
    if m.rounds < 12u {
        return m;
    }
    if m.near.valid {
        m.later = m.far;
        m.far = m.low;
        m.split = true;
    } else {
        m.near = m.low;
        m.band = band_of(m.near, family);
    }
    return settle(m, family);
}

// ---- Extrema between samples of one band ---------------------------------------------------------------------

// The level that the slopes lead to and back from, or -1.
fn dip_level(a: Probe, b: Probe, band: i32, family: Family) -> i32 {
    if a.slope < 0.0 && b.slope > 0.0 && band > 0 && may_dip(a, b, band - 1) {
        return band - 1;
    }
    if a.slope > 0.0 && b.slope < 0.0 && band < i32(family.count) && may_dip(a, b, band) {
        return band;
    }
    return -1;
}

// Whether the tangents at a and b, which lead to the level and back, meet beyond it or within a tenth before it. Where
// the distance from the level is convex, they are a bound of it.
fn may_dip(a: Probe, b: Probe, level: i32) -> bool {
    let va = abs(a.u - f32(level));
    let vb = abs(b.u - f32(level));
    let top = max(abs(a.slope), abs(b.slope));
    let f = abs(a.slope) / top;
    let r = abs(b.slope) / top;
    // value where the tangents meet, times f + r
    let met = vb * f + va * r - f * abs(b.slope) * (b.t - a.t);
    return met <= 0.1 * max(va, vb) * (f + r);
}

fn dip_between(before: March, level: i32) -> March {
    var m = before;
    m.state = MARCH_DIP;
    m.rounds = 0u;
    m.level = level;
    m.low = m.near;
    m.high = m.far;
    m.nearest = m.near;
    if abs(m.far.u - f32(level)) < abs(m.near.u - f32(level)) {
        m.nearest = m.far;
    }
    m.low_weight = 1.0;
    m.high_weight = 1.0;
    m.t = dip_guess(m);
    return m;
}

// Regula falsi on the slope, with the weights of Illinois (Dowell and Jarratt 1971).
fn dip_guess(m: March) -> f32 {
    let down = m.low_weight * abs(m.low.slope);
    let up = m.high_weight * abs(m.high.slope);
    return mix(m.low.t, m.high.t, clamp(down / max(down + up, 1e-37), 0.02, 0.98));
}

fn dip_on(before: March, probe: Probe, family: Family) -> March {
    var m = before;
    if !probe.valid {
        return step_on(m, family);
    }
    if band_of(probe, family) != m.band {
        m.later = m.far;
        m.far = probe;
        m.split = true;
        return settle(m, family);
    }
    if abs(probe.u - f32(m.level)) <= abs(m.nearest.u - f32(m.level)) {
        m.nearest = probe;
    }
    if (probe.slope < 0.0) == (m.near.slope < 0.0) {
        m.low = probe;
        m.low_weight = 1.0;
        m.high_weight *= 0.5;
    } else {
        m.high = probe;
        m.high_weight = 1.0;
        m.low_weight *= 0.5;
    }
    m.rounds++;
    m.t = dip_guess(m);
    if m.rounds < 12u && may_dip(m.low, m.high, m.level) {
        return m;
    }
    // even roots: the extremum equals the level to rounding
    let size = max(abs(m.near.u - f32(m.level)), abs(m.far.u - f32(m.level)));
    m.hit = abs(m.nearest.u - f32(m.level)) <= 3e-7 * size;
    m.touching = m.hit;
    m.hit_level = m.level;
    m.hit_t = m.nearest.t;
    return step_on(m, family);
}

// ---- Roots between samples of two bands ----------------------------------------------------------------------

fn root_between(before: March, family: Family) -> March {
    var m = before;
    m.state = MARCH_ROOT;
    m.rounds = 0u;
    m.level = select(m.band - 1, m.band, band_of(m.far, family) > m.band);
    m.low = m.near;
    m.high = m.far;
    m.width = 2.0 * (m.far.t - m.near.t);
    m.before = max(abs(m.near.u - f32(m.level)), abs(m.far.u - f32(m.level)));
    m.t = root_guess(m);
    return m;
}

// The end of the bracket that is nearer to the level.
fn nearer_end(m: March) -> Probe {
    if abs(m.low.u - f32(m.level)) <= abs(m.high.u - f32(m.level)) {
        return m.low;
    }
    return m.high;
}

// Least distance along the ray that is told apart.
fn march_tolerance(m: March) -> f32 {
    return 1.2e-7 * (abs(m.high.t) + m.step * f32(m.count)) + 1e-37;
}

// Newton's step from the end of the bracket that is nearer, and a little further, so that the bracket closes; bisection
// where that leaves the bracket, or the bracket has not become half as wide.
fn root_guess(m: March) -> f32 {
    let best = nearer_end(m);
    let inward = select(-1.0, 1.0, best.t <= m.low.t);
    let t = best.t - (best.u - f32(m.level)) / select(best.slope, 1e-37, best.slope == 0.0) + inward * march_tolerance(m);
    let middle = 0.5 * (m.low.t + m.high.t);
    let good = t > m.low.t && t < m.high.t && (m.high.t - m.low.t) <= 0.5 * m.width;
    return select(middle, t, good);
}

fn root_on(before: March, probe: Probe, family: Family) -> March {
    var m = before;
    if !probe.valid {
        return step_on(m, family);
    }
    m.width = m.high.t - m.low.t;
    let beyond = (probe.u >= f32(m.level)) == (m.level >= m.band);
    if beyond {
        m.high = probe;
    } else {
        m.low = probe;
    }
    m.rounds++;
    m.t = root_guess(m);
    if m.high.t - m.low.t > 2.0 * march_tolerance(m) && m.rounds < 48u {
        return m;
    }
    return root_found(m, family);
}

fn root_found(before: March, family: Family) -> March {
    var m = before;
    let after = max(abs(m.low.u - f32(m.level)), abs(m.high.u - f32(m.level)));
    let rising = m.level >= m.band;
    if after < 0.25 * m.before || after < 1e-3 {
        m.hit = true;
        m.touching = false;
        m.near = nearer_end(m);
        m.hit_level = m.level;
        m.hit_t = m.near.t;
        m.band = select(m.level, m.level + 1, rising);
    } else {
        m.near = m.high;
        m.band = band_of(m.near, family);
    }
    return settle(m, family);
}
