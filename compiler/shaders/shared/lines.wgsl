// Lines and stripes, filtered exactly: each function is the mean of its pattern over a window (a box filter), for
// a pattern that is linear across the window. Distances are in pixels, or in periods where said.

// Overlap of the window of `window` around `offset` with the line of `width` around 0, as a part of the window.
fn line_coverage(offset: f32, width: f32, window: f32) -> f32 {
    let high = min(offset + 0.5 * window, 0.5 * width);
    let low = max(offset - 0.5 * window, -0.5 * width);
    return clamp((high - low) / max(window, 1e-20), 0.0, 1.0);
}

// Distance to the nearest integer, signed, in [-0.5, 0.5]: negative below it.
fn offset_from_integer(u: f32) -> f32 {
    return u - floor(u + 0.5);
}

// Lines at the integers of u, each covering `duty` of a period. `window` in periods; from one period on the result
// is the mean, `duty`.
fn line_train(u: f32, duty: f32, window: f32) -> f32 {
    let part = clamp(duty, 0.0, 1.0);
    let w = clamp(window, 1e-20, 1.0);
    return overlap_of_lines(abs(offset_from_integer(u)), 1.0, part, w) / w;
}

// Length of a window's overlap with lines that are `apart` from one another. Neither is wider than that; `away`, at most
// half of it, is how far the nearest line is from the window's middle.
fn overlap_of_lines(away: f32, apart: f32, width: f32, window: f32) -> f32 {
    let reach = 0.5 * (width + window);
    return clamp(reach - away, 0.0, min(width, window)) + max(reach + away - apart, 0.0);
}

// Coverage of a sample by lines of constant width, `apart` pixels from one another and so 1/`apart` a pixel, `away` pixels
// from the nearest.
fn coverage_of_lines(away: f32, apart: f32, per_pixel: f32, width: f32) -> f32 {
    let overlap = overlap_of_lines(away, apart, min(width, apart), min(sample_window(), apart));
    return overlap * max(samples_per_pixel(), per_pixel);
}

// Coverage of a sample by one line.
fn coverage_of_line(away: f32, width: f32) -> f32 {
    let window = sample_window();
    return clamp(0.5 * (width + window) - away, 0.0, min(width, window)) * samples_per_pixel();
}

// The sawtooth u - floor(u). `window` in periods; from one period on the result is the mean, 1/2.
fn saw_train(u: f32, window: f32) -> f32 {
    let w = clamp(window, 1e-20, 1.0);
    let y = offset_from_integer(u);
    return y + clamp(0.5 - y / w, 0.0, 1.0);
}

// The wave (1 + sin τu)/2. `window` in periods; from one period on the result is the mean, 1/2.
fn wave_train(u: f32, window: f32) -> f32 {
    let w = clamp(window, 0.0, 1.0);
    let x = 3.141592653589793 * w;
    let fade = select(sin(x) / max(x, 1e-3), 1.0 - x * x / 6.0, x < 0.03);
    return 0.5 + 0.5 * fade * sin(6.283185307179586 * (u - floor(u)));
}

// Diagonal stripes on the screen, covering `duty` of them, `period` pixels apart; rising to the right for
// `slope` = -1 (y is down) and falling for +1.
fn hatch(pixel: vec2f, slope: f32, period: f32, duty: f32, window: f32) -> f32 {
    let u = (pixel.x - slope * pixel.y) * 0.7071067811865476 / period;
    return line_train(u, duty, window / period);
}

// The square wave that is 1 on [2k, 2k + 1) and -1 on [2k + 1, 2k + 2). `window` in units of u; from two on the result is
// the mean, 0. A window with one edge in it has the mean 2d/w, where d is from the edge to its middle; one with two has
// no more than 2/w - 1.
fn square_train(u: f32, window: f32) -> f32 {
    let place = 0.5 * u + 0.25;
    let from_middle = place - floor(place) - 0.5;
    // without a window an edge is of the square that begins there
    let from_edge = 0.5 - 2.0 * abs(from_middle) - 1e-19 * from_middle;
    let per_window = 2.0 / max(window, 1e-20);
    let most = clamp(per_window - 1.0, 0.0, 1.0);
    return clamp(from_edge * per_window, -most, most);
}

// base^n for a base of 1 or more and |n| up to 127, by squaring: exact as long as the result is a whole number below 2²⁴.
fn whole_power(base: f32, n: u32) -> f32 {
    var result = 1.0;
    var factor = base;
    for (var k = n; k > 0u; k >>= 1u) {
        if (k & 1u) == 1u {
            result *= factor;
        }
        factor *= factor;
    }
    return result;
}

// u / base^n, exactly rounded where base^|n| is exact.
fn over_power(u: f32, base: f32, n: i32) -> f32 {
    let power = whole_power(base, u32(abs(n)));
    return select(u * power, u / power, n > 0);
}

// base^n, exact where base is a power of two, and where base^|n| is a whole number below 2²⁴ and n ≥ 0.
fn base_power(base: f32, n: i32) -> f32 {
    let bits = bitcast<u32>(base);
    if (bits & 0x007fffffu) == 0u {
        let exponent = clamp((i32(bits >> 23u) - 127) * n, -126, 127);
        return bitcast<f32>(u32(exponent + 127) << 23u);
    }
    return over_power(1.0, base, -n);
}

// A family of line spacings base^n, each a whole multiple of the one below. Of those spacings that are at least `apart`
// pixels on the screen, the finest is base^finest; it is base^blend times as far apart as it needs, 0 ≤ blend < 1.
struct Octave {
    finest: i32,
    blend: f32,
    scale: f32,  // base^-finest
}

// `rate`: change of the coordinate per pixel.
fn octave_of_rate(rate: f32, apart: f32, base: f32) -> Octave {
    // for a constant a spacing that is no power of a small base, which rounding would put into either octave
    let place = log2(clamp(rate * apart, 3e-10, 1e37)) / log2(base);
    let finest = ceil(place);
    return Octave(i32(finest), finest - place, base_power(base, -i32(finest)));
}

// Whether f32 tells places within a period apart, u periods from 0: 1 as long as it has 128 of them, 0 from 32 on.
fn resolved(u: f32) -> f32 {
    return select(0.0, 1.0 - smoothstep(RESOLVED, 4.0 * RESOLVED, u), u < 4.0 * RESOLVED);
}

const RESOLVED: f32 = 131072.0;

// Lines of constant width at the multiples of base^n of a coordinate u = whole + part, for all n from `finest` up. The
// finest ones fade in as the picture is magnified, over `count` octaves (at least two): a line's weight depends on how far
// it is from its equals on the screen, and is continuous when the finest octave changes.
fn octave_lines(whole: f32, part: f32, rate: f32, octave: Octave, base: f32, count: u32, width: f32) -> f32 {
    if rate <= 0.0 {
        return 0.0;
    }
    let octaves = f32(max(count, 2u));
    let step = 1.0 / (octaves - 1.0);
    var scale = octave.scale;
    var per_pixel = max(rate * scale, 1e-30);
    var apart = 1.0 / per_pixel;
    let far = max(abs(whole), abs(part));
    let is_resolved = far * scale < RESOLVED;
    // then so are those of all other octaves
    let are_apart = apart > width + sample_window();
    var covered = 0.0;
    for (var j = 0.0; j < octaves; j += 1.0) {
        var u = part * scale;
        if whole != 0.0 {
            u += fract_of(whole * scale);
        }
        var weight = min((j + octave.blend) * step, 1.0);
        if !is_resolved {
            weight *= resolved(far * scale);
        }
        let away = abs(offset_from_integer(u)) * apart;
        if are_apart {
            covered = max(covered, weight * coverage_of_line(away, width));
        } else {
            covered = max(covered, weight * coverage_of_lines(away, apart, per_pixel, width));
        }
        scale /= base;
        per_pixel /= base;
        apart *= base;
    }
    return covered;
}

// x - floor x.
fn fract_of(x: f32) -> f32 {
    return x - floor(x);
}

// Lines of constant width at the integers of u, which changes by `rate` per pixel. Where they crowd they thin out to an even
// tone, and they end where f32 no longer resolves the place between two of them.
fn even_lines(u: f32, rate: f32, width: f32) -> f32 {
    if (abs(u) > 4194304.0) | (rate < 1e-30) {
        return 0.0;
    }
    let apart = 1.0 / rate;
    let away = abs(offset_from_integer(u)) * apart;
    if apart > max(width / CROWDED, width + sample_window()) {
        // none is dimmed, and no sample sees two
        return coverage_of_line(away, width) * (1.0 - smoothstep(0.5, 4.0, rate));
    }
    let dimming = min(CROWDED / max(width, 1e-20) * apart, 1.0);
    return coverage_of_lines(away, apart, rate, width) * dimming * (1.0 - smoothstep(0.5, 4.0, rate));
}

// Lines may darken an area by no more than this on average, however dense they are.
const CROWDED: f32 = 0.34;

// Squares of both signs along one coordinate, at two octaves of side, the finer one as strong as it has faded in.
fn octave_squares(u: f32, rate: f32, octave: Octave, base: f32) -> f32 {
    let place = u * octave.scale;
    let window = rate * octave.scale * sample_window();
    let fine = square_train(place, window);
    let coarse = square_train(place / base, window / base);
    if abs(place) < RESOLVED {
        return mix(coarse, fine, octave.blend);
    }
    return (1.0 - octave.blend) * known_part(coarse, place / base) + octave.blend * known_part(fine, place);
}

// A wave's value as far as its place is known.
fn known_part(value: f32, place: f32) -> f32 {
    let known = resolved(abs(place));
    return select(known * value, 0.0, known == 0.0);
}
