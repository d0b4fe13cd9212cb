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
    floor: f32,       // while it walks, u between the levels around `near` is from this to below `ceiling`
    ceiling: f32,     // while it searches, this is below `floor`
    lost: bool,       // while it walks, whether f is undefined at `near`
    k: f32,           // steps taken
    count: f32,       // steps in all
    step: f32,
    low: Probe,       // of a search, its bracket
    high: Probe,
    nearest: Probe,   // of a search for an extremum, the sample nearest to the level
    low_weight: f32,
    high_weight: f32,
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
    m.count = f32(max(count, 1u));
    m.step = extent / m.count;
    m.state = select(MARCH_DONE, MARCH_WALK, extent > 0.0);
    return between_nothing(m);
}

fn march_is_done(m: March) -> bool {
    return m.state == MARCH_DONE;
}

fn probe_of(t: f32, jet: vec2f, family: Family) -> Probe {
    return tamed(Probe(t, (jet.x - family.lowest) / family.spacing, jet.y / family.spacing, !is_nan(jet.x)));
}

// Whether f and df/dt at m.t are the end of a step in which there is nothing to search, and not the last one. Scenes walk
// such steps in a loop of their own, by `march_stride`, so that rays side by side walk together to where each has
// something to search, and then search together. Most of a ray is such steps: what they take is a few comparisons.
fn march_strides(m: March, jet: vec2f, family: Family) -> bool {
    let u = (jet.x - family.lowest) / family.spacing;
    let between = select((u >= m.floor) & (u < m.ceiling), m.lost, is_nan(jet.x));
    if !between | (m.k >= m.count) {
        return false;
    }
    if (jet.y < 0.0) == (m.near.slope < 0.0) {
        return true;
    }
    return m.lost || dip_level(tamed(m.near), probe_of(m.t, jet, family), m.band, family) < 0;
}

// The step that `march_strides` is true of.
fn march_stride(before: March, jet: vec2f, family: Family) -> March {
    var m = before;
    m.near = Probe(m.t, (jet.x - family.lowest) / family.spacing, jet.y / family.spacing, !m.lost);
    m.k += 1.0;
    m.t = m.k * m.step;
    return m;
}

// A probe with numbers of which differences and ratios are finite.
fn tamed(probe: Probe) -> Probe {
    let u = clamp(probe.u, -MARCH_LARGEST, MARCH_LARGEST);
    let slope = select(clamp(probe.slope, -MARCH_LARGEST, MARCH_LARGEST), 0.0, is_nan(probe.slope));
    return Probe(probe.t, u, slope, probe.valid);
}

// A march that goes on to step k, after what `near` and `band` say of the way before.
fn walking(before: March, k: f32, family: Family) -> March {
    var m = before;
    m.k = k;
    m.t = k * m.step;
    m.state = select(MARCH_WALK, MARCH_DONE, k > m.count);
    m.lost = !m.near.valid;
    if m.lost {
        return between_nothing(m);
    }
    m.floor = select(f32(m.band - 1), -2.0 * MARCH_LARGEST, m.band == 0);
    m.ceiling = select(f32(m.band), 2.0 * MARCH_LARGEST, m.band == i32(family.count));
    return m;
}

// No value is between these.
fn between_nothing(before: March) -> March {
    var m = before;
    m.floor = 1.0;
    m.ceiling = 0.0;
    return m;
}

// A march that looks elsewhere than at its next step.
fn searching(before: March, state: u32) -> March {
    var m = before;
    m.state = state;
    m.rounds = 0u;
    m.lost = false;
    return between_nothing(m);
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
    m.far = probe;
    if m.k == 0.0 {
        return step_on(m, family);
    }
    m.near = tamed(m.near);
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
    return walking(m, m.k + 1.0, family);
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
    return walking(m, m.k + 1.0, family);
}

// ---- Where f ceases to be defined, by bisection from the valid side ------------------------------------------

fn edge_between(before: March) -> March {
    var m = searching(before, MARCH_EDGE);
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
    var m = searching(before, MARCH_DIP);
    m.level = level;
    m.low = m.near;
    m.high = m.far;
    m.nearest = m.near;
    if away(m, m.far) < away(m, m.near) {
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
    if away(m, probe) <= away(m, m.nearest) {
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
    let size = max(away(m, m.near), away(m, m.far));
    m.hit = away(m, m.nearest) <= 3e-7 * size;
    m.touching = m.hit;
    m.hit_level = m.level;
    m.hit_t = m.nearest.t;
    return step_on(m, family);
}

// ---- Roots between samples of two bands ----------------------------------------------------------------------

fn root_between(before: March, family: Family) -> March {
    var m = searching(before, MARCH_ROOT);
    m.level = select(m.band - 1, m.band, band_of(m.far, family) > m.band);
    m.low = m.near;
    m.high = m.far;
    m.before = max(away(m, m.near), away(m, m.far));
    m.t = root_guess(m, true);
    return m;
}

// Distance from the level that is searched for, in spacings.
fn away(m: March, probe: Probe) -> f32 {
    return abs(probe.u - f32(m.level));
}

// The end of the bracket that is nearer to the level.
fn nearer_end(m: March) -> Probe {
    if away(m, m.low) <= away(m, m.high) {
        return m.low;
    }
    return m.high;
}

// Least distance along the ray that is told apart.
fn march_tolerance(m: March) -> f32 {
    return 1.2e-7 * (abs(m.high.t) + m.step * m.count) + 1e-37;
}

// Where Newton's step from a probe ends.
fn newton_place(m: March, probe: Probe) -> f32 {
    return probe.t - (probe.u - f32(m.level)) / select(probe.slope, 1e-37, probe.slope == 0.0);
}

// Newton's step from the end of the bracket that is nearer, and a little further, so that the bracket closes; bisection
// where that leaves the bracket, or the search is slow.
fn root_guess(m: March, fast: bool) -> f32 {
    let best = nearer_end(m);
    let inward = select(-2.0, 2.0, best.t <= m.low.t);
    let t = newton_place(m, best) + inward * march_tolerance(m);
    return select(0.5 * (m.low.t + m.high.t), t, fast && t > m.low.t && t < m.high.t);
}

fn root_on(before: March, probe: Probe, family: Family) -> March {
    var m = before;
    if !probe.valid {
        return step_on(m, family);
    }
    let width = m.high.t - m.low.t;
    let least = min(away(m, m.low), away(m, m.high));
    let beyond = (probe.u >= f32(m.level)) == (m.level >= m.band);
    if beyond {
        m.high = probe;
    } else {
        m.low = probe;
    }
    m.rounds++;
    // it is slow where neither the bracket has become half as wide nor its nearer end a quarter as far from the level
    m.t = root_guess(m, m.high.t - m.low.t <= 0.5 * width || away(m, probe) <= 0.25 * least);
    // Both ends are as near as rays are resolved; Newton's step from the nearer one places the level between them.
    if m.high.t - m.low.t > 8.0 * march_tolerance(m) && m.rounds < 48u {
        return m;
    }
    return root_found(m, family);
}

fn root_found(before: March, family: Family) -> March {
    var m = before;
    let after = max(away(m, m.low), away(m, m.high));
    let rising = m.level >= m.band;
    if after < 0.25 * m.before || after < 1e-3 {
        m.hit = true;
        m.touching = false;
        m.near = nearer_end(m);
        m.hit_level = m.level;
        m.hit_t = clamp(newton_place(m, m.near), m.low.t, m.high.t);
        m.band = select(m.level, m.level + 1, rising);
    } else {
        m.near = m.high;
        m.band = band_of(m.near, family);
    }
    return settle(m, family);
}
