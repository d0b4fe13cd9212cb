//! Programs with loops, with their values computed in another way: closed forms, or plain loops of Rust.

/// A program, points, and what it gives there.
#[derive(Clone, Copy)]
pub struct Looping {
    /// What is tried.
    pub name: &'static str,
    /// The program; what is asked for is its picture's formula.
    pub text: &'static str,
    /// Arguments, exact in single precision.
    pub points: &'static [&'static [f64]],
    /// Values of the parameters.
    pub params: &'static [f64],
    /// The value at the arguments with the parameters.
    pub want: fn(&[f64], &[f64]) -> Vec<f64>,
}

const PLANE: &[&[f64]] = &[
    &[0.5, 2.0],
    &[-0.75, 1.25],
    &[1.5, -0.5],
    &[0.0, 0.0],
    &[2.25, 3.5],
];
const COMPLEX: &[&[f64]] = &[
    &[0.25, 0.5],
    &[-0.75, 0.125],
    &[-1.0, 0.0],
    &[0.375, -0.25],
    &[1.5, 0.5],
    &[0.3125, 0.03125],
];

/// The product of complex numbers.
fn times(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

/// The orbit of 0 under w² + c, until |w| > 2 or the steps are done: the last point and the number of steps.
fn orbit(c: [f64; 2], steps: usize) -> ([f64; 2], usize) {
    let mut w = [0.0_f64, 0.0];
    for done in 0..steps {
        if w[0].hypot(w[1]) > 2.0 {
            return (w, done);
        }
        let square = times(w, w);
        w = [square[0] + c[0], square[1] + c[1]];
    }
    (w, steps)
}

/// Steps of the Collatz map from n to 1.
fn collatz(mut n: u64) -> f64 {
    let mut steps = 0.0;
    while n != 1 {
        n = if n.is_multiple_of(2) {
            n / 2
        } else {
            3 * n + 1
        };
        steps += 1.0;
    }
    steps
}

/// Programs whose values are known.
pub const LOOPS: &[Looping] = &[
    Looping {
        name: "geometric sum",
        text: "f(x, y) = sum(k in 0..20, x^k) + y",
        points: PLANE,
        params: &[],
        want: |a, _| vec![(a[0].powi(21) - 1.0) / (a[0] - 1.0) + a[1]],
    },
    Looping {
        name: "geometric sum by Horner's scheme",
        text: "f(x, y) = iterate(12, p = 0, p x + 1) - y",
        points: PLANE,
        params: &[],
        want: |a, _| vec![(a[0].powi(12) - 1.0) / (a[0] - 1.0) - a[1]],
    },
    Looping {
        name: "exponential series by Horner's scheme with two states",
        text: "f(x, y) = r.p + 0 y where r = iterate(25, k = 25, p = 1, k - 1, 1 + x p / k)",
        points: PLANE,
        params: &[],
        want: |a, _| vec![a[0].exp()],
    },
    Looping {
        name: "Wallis product",
        text: "f(x, y) = product(k in 1..200, (2k)^2 / ((2k - 1)(2k + 1)) + 0 x) + y",
        points: PLANE,
        params: &[],
        want: |a, _| {
            let wallis: f64 = (1..=200)
                .map(|k| f64::from(4 * k * k) / f64::from(4 * k * k - 1))
                .product();
            vec![wallis + a[1]]
        },
    },
    Looping {
        name: "Mandelbrot orbit",
        text: "f(z) = iterate(12, w = 0, w^2 + z until |w| > 2)",
        points: COMPLEX,
        params: &[],
        want: |a, _| orbit([a[0], a[1]], 12).0.to_vec(),
    },
    Looping {
        name: "Mandelbrot count",
        text: "f(z) = iterate(60, w = 0, w^2 + z, until |w| > 2).count",
        points: COMPLEX,
        params: &[],
        want: |a, _| vec![orbit([a[0], a[1]], 60).1 as f64],
    },
    Looping {
        name: "distance to the Mandelbrot set, its derivative carried along",
        text: "f(z) = |r.w| log(|r.w|) / |r.d| + 0 r.count where r = iterate(6, w = 0, d = 0, (w^2 + z, 2 w d + 1))",
        points: &[&[1.5, 0.5], &[-2.5, 0.75]],
        params: &[],
        want: |a, _| {
            let (mut w, mut d) = ([0.0_f64, 0.0], [0.0, 0.0]);
            for _ in 0..6 {
                d = times([2.0 * w[0], 2.0 * w[1]], d);
                d[0] += 1.0;
                w = times(w, w);
                w = [w[0] + a[0], w[1] + a[1]];
            }
            let size = w[0].hypot(w[1]);
            vec![size * size.ln() / d[0].hypot(d[1])]
        },
    },
    Looping {
        name: "Collatz steps",
        text: "f(x, y) = iterate(1000, n = x, if mod(n, 2) == 0 then n/2 else 3 n + 1 until n == 1).count + y",
        points: &[
            &[1.0, 0.0],
            &[2.0, 0.0],
            &[7.0, 0.0],
            &[27.0, 0.0],
            &[97.0, 1.0],
        ],
        params: &[],
        want: |a, _| vec![collatz(a[0] as u64) + a[1]],
    },
    Looping {
        name: "nested sums",
        text: "f(x, y) = sum(j in 0..5, k in 0..j, x^j y^k)",
        points: PLANE,
        params: &[],
        want: |a, _| {
            let term = |j: i32, k: i32| a[0].powi(j) * a[1].powi(k);
            vec![(0..=5).flat_map(|j| (0..=j).map(move |k| term(j, k))).sum()]
        },
    },
    Looping {
        name: "a product within a sum: the exponential series",
        text: "f(x, y) = sum(n in 0..20, product(k in 1..n, x / k)) + 0 y",
        points: PLANE,
        params: &[],
        want: |a, _| vec![a[0].exp()],
    },
    Looping {
        name: "sum of vectors",
        text: "f(x, y) = dot(v, (1, 100, 10000)) where v = sum(k in 1..4, (x k, y k^2, k^3))",
        points: PLANE,
        params: &[],
        want: |a, _| vec![10.0 * a[0] + 3000.0 * a[1] + 1_000_000.0],
    },
    Looping {
        name: "folded vector",
        text: "f(x, y) = p.x + 10 p.y + 100 p.z
            where p = iterate(3, p = (x, y, 1), 2 q - 1 where q = abs(p), q.xy = (q.y, q.x + 1))",
        points: PLANE,
        params: &[],
        want: |a, _| {
            let mut p = [a[0], a[1], 1.0];
            for _ in 0..3 {
                let q = p.map(f64::abs);
                p = [2.0 * q[1] - 1.0, 2.0 * (q[0] + 1.0) - 1.0, 2.0 * q[2] - 1.0];
            }
            vec![p[0] + 10.0 * p[1] + 100.0 * p[2]]
        },
    },
    Looping {
        name: "turned vector",
        text: "f(x, y) = v.y where v = iterate(8, v = (x, y), rotate(v, π/4))",
        points: PLANE,
        params: &[],
        want: |a, _| vec![a[1]],
    },
    Looping {
        name: "parameter as number of terms",
        text: "param n = 3 in 1..20\nf(x, y) = sum(k in 1..n, k x) + y",
        points: PLANE,
        params: &[7.0],
        want: |a, _| vec![28.0 * a[0] + a[1]],
    },
    Looping {
        name: "parameter as number of steps, rounded down",
        text: "param n = 3 in 0..20\nf(x, y) = iterate(n, w = x, w + y)",
        points: PLANE,
        params: &[5.75],
        want: |a, _| vec![a[0] + 5.0 * a[1]],
    },
    Looping {
        name: "parameter below 1",
        text: "param n = 3 in -5..20\nf(x, y) = iterate(n, w = x, w + y) + sum(k in 1..n, x) + product(k in 1..n, x)",
        points: PLANE,
        params: &[-2.0],
        want: |a, _| vec![a[0] + 1.0],
    },
    Looping {
        name: "multiple of a parameter as number of terms",
        text: "param t = 0.1 in 0..0.29\nf(x, y) = sum(k in 1..100 t, x) + y",
        points: PLANE,
        params: &[0.25],
        want: |a, _| vec![25.0 * a[0] + a[1]],
    },
    Looping {
        name: "parameter above its range",
        text: "param n = 3 in 1..20\nf(x, y) = sum(k in 1..n, x) + y",
        points: PLANE,
        params: &[21.0],
        want: |_, _| vec![f64::NAN],
    },
    Looping {
        name: "parameter that is NaN",
        text: "param n = 3 in 1..20\nf(x, y) = iterate(n, w = x, w + y)",
        points: PLANE,
        params: &[f64::NAN],
        want: |_, _| vec![f64::NAN],
    },
    Looping {
        name: "every component of what is not known is NaN",
        text: "param n = 3 in 1..20\nf(z) = iterate(n, w = z, 2 w)",
        points: COMPLEX,
        params: &[1000.0],
        want: |_, _| vec![f64::NAN, f64::NAN],
    },
    Looping {
        name: "count of a loop above its maximum",
        text: "param n = 3 in 1..20\nf(x, y) = iterate(n, w = x, w + y).count",
        points: PLANE,
        params: &[22.5],
        want: |_, _| vec![f64::NAN],
    },
    Looping {
        name: "stated maximum of an input",
        text: "f(x, y) = sum(k in 1..min(|x|, 10), k) + iterate(clamp(y, 0, 3), w = 0, w + 1)",
        points: PLANE,
        params: &[],
        want: |a, _| {
            let n = a[0].abs().min(10.0).floor();
            vec![n * (n + 1.0) / 2.0 + a[1].clamp(0.0, 3.0).floor()]
        },
    },
    Looping {
        name: "empty ranges",
        text: "f(x, y) = sum(k in 3..2, x) + 10 product(k in 3..2, x) + |sum(k in 1..0, (x, y))|",
        points: PLANE,
        params: &[],
        want: |_, _| vec![10.0],
    },
    Looping {
        name: "negative range",
        text: "f(x, y) = sum(k in -3..2, (k + 0.5) x) + sum(k in -3..3, k^2 y)",
        points: PLANE,
        params: &[],
        want: |a, _| vec![28.0 * a[1] + 0.0 * a[0]],
    },
    Looping {
        name: "range of fractions",
        text: "f(x, y) = sum(k in 0.5..3.25, k x) + y",
        points: PLANE,
        params: &[],
        want: |a, _| vec![4.5 * a[0] + a[1]],
    },
    Looping {
        name: "range about an input",
        text: "f(x, y) = sum(j in floor(x) - 1..floor(x) + 1, k in y..y + 2, (x - j)^2 + k)",
        points: PLANE,
        params: &[],
        want: |a, _| {
            let mut sum = 0.0;
            for j in [-1.0, 0.0, 1.0] {
                for k in [0.0, 1.0, 2.0] {
                    sum += (a[0] - (a[0].floor() + j)).powi(2) + (a[1] + k);
                }
            }
            vec![sum]
        },
    },
    Looping {
        name: "sum and product of complex terms",
        text: "f(z) = sum(k in 0..8, z^k) product(k in 1..3, z - k i)",
        points: COMPLEX,
        params: &[],
        want: |a, _| {
            let z = [a[0], a[1]];
            let (mut sum, mut power, mut product) = ([0.0, 0.0], [1.0, 0.0], [1.0, 0.0]);
            for _ in 0..=8 {
                sum = [sum[0] + power[0], sum[1] + power[1]];
                power = times(power, z);
            }
            for k in [1.0, 2.0, 3.0] {
                product = times(product, [z[0], z[1] - k]);
            }
            times(sum, product).to_vec()
        },
    },
    Looping {
        name: "real states that become complex one after the other",
        text: "f(z) = r.a + 0 r.c where r = iterate(5, a = 1, b = 2, c = 3, (b + 1, c, c + z))",
        points: COMPLEX,
        params: &[],
        want: |a, _| vec![4.0 + 3.0 * a[0], 3.0 * a[1]],
    },
    Looping {
        name: "Heron's square root",
        text: "root(a) = iterate(40, s = a, (s + a/s)/2 until |s^2 - a| <= 1e-5 a)
            f(x, y) = root(x^2 + y^2 + 1)",
        points: PLANE,
        params: &[],
        want: |a, _| {
            let a = a[0] * a[0] + a[1] * a[1] + 1.0;
            let mut s = a;
            while (s * s - a).abs() > 1e-5 * a {
                s = (s + a / s) / 2.0;
            }
            vec![s]
        },
    },
    Looping {
        name: "a function that gives a record, and one that takes it",
        text: "whole(r) = r.count + r.rest / 16
            f(x, y) = whole(division(4 + |x|, 0.5))
            division(a, b) = iterate(1000, rest = a, rest - b until rest < b)
            show levels(f)",
        points: PLANE,
        params: &[],
        want: |a, _| {
            let a = 4.0 + a[0].abs();
            vec![(a / 0.5).floor() + (a % 0.5) / 16.0]
        },
    },
    Looping {
        name: "running variables and states hide outer names",
        text: "k = 100\nf(x, y) = sum(k in 1..3, k + sum(k in 1..2, k)) + k + iterate(2, x = x + 1, 2 x) + x + y",
        points: PLANE,
        params: &[],
        want: |a, _| vec![15.0 + 100.0 + 4.0 * (a[0] + 1.0) + a[0] + a[1]],
    },
    Looping {
        name: "constants of loops",
        text: "basel = sum(k in 1..1000, 1/k^2)
            fib = iterate(30, a = 0, b = 1, (b, a + b))
            f(x, y) = basel x + fib.a y + iterate(5, w = 1, 2 w).count",
        points: PLANE,
        params: &[],
        want: |a, _| {
            let basel: f64 = (1..=1000).map(|k| 1.0 / f64::from(k * k)).sum();
            vec![basel * a[0] + 832_040.0 * a[1] + 5.0]
        },
    },
    Looping {
        name: "steps of one state hold the values before the step of all",
        text: "f(x, y) = r.a - r.b where r = iterate(7, a = x, b = y, (b, a))",
        points: PLANE,
        params: &[],
        want: |a, _| vec![a[1] - a[0]],
    },
    Looping {
        name: "a loop that ends before its first step",
        text: "f(x, y) = r.w + 10 r.count where r = iterate(50, w = x, w + y, until w < 100)",
        points: PLANE,
        params: &[],
        want: |a, _| vec![a[0]],
    },
    Looping {
        name: "a state called count",
        text: "f(x, y) = iterate(4, count = x, count + y).count",
        points: PLANE,
        params: &[],
        want: |a, _| vec![a[0] + 4.0 * a[1]],
    },
];
