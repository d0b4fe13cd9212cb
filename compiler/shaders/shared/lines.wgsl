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
