//! What an adapter does to the arithmetic of a format.

use super::format::Format;
use super::rows::{pairs, ulp};
use super::special;
use crate::capabilities::{Arithmetic, Rounding};
use crate::kernel::{Contraction, Kernel};
use crate::{Error, Gpu};

/// Rows of numbers.
const ROWS: usize = 2000;
/// Results of a row, as `arithmetic.wgsl` writes them.
const SLOTS: usize = 22;
/// An error that is not a number of ulps: a NaN, or an infinity where none belongs.
const HOPELESS: f64 = 1e30;

/// Places of the results of a row.
#[derive(Clone, Copy)]
pub(super) enum Slot {
    TwoSum = 0,
    TwoSumHidden = 2,
    TwoProductFma = 4,
    TwoProductHalves = 6,
    Sum = 8,
    Difference = 9,
    Product = 10,
    Quotient = 11,
    Root = 12,
    Contracted = 13,
    PlusZero = 14,
    TimesZero = 15,
    MinusItself = 16,
    ZeroMinus = 17,
    Negated = 18,
    Absolute = 19,
    Inverse = 20,
    Seen = 21,
}

/// Tries a format.
pub(super) fn try_out<F: Format>(gpu: &Gpu, contraction: Contraction) -> Result<Arithmetic, Error> {
    let text = format!("{}{}", F::WGSL, include_str!("arithmetic.wgsl"));
    let kernel = Kernel::new(gpu, &text, contraction)?;
    let rows = all_rows::<F>();
    let mut words = Vec::with_capacity(2 * rows.len() * F::WORDS);
    rows.iter().flatten().for_each(|x| x.push_words(&mut words));
    let results = kernel.run(rows.len() as u32, &words, rows.len() * SLOTS * F::WORDS)?;
    Ok(judge::<F>(&rows, &results))
}

/// Ordinary rows, then the special cases.
fn all_rows<F: Format>() -> Vec<[F; 2]> {
    let mut rows = pairs::<F>(ROWS);
    rows.extend(special::rows::<F>());
    rows
}

fn judge<F: Format>(rows: &[[F; 2]], results: &[u32]) -> Arithmetic {
    let words = |row: usize, slot: usize| {
        let first = (row * SLOTS + slot) * F::WORDS;
        &results[first..first + F::WORDS]
    };
    let mut wrong = [0usize; 5];
    let mut worst = [0f64; 5];
    for (row, &[a, b]) in rows[..ROWS].iter().enumerate() {
        let result = |slot: usize| F::from_words(words(row, slot));
        let pair = |slot: Slot| [result(slot as usize), result(slot as usize + 1)];
        let sum = exact_sum(a, b);
        let product = [a * b, a.fma(b, -(a * b))];
        // The halves of an f64 have 26 and 27 bits, so their least product is rounded.
        let slack = if F::WORDS == 2 {
            ulp(product[0]).to_f64() * f64::EPSILON
        } else {
            0.0
        };
        let checks = [
            same(pair(Slot::TwoSum), sum, 0.0),
            same(pair(Slot::TwoSumHidden), sum, 0.0),
            same(pair(Slot::TwoProductFma), product, 0.0),
            same(pair(Slot::TwoProductHalves), product, slack),
            result(Slot::Contracted as usize) == F::of(0.0),
        ];
        for (count, right) in wrong.iter_mut().zip(checks) {
            *count += usize::from(!right);
        }
        let errors = [
            sum_error(a, b, result(Slot::Sum as usize)),
            sum_error(a, -b, result(Slot::Difference as usize)),
            product_error(a, b, result(Slot::Product as usize)),
            quotient_error(a, b, result(Slot::Quotient as usize)),
            root_error(a, result(Slot::Root as usize)),
        ];
        for (worst, error) in worst.iter_mut().zip(errors) {
            *worst = worst.max(if error.is_finite() {
                error.abs()
            } else {
                HOPELESS
            });
        }
    }
    let [sum, difference, product, quotient, root] = worst;
    let [
        two_sum,
        two_sum_hidden,
        two_product_fma,
        two_product_halves,
        contracted,
    ] = wrong.map(|count| count as f64 / ROWS as f64);
    Arithmetic {
        two_sum,
        two_sum_hidden,
        two_product_fma,
        two_product_halves,
        contracted,
        rounding: Rounding {
            sum,
            difference,
            product,
            quotient,
            root,
        },
        special: special::judge::<F>(|row, slot| words(ROWS + row, slot as usize)),
    }
}

/// Rounded sum and its error (Knuth).
fn exact_sum<F: Format>(a: F, b: F) -> [F; 2] {
    let s = a + b;
    let t = s - a;
    [s, (a - (s - t)) + (b - t)]
}

fn same<F: Format>([high, low]: [F; 2], right: [F; 2], slack: f64) -> bool {
    // Numbers compare equal whatever the sign of a zero.
    high == right[0] && (low.to_f64() - right[1].to_f64()).abs() <= slack
}

// Distances from the exact result in ulps of the rounded one. A difference from the rounded result is exact unless the
// result is hopeless.

fn sum_error<F: Format>(a: F, b: F, found: F) -> f64 {
    let [s, e] = exact_sum(a, b);
    if s == F::of(0.0) {
        return if found == s { 0.0 } else { HOPELESS };
    }
    ((found - s).to_f64() - e.to_f64()) / ulp(s).to_f64()
}

fn product_error<F: Format>(a: F, b: F, found: F) -> f64 {
    let p = a * b;
    ((found - p).to_f64() - a.fma(b, -p).to_f64()) / ulp(p).to_f64()
}

fn quotient_error<F: Format>(a: F, b: F, found: F) -> f64 {
    // found - a / b = (found b - a) / b
    found.fma(b, -a).to_f64() / b.to_f64() / ulp(a / b).to_f64()
}

fn root_error<F: Format>(a: F, found: F) -> f64 {
    if a < F::of(0.0) {
        return if found.is_nan() { 0.0 } else { HOPELESS };
    }
    // found - √a = (found² - a) / (found + √a)
    let root = a.root();
    found.fma(found, -a).to_f64() / (found.to_f64() + root.to_f64()) / ulp(root).to_f64()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a machine that does everything by the book gives.
    fn ideal<F: Format>(rows: &[[F; 2]]) -> Vec<u32> {
        let mut results = Vec::new();
        for &[a, b] in rows {
            let [s, e] = exact_sum(a, b);
            let p = a * b;
            let f = a.fma(b, -p);
            let zero = F::of(0.0);
            let magnitude = if a.bits() >> (32 * F::WORDS - 1) == 1 {
                -a
            } else {
                a
            };
            #[allow(clippy::eq_op, reason = "what a driver makes of x - x is the question")]
            let numbers = [
                s,
                e,
                s,
                e,
                p,
                f,
                p,
                f,
                s,
                a - b,
                p,
                a / b,
                a.root(),
                zero,
                a + zero,
                a * zero,
                a - a,
                zero - a,
                -a,
                magnitude,
                F::of(1.0) / a,
            ];
            numbers.iter().for_each(|x| x.push_words(&mut results));
            #[allow(clippy::eq_op, clippy::neg_cmp_op_on_partial_ord)]
            let seen = [
                a < b,
                a <= b,
                a == b,
                a != b,
                !(a < b),
                a == a,
                a > F::LARGEST,
            ];
            results.push(
                seen.iter()
                    .rev()
                    .fold(0, |bits, &bit| bits << 1 | u32::from(bit)),
            );
            results.extend(vec![0; F::WORDS - 1]);
        }
        results
    }

    fn an_ideal_machine_passes<F: Format>() {
        let rows = all_rows::<F>();
        let mut results = ideal(&rows);
        let found = judge(&rows, &results);
        let shares = [
            found.two_sum,
            found.two_sum_hidden,
            found.two_product_fma,
            found.two_product_halves,
            found.contracted,
        ];
        assert_eq!(shares, [0.0; 5]);
        assert!(found.rounding.is_correct(), "{:?}", found.rounding);
        assert_eq!(found.special, crate::capabilities::Special::default());
        // One bit off in each result is seen.
        results
            .iter_mut()
            .step_by(F::WORDS)
            .for_each(|word| *word ^= 1);
        let found = judge(&rows, &results);
        assert!(found.two_sum > 0.99 && found.two_product_halves > 0.99);
        let r = found.rounding;
        let worst = [r.sum, r.difference, r.product, r.quotient, r.root];
        assert!(worst.iter().all(|&error| error > 0.9), "{worst:?}");
        assert!(!found.special.zeros.is_empty() && !found.special.infinities.is_empty());
    }

    #[test]
    fn a_machine_by_the_book_passes() {
        an_ideal_machine_passes::<f32>();
        an_ideal_machine_passes::<f64>();
    }

    #[test]
    fn a_result_that_is_no_number_is_hopeless() {
        let rows = all_rows::<f32>();
        let results = vec![f32::NAN.to_bits(); rows.len() * SLOTS];
        let found = judge(&rows, &results);
        assert_eq!(found.rounding.sum, HOPELESS);
        assert_eq!(found.two_sum, 1.0);
    }
}
