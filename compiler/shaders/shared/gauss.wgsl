// The Gaussian footprint of a pixel.

// The normal distribution's Φ(x) = (1 + erf(x/√2))/2. The error function is Abramowitz and Stegun, Handbook of
// Mathematical Functions, formula 7.1.26, exact to 1.5e-7; Φ is exact to 3e-7 with the rounding of float32.
fn normal_cdf(x: f32) -> f32 {
    let s = min(abs(x) * 0.7071067811865476, 9.0);
    let t = 1.0 / (1.0 + 0.3275911 * s);
    let tail = t * (0.254829592 + t * (-0.284496736 + t * (1.421413741 + t * (-1.453152027 + t * 1.061405429))));
    let complement = 0.5 * tail * exp(-s * s);
    return select(complement, 1.0 - complement, x >= 0.0);
}
