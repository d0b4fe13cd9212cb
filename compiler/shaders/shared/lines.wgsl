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
    let y = offset_from_integer(u);
    let covered = line_coverage(y, part, w) + line_coverage(y - 1.0, part, w) + line_coverage(y + 1.0, part, w);
    return clamp(covered, 0.0, 1.0);
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
// the mean, 0.
fn square_train(u: f32, window: f32) -> f32 {
    return 2.0 * line_train(0.5 * u - 0.25, 0.5, 0.5 * window) - 1.0;
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

// A family of line spacings base^n, each a whole multiple of the one below. Of those spacings that are at least `apart`
// pixels on the screen, the finest is base^finest; it is base^blend times as far apart as it needs, 0 ≤ blend < 1.
struct Octave {
    finest: i32,
    blend: f32,
}

// `rate`: change of the coordinate per pixel.
fn octave_of_rate(rate: f32, apart: f32, base: f32) -> Octave {
    let place = log2(max(rate * apart, 1e-9)) / log2(base);
    let finest = ceil(place);
    return Octave(i32(finest), finest - place);
}

// Whether f32 tells places within a period apart, u periods from 0: 1 as long as it has 128 of them, 0 from 32 on.
fn resolved(u: f32) -> f32 {
    return select(0.0, 1.0 - smoothstep(131072.0, 524288.0, u), u < 524288.0);
}

// Lines of constant width at the multiples of base^n of a coordinate u = whole + part, for all n from `finest` up. The
// finest ones fade in as the picture is magnified, over `count` octaves (at least two): a line's weight depends on how far
// it is from its equals on the screen, and is continuous when the finest octave changes.
fn octave_lines(whole: f32, part: f32, rate: f32, octave: Octave, base: f32, count: u32, width: f32) -> f32 {
    let steps = f32(max(count, 2u)) - 1.0;
    var covered = 0.0;
    for (var j = 0u; j < max(count, 2u); j++) {
        let n = octave.finest + i32(j);
        let coarse = over_power(whole, base, n);
        let fine = over_power(part, base, n);
        let u = (coarse - floor(coarse)) + fine;
        let per_pixel = over_power(rate, base, n);
        let weight = resolved(max(abs(coarse), abs(fine))) * min((f32(j) + octave.blend) / steps, 1.0);
        if weight > 0.0 {
            covered = max(covered, weight * line_train(u, min(per_pixel * width, 1.0), per_pixel * sample_window()));
        }
    }
    return covered;
}

// Lines of constant width at the integers of u, which changes by `rate` per pixel. Where they crowd they thin out to an even
// tone, and they end where f32 no longer resolves the place between two of them.
fn even_lines(u: f32, rate: f32, width: f32) -> f32 {
    if abs(u) > 4194304.0 {
        return 0.0;
    }
    let duty = min(rate * width, 1.0);
    let dimming = min(1.0, CROWDED / max(rate * width, 1e-20));
    return line_train(u, duty, rate * sample_window()) * dimming * (1.0 - smoothstep(0.5, 4.0, rate));
}

// Lines may darken an area by no more than this on average, however dense they are.
const CROWDED: f32 = 0.34;

// Squares of both signs along one coordinate, at two octaves of side, the finer one as strong as it has faded in.
fn octave_squares(u: f32, rate: f32, octave: Octave, base: f32) -> f32 {
    return octave.blend * squares_of_side(u, rate, base, octave.finest)
        + (1.0 - octave.blend) * squares_of_side(u, rate, base, octave.finest + 1);
}

fn squares_of_side(u: f32, rate: f32, base: f32, n: i32) -> f32 {
    let place = over_power(u, base, n);
    let known = resolved(abs(place));
    if known == 0.0 {
        return 0.0;
    }
    return known * square_train(place, over_power(rate, base, n) * sample_window());
}
