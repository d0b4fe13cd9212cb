//! Which forms of the exact steps are exact.

use pullback_compiler::lower::Exactness;

use super::rows::pairs;
use crate::capabilities::Form;
use crate::kernel::{Contraction, Kernel};
use crate::{Error, Gpu};

/// Rows of numbers.
const ROWS: usize = 2000;
/// Pairs of results, as `steps.wgsl` writes them.
const RESULTS: usize = 5;

/// Tries the very texts that the wide tiers compute with.
pub(super) fn try_out(gpu: &Gpu, decorations: bool) -> Result<Vec<Form>, Error> {
    let rows = pairs::<f32>(ROWS);
    let mut forms = Vec::new();
    for exactness in Exactness::ALL {
        if exactness.is_decorated() && !decorations {
            continue;
        }
        match wrong(gpu, exactness, &rows) {
            Ok(wrong) => forms.push(Form::new(exactness, wrong)),
            Err(_) if exactness.is_decorated() => {}
            Err(error) => return Err(error),
        }
    }
    Ok(forms)
}

/// The share of rows with a wrong result.
fn wrong(gpu: &Gpu, exactness: Exactness, rows: &[[f32; 2]]) -> Result<f64, Error> {
    let contraction = if exactness.is_decorated() {
        Contraction::Forbidden
    } else {
        Contraction::Allowed
    };
    let text = format!("{}{}", exactness.wgsl(), include_str!("steps.wgsl"));
    let kernel = Kernel::new(gpu, &text, contraction)?;
    let words: Vec<u32> = rows.iter().flatten().map(|x| x.to_bits()).collect();
    let results = kernel.run(rows.len() as u32, &words, rows.len() * 2 * RESULTS)?;
    let results = results.as_chunks::<{ 2 * RESULTS }>().0;
    let wrong = rows.iter().zip(results).filter(|&(&row, found)| {
        let found = found.map(f32::from_bits);
        expected(row).as_flattened() != found
    });
    Ok(wrong.count() as f64 / rows.len() as f64)
}

/// The results of a row by the book.
fn expected([a, b]: [f32; 2]) -> [[f32; 2]; RESULTS] {
    let sum = two_sum(a, b);
    let product = two_product(a, b);
    let small = product[1] * 2f32.powi(-12);
    [
        sum,
        product,
        two_sum(a * b, b),
        two_sum(sum[1], product[1]),
        two_sum(sum[0], small),
    ]
}

fn two_sum(a: f32, b: f32) -> [f32; 2] {
    let s = a + b;
    let t = s - a;
    [s, (a - (s - t)) + (b - t)]
}

fn two_product(a: f32, b: f32) -> [f32; 2] {
    [a * b, a.mul_add(b, -(a * b))]
}
