//! What an adapter does to binary32 arithmetic, found out by trying.

use naga::valid::{Capabilities, ValidationFlags, Validator};
use pullback_compiler::EvalModule;
use pullback_compiler::lower::Format;

use crate::evaluate::Surroundings;
use crate::{Error, Gpu, GpuEvaluator};

/// Rows that are tried.
const ROWS: usize = 1 << 16;
/// Results of a row, as `probe.wgsl` writes them.
const RESULTS: usize = 13;

/// Findings over many pairs of numbers. Shares are of results that were wrong, from 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arithmetic {
    /// TwoSum as written: above zero where the driver reassociates sums.
    pub two_sum: f64,
    /// TwoSum with every step hidden from the shader compiler.
    pub two_sum_opaque: f64,
    /// TwoProd by `fma`: above zero where that rounds twice.
    pub two_prod_fma: f64,
    /// TwoProd by Dekker's splitting, hidden likewise.
    pub two_prod_split: f64,
    /// Largest error of a quotient in units in the last place; 0.5 is correct rounding.
    pub division_ulp: f64,
    /// Largest error of a square root, likewise.
    pub sqrt_ulp: f64,
    /// Subnormal numbers are kept, not flushed to zero.
    pub subnormals: bool,
    /// NaN is unequal to itself.
    pub nan: bool,
    /// Dividing by zero gives infinity.
    pub infinity: bool,
}

/// Tries the arithmetic of a device.
///
/// # Errors
/// The device's.
pub fn arithmetic(gpu: &Gpu) -> Result<Arithmetic, Error> {
    let module = module()?;
    let mut evaluator = GpuEvaluator::new(gpu, &module)?;
    let rows = pairs();
    let mut results = Vec::new();
    evaluator.eval(Surroundings::default(), ROWS, &rows, &mut results)?;
    Ok(judge(&rows, &results))
}

fn module() -> Result<EvalModule, Error> {
    let broken = |reason: String| Error::Invalid {
        reason: format!("the probe is not a valid shader: {reason}"),
    };
    let module = naga::front::wgsl::parse_str(include_str!("probe.wgsl"))
        .map_err(|error| broken(error.to_string()))?;
    let info = Validator::new(ValidationFlags::all(), Capabilities::default())
        .validate(&module)
        .map_err(|error| broken(error.to_string()))?;
    Ok(EvalModule {
        module,
        info,
        inputs: vec!["a".into(), "b".into()],
        outputs: vec![String::new(); RESULTS],
        format: Format::Single,
    })
}

/// Positive numbers of about the same size, with all their bits in use: everything exact about them fits an `f64`.
fn pairs() -> Vec<f32> {
    let mut state = 0x9e37_79b9_u32;
    let mut next = || {
        // Xorshift (G. Marsaglia, "Xorshift RNGs", 2003).
        state ^= state << 13;
        state ^= state >> 17;
        state ^= state << 5;
        state
    };
    (0..2 * ROWS)
        .map(|_| {
            let significand = next() >> 9;
            let exponent = 127 - 4 + (next() >> 29);
            f32::from_bits(exponent << 23 | significand)
        })
        .collect()
}

fn judge(rows: &[f32], results: &[f32]) -> Arithmetic {
    let mut wrong = [0usize; 4];
    let (mut division_ulp, mut sqrt_ulp) = (0.0f64, 0.0f64);
    let mut kept = [true; 3];
    let (pairs, _) = rows.as_chunks::<2>();
    let (results, _) = results.as_chunks::<RESULTS>();
    for (&[a, b], result) in pairs.iter().zip(results) {
        let (a, b) = (f64::from(a), f64::from(b));
        let exact = [a + b, a + b, a * b, a * b];
        for (k, exact) in exact.into_iter().enumerate() {
            let (high, low) = (result[2 * k], result[2 * k + 1]);
            // Both halves together, and the upper one the rounded result.
            let right = f64::from(high) + f64::from(low) == exact && high == exact as f32;
            wrong[k] += usize::from(!right);
        }
        division_ulp = division_ulp.max(ulps(result[8], a / b));
        sqrt_ulp = sqrt_ulp.max(ulps(result[9], a.sqrt()));
        for (kept, &flag) in kept.iter_mut().zip(&result[10..]) {
            *kept &= flag == 1.0;
        }
    }
    let share = |count: usize| count as f64 / ROWS as f64;
    let [subnormals, nan, infinity] = kept;
    Arithmetic {
        two_sum: share(wrong[0]),
        two_sum_opaque: share(wrong[1]),
        two_prod_fma: share(wrong[2]),
        two_prod_split: share(wrong[3]),
        division_ulp,
        sqrt_ulp,
        subnormals,
        nan,
        infinity,
    }
}

/// Distance of a result from the exact value, in units in the last place of that value; for normal values.
fn ulps(result: f32, exact: f64) -> f64 {
    let exponent = (exact.to_bits() >> 52 & 0x7ff) as i32 - 1023;
    (f64::from(result) - exact).abs() / 2f64.powi(exponent - 23)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::AdapterChoice;

    #[test]
    fn the_shader_is_valid() {
        assert!(module().is_ok());
    }

    #[test]
    fn exact_arithmetic_is_found_exact() {
        let rows = pairs();
        let mut results = Vec::new();
        for &[a, b] in rows.as_chunks::<2>().0 {
            let (s, p) = (a + b, a * b);
            let e = (f64::from(a) + f64::from(b) - f64::from(s)) as f32;
            let f = (f64::from(a) * f64::from(b) - f64::from(p)) as f32;
            results.extend([s, e, s, e, p, f, p, f, a / b, a.sqrt(), 1.0, 1.0, 1.0]);
        }
        let found = judge(&rows, &results);
        let shares = [
            found.two_sum,
            found.two_sum_opaque,
            found.two_prod_fma,
            found.two_prod_split,
        ];
        assert_eq!(shares, [0.0; 4]);
        assert!(found.division_ulp <= 0.5 && found.sqrt_ulp <= 0.5);
        assert!(found.subnormals && found.nan && found.infinity);
        results[1] += 1.0;
        assert!(judge(&rows, &results).two_sum > 0.0);
    }

    #[test]
    fn sums_with_hidden_steps_are_exact_in_software() {
        let Ok(gpu) = Gpu::open(&AdapterChoice::Software) else {
            return;
        };
        assert_eq!(arithmetic(&gpu).unwrap().two_sum_opaque, 0.0);
    }
}
