// Where the adapter's `fma` is a product and a sum, each rounded.

/// a b + c, right to half a unit and a 2^-22nd of one; where that is no number, as `fma` has it.
fn real_mul_add(a: f32, b: f32, c: f32) -> f32 {
    let zero = hidden_zero_of(a, b);
    let product = two_product(a, b, zero);
    let sum = two_sum(product.x, opaque(c, zero), zero);
    let found = sum.x + (sum.y + product.y);
    return select(product.x + c, found, is_finite(found));
}
