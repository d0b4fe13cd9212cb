// The Gaussian footprint of a pixel.

// The normal distribution's Φ(x) = (1 + erf(x/√2))/2 for |x| ≤ 8, as a logistic function of an odd polynomial, whose
// coefficients are fitted: exact to 2e-5 everywhere, which is less than a tenth of a step of 8 bits.
fn normal_cdf(x: f32) -> f32 {
    let q = x * x;
    return 1.0 / (1.0 + exp2(-x * (2.30172713 + q * (0.106177323 - q * 0.000911226628))));
}
