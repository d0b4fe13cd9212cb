//! An adaptive rule for integrals in f64, which knows nothing of closed forms.

/// How often a panel is halved.
const DEEPEST: u32 = 40;
/// How far apart the two rules, and a panel and its halves, may be, as a part of ∫ |f|; what is kept is closer.
const TOLERANCE: f64 = 1e-10;

/// How many panels are halved, beside one for each that is begun with.
const MOST: usize = 20_000;

/// An integral, and that of the absolute value.
#[derive(Clone, Copy, Debug)]
pub struct Exact {
    /// ∫ f
    pub value: f64,
    /// ∫ |f|
    pub size: f64,
}

/// Seven nodes of Kronrod's extension of the rule of Lobatto with four, as pairs around the middle, which is the first:
/// place, weight, and weight in the rule of Lobatto. Both ends are nodes: with inner nodes alone a jump near an end would
/// not be seen.
///
/// Gander and Gautschi, "Adaptive quadrature, revisited", BIT 40, 2000.
const NODES: [[f64; 3]; 4] = [
    [0.0, 672.0 / 1470.0, 0.0],
    [0.447_213_595_499_957_9, 625.0 / 1470.0, 5.0 / 6.0],
    [0.816_496_580_927_726, 432.0 / 1470.0, 0.0],
    [1.0, 77.0 / 1470.0, 1.0 / 6.0],
];

struct Panel {
    from: f64,
    to: f64,
    depth: u32,
    value: f64,
    size: f64,
    /// The two rules apart.
    apart: f64,
}

/// The integral of f over the panels between these places, in order, by the rules of Lobatto and Kronrod on panels that are
/// halved until both agree, and their halves with them. NaN where f is no number at one of the
/// first nodes, and where that takes too long, as beside a pole.
pub fn adaptive(places: &[f64], mut f: impl FnMut(f64) -> f64) -> Exact {
    let mut open: Vec<Panel> = places
        .windows(2)
        .map(|ends| panel(&mut f, ends[0], ends[1], 0))
        .collect();
    let size: f64 = open.iter().map(|panel| panel.size.abs()).sum();
    let none = Exact {
        value: f64::NAN,
        size,
    };
    if !size.is_finite() {
        return none;
    }
    let mut left = MOST + open.len();
    let mut total = Exact {
        value: 0.0,
        size: 0.0,
    };
    while let Some(one) = open.pop() {
        let middle = 0.5 * (one.from + one.to);
        let halves = [
            panel(&mut f, one.from, middle, one.depth + 1),
            panel(&mut f, middle, one.to, one.depth + 1),
        ];
        let value = halves[0].value + halves[1].value;
        // beside a kink two rules may agree by chance, where the halves do not
        let apart = one.apart.max((one.value - value).abs());
        let is_near = apart <= TOLERANCE * size;
        if is_near || one.depth == DEEPEST || apart.is_nan() {
            total.value += value;
            total.size += halves[0].size + halves[1].size;
        } else {
            let Some(fewer) = left.checked_sub(1) else {
                return none;
            };
            left = fewer;
            open.extend(halves);
        }
    }
    total
}

fn panel(f: &mut impl FnMut(f64) -> f64, from: f64, to: f64, depth: u32) -> Panel {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    let (mut value, mut size, mut coarse) = (0.0, 0.0, 0.0);
    for (k, [place, fine, lobatto]) in NODES.into_iter().enumerate() {
        for side in if k == 0 { &[1.0][..] } else { &[-1.0, 1.0] } {
            let f = f(middle + side * half * place);
            value += fine * f;
            size += fine * f.abs();
            coarse += lobatto * f;
        }
    }
    Panel {
        from,
        to,
        depth,
        value: half * value,
        size: half * size,
        apart: half * (value - coarse).abs(),
    }
}
