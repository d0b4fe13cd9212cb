//! Zeros, subnormal numbers, infinities and NaN: operations whose results IEEE 754 fixes.

use super::arithmetic::Slot;
use super::format::Format;
use crate::capabilities::Special;

/// What must come out.
enum Right<F> {
    /// This number, to the bit.
    Bits(F),
    /// A NaN, with any bits.
    Nan,
    /// These comparisons true, of those in the mask.
    Seen { mask: u32, truth: u32 },
}

/// What goes wrong is filed under this.
#[derive(Clone, Copy)]
enum Under {
    SubnormalResults,
    SubnormalArguments,
    Zeros,
    Infinities,
    Nans,
}

struct Case<F> {
    under: Under,
    name: &'static str,
    row: [F; 2],
    slot: Slot,
    right: Right<F>,
}

fn cases<F: Format>() -> Vec<Case<F>> {
    use Slot::*;
    use Under::*;
    let n = F::of;
    let (zero, one, inf, nan, min, max) =
        (n(0.0), n(1.0), F::INFINITY, F::NAN, F::LEAST, F::LARGEST);
    let sub = min * n(0.25);
    let bits = |x| Right::Bits(x);
    let seen = |mask, truth| Right::Seen { mask, truth };
    let case = |under, name, row, slot, right| Case {
        under,
        name,
        row,
        slot,
        right,
    };
    vec![
        case(
            SubnormalResults,
            "least * 0.5",
            [min, n(0.5)],
            Product,
            bits(min * n(0.5)),
        ),
        case(
            SubnormalResults,
            "least / 4",
            [min, n(4.0)],
            Quotient,
            bits(sub),
        ),
        case(
            SubnormalResults,
            "least - 1.5 least",
            [min, min * n(1.5)],
            Difference,
            bits(-(min * n(0.5))),
        ),
        case(
            SubnormalResults,
            "1 / largest",
            [max, one],
            Inverse,
            bits(one / max),
        ),
        case(
            SubnormalArguments,
            "subnormal * 4",
            [sub, n(4.0)],
            Product,
            bits(min),
        ),
        case(
            SubnormalArguments,
            "subnormal + least",
            [sub, min],
            Sum,
            bits(sub + min),
        ),
        case(
            SubnormalArguments,
            "subnormal / itself",
            [sub, sub],
            Quotient,
            bits(one),
        ),
        case(
            SubnormalArguments,
            "root of a subnormal",
            [sub, one],
            Root,
            bits(sub.root()),
        ),
        case(
            SubnormalArguments,
            "subnormal == 0",
            [sub, zero],
            Seen,
            seen(4, 0),
        ),
        case(
            SubnormalArguments,
            "subnormal > 0",
            [zero, sub],
            Seen,
            seen(1, 1),
        ),
        case(Zeros, "-0 + -0", [-zero, -zero], Sum, bits(-zero)),
        case(Zeros, "-0 + 0", [-zero, zero], Sum, bits(zero)),
        case(Zeros, "-0 + literal 0", [-zero, one], PlusZero, bits(zero)),
        case(Zeros, "0 - 0", [zero, zero], ZeroMinus, bits(zero)),
        case(Zeros, "-(0)", [zero, one], Negated, bits(-zero)),
        case(Zeros, "1 * -0", [one, -zero], Product, bits(-zero)),
        case(Zeros, "-1 * literal 0", [-one, one], TimesZero, bits(-zero)),
        case(Zeros, "0 / -1", [zero, -one], Quotient, bits(-zero)),
        case(Zeros, "x - x", [one, one], MinusItself, bits(zero)),
        case(Zeros, "root of -0", [-zero, one], Root, bits(-zero)),
        case(Zeros, "|-0|", [-zero, one], Absolute, bits(zero)),
        case(Zeros, "-0 == 0", [-zero, zero], Seen, seen(4, 4)),
        case(Infinities, "1 / 0", [zero, one], Inverse, bits(inf)),
        case(Infinities, "1 / -0", [-zero, one], Inverse, bits(-inf)),
        case(Infinities, "-1 / 0", [-one, zero], Quotient, bits(-inf)),
        case(Infinities, "largest * 2", [max, n(2.0)], Product, bits(inf)),
        case(Infinities, "largest + largest", [max, max], Sum, bits(inf)),
        case(Infinities, "inf + 1", [inf, one], Sum, bits(inf)),
        case(Infinities, "1 - inf", [one, inf], Difference, bits(-inf)),
        case(Infinities, "inf * -1", [inf, -one], Product, bits(-inf)),
        case(Infinities, "1 / -inf", [-inf, one], Inverse, bits(-zero)),
        case(Infinities, "root of inf", [inf, one], Root, bits(inf)),
        case(Infinities, "inf > largest", [inf, one], Seen, seen(64, 64)),
        case(Infinities, "inf == inf", [inf, inf], Seen, seen(4, 4)),
        case(Nans, "0 / 0", [zero, zero], Quotient, Right::Nan),
        case(Nans, "inf - inf", [inf, inf], Difference, Right::Nan),
        case(Nans, "x - x at inf", [inf, one], MinusItself, Right::Nan),
        case(Nans, "x - x at NaN", [nan, one], MinusItself, Right::Nan),
        case(Nans, "0 * inf", [zero, inf], Product, Right::Nan),
        case(Nans, "inf * literal 0", [inf, one], TimesZero, Right::Nan),
        case(Nans, "NaN * literal 0", [nan, one], TimesZero, Right::Nan),
        case(Nans, "NaN + literal 0", [nan, one], PlusZero, Right::Nan),
        case(Nans, "NaN + 1", [nan, one], Sum, Right::Nan),
        case(Nans, "1 / NaN", [nan, one], Inverse, Right::Nan),
        case(Nans, "root of -1", [-one, one], Root, Right::Nan),
        case(Nans, "|NaN|", [nan, one], Absolute, Right::Nan),
        case(Nans, "NaN < 1", [nan, one], Seen, seen(1, 0)),
        case(Nans, "NaN <= 1", [nan, one], Seen, seen(2, 0)),
        case(Nans, "NaN == 1", [nan, one], Seen, seen(4, 0)),
        case(Nans, "NaN != 1", [nan, one], Seen, seen(8, 8)),
        case(Nans, "not NaN < 1", [nan, one], Seen, seen(16, 16)),
        case(Nans, "x == x at NaN", [nan, one], Seen, seen(32, 0)),
        case(Nans, "NaN > largest", [nan, one], Seen, seen(64, 0)),
    ]
}

/// The rows of the cases.
pub(super) fn rows<F: Format>() -> Vec<[F; 2]> {
    cases().iter().map(|case| case.row).collect()
}

/// Which cases go wrong; `result` gives the words of a row's slot.
pub(super) fn judge<'a, F: Format>(result: impl Fn(usize, Slot) -> &'a [u32]) -> Special {
    let mut found = Special::default();
    for (row, case) in cases::<F>().into_iter().enumerate() {
        let words = result(row, case.slot);
        let number = F::from_words(words);
        let right = match case.right {
            Right::Bits(expected) => number.bits() == expected.bits(),
            Right::Nan => number.is_nan(),
            Right::Seen { mask, truth } => words[0] & mask == truth,
        };
        if right {
            continue;
        }
        let list = match case.under {
            Under::SubnormalResults => &mut found.subnormal_results,
            Under::SubnormalArguments => &mut found.subnormal_arguments,
            Under::Zeros => &mut found.zeros,
            Under::Infinities => &mut found.infinities,
            Under::Nans => &mut found.nans,
        };
        list.push(case.name.to_owned());
    }
    found
}
