// Families of levels, for the twins that composite them.

struct Seen {
    light: vec3f,
    through: f32,
}

const EDGE: vec3f = vec3f(0.012, 0.014, 0.02);

fn behind(seen: Seen, colour: vec3f, opacity: f32) -> Seen {
    return Seen(seen.light + seen.through * opacity * colour, seen.through * (1.0 - opacity));
}

// Colour of a level k of `count`.
fn level_colour(k: f32, count: f32) -> vec3f {
    return diverging(0.85 * (k - 0.5 * (count - 1.0)) / (0.5 * (count - 1.0)));
}

// A level set where a ray meets it; all are ghosts but the one in the middle.
fn shell(seen: Seen, k: f32, count: f32, g: vec3f, d: vec3f, ghost: f32) -> Seen {
    let uphill = normalize(g);
    let outside = dot(uphill, d) <= 0.0;
    let n = select(-uphill, uphill, outside);
    let own = level_colour(k, count);
    let colour = lit(0.8 * select(mix(own, vec3f(1.0), 0.3), own, outside), n, -d, 1.0);
    let opacity = select(1.0 - pow(1.0 - ghost, 1.0 / max(-dot(n, d), 0.125)), 1.0, k == 0.5 * (count - 1.0));
    return behind(seen, colour, opacity);
}

// A wall of the box: a tint where it is behind, and the line of each level. u is the value in levels from the lowest.
fn levels_wall(before: Seen, u: f32, rate: f32, count: f32, is_behind: bool) -> Seen {
    var seen = before;
    if u > -0.5 && u < count - 0.5 {
        let ink = line(abs(u - round(u)) / max(rate, 1e-20), 1.4) * min(1.0, 0.34 / max(1.4 * rate, 1e-20)) * (1.0 - smoothstep(0.5, 4.0, rate));
        let own = level_colour(clamp(round(u), 0.0, count - 1.0), count);
        seen = behind(seen, mix(0.35 * own, EDGE, 0.2), select(0.55, 0.9, is_behind) * ink);
    }
    if is_behind {
        let tint = diverging(clamp((2.0 * u - count + 1.0) / count, -1.0, 1.0));
        seen = behind(seen, mix(tint, vec3f(1.0), 0.25), 0.30);
    }
    return seen;
}
