//! Random formulas, the same in every run.

#![allow(dead_code, reason = "each suite uses some of it")]

use proptest::prelude::*;
use proptest::strategy::ValueTree as _;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

/// So many values, the same in every run.
pub fn samples<S: Strategy>(count: usize, strategy: &S) -> Vec<S::Value> {
    let mut runner = TestRunner::new_with_rng(
        Config::default(),
        TestRng::deterministic_rng(RngAlgorithm::ChaCha),
    );
    (0..count)
        .map(|_| strategy.new_tree(&mut runner).expect("a formula").current())
        .collect()
}

/// Real formulas in x and y without kinks or poles, of moderate size.
pub fn smooth() -> BoxedStrategy<String> {
    let leaf = prop_oneof![
        3 => Just("x".to_owned()),
        3 => Just("y".to_owned()),
        2 => (1_u32..40).prop_map(|k| format!("{:?}", f64::from(k) / 8.0)),
        1 => Just("π".to_owned()),
    ];
    leaf.prop_recursive(5, 24, 3, |inner| {
        let two = (inner.clone(), inner.clone());
        prop_oneof![
            two.clone().prop_map(|(a, b)| format!("({a} + {b})")),
            two.clone().prop_map(|(a, b)| format!("({a} - {b})")),
            two.clone().prop_map(|(a, b)| format!("({a}) ({b})")),
            two.clone().prop_map(|(a, b)| format!("({a})/(2 + ({b})²)")),
            two.clone()
                .prop_map(|(a, b)| format!("(2 + sin({a}))^cos({b})")),
            two.clone()
                .prop_map(|(a, b)| format!("hypot({a}, 1 + ({b})^2)")),
            two.clone()
                .prop_map(|(a, b)| format!("atan2({a}, 3 + cos({b}))")),
            two.prop_map(|(a, b)| format!("(u + u v where u = {a}, v = {b})")),
            (inner.clone(), 2_i32..6).prop_map(|(a, n)| format!("({a})^{n}")),
            (inner.clone(), 1_i32..4).prop_map(|(a, n)| format!("(1.5 + sin({a}))^-{n}")),
            (
                prop::sample::select(vec![
                    "sin",
                    "cos",
                    "tanh",
                    "atan",
                    "asinh",
                    "sinc",
                    "cbrt(8 + sin",
                    "exp(sin",
                    "log(2 + cos",
                    "sqrt(2 + sin",
                    "gamma(2 + sin",
                    "lgamma(2 + cos",
                    "asin(0.5 cos",
                    "log1p(0.5 sin",
                    "expm1(sin",
                    "cosh(sin",
                    "acosh(3 + sin",
                    "atanh(0.5 sin",
                    "tan(0.5 sin",
                    "digamma(3 + sin",
                ]),
                inner
            )
                .prop_map(|(f, a)| if f.contains('(') {
                    format!("{f}({a}))")
                } else {
                    format!("{f}({a})")
                }),
        ]
    })
    .boxed()
}

/// Real formulas with choices, steps and kinks.
pub fn any_real() -> BoxedStrategy<String> {
    let smooth = smooth();
    (smooth.clone(), smooth.clone(), smooth)
        .prop_flat_map(|(a, b, c)| {
            prop::sample::select(vec![
                format!("if {a} < {b} then {c} else {a}"),
                format!("{{ {a} < 0: {b}, {b} <= {c} and not ({a} > 1): {c}, else: {a} }}"),
                format!("max({a}, {b}) + min({b}, |{c}|)"),
                format!("floor({a}) + mod({b}, 2 + sin({c}))"),
                format!("sign({a}) ({b}) + fract({c})"),
                format!("clamp({a}, -1, 1) + smoothstep(-1, 2, {b}) + mix({a}, {b}, {c})"),
                format!("smin({a}, {b}, 0.5) - step(0.2, {c})"),
                format!("|({a}, {b}, {c})| + dot(({a}, {b}), ({b}, {c}))"),
                format!("√(|{a}| + 0.1) + (|{b}| + 0.1)^({c})"),
                format!("abs(({a}) + i ({b})) + re(exp(({c}) i))"),
            ])
        })
        .boxed()
}

/// Holomorphic formulas in z.
pub fn holomorphic() -> BoxedStrategy<String> {
    let leaf = prop_oneof![
        4 => Just("z".to_owned()),
        1 => (1_u32..24).prop_map(|k| format!("{:?}i", f64::from(k) / 8.0)),
        1 => (1_u32..24).prop_map(|k| format!("{:?}", f64::from(k) / 8.0)),
    ];
    leaf.prop_recursive(4, 12, 2, |inner| {
        let two = (inner.clone(), inner.clone());
        prop_oneof![
            two.clone().prop_map(|(a, b)| format!("({a} + {b})")),
            two.clone().prop_map(|(a, b)| format!("({a}) ({b})")),
            two.clone()
                .prop_map(|(a, b)| format!("({a})/(({b})² + 9 + 4i)")),
            two.prop_map(|(a, b)| format!("(8 + sin({a}))^(({b})/2)")),
            (inner.clone(), 2_i32..5).prop_map(|(a, n)| format!("({a})^{n}")),
            (
                prop::sample::select(vec![
                    "sin",
                    "cos",
                    "sinh",
                    "exp(0.5 * ",
                    "log(9 + ",
                    "sqrt(9 + ",
                    "gamma(4 + 0.1 * "
                ]),
                inner
            )
                .prop_map(|(f, a)| if f.contains('(') {
                    format!("{f}({a}))")
                } else {
                    format!("{f}({a})")
                }),
        ]
    })
    .boxed()
}
