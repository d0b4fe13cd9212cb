//! Rays that pass a pole at distances whose squares are no numbers of binary32, or that are denormal themselves.

use pullback_compiler::What;
use pullback_compiler::integrate::{Otherwise, field_integral};
use pullback_compiler::lower::Precision;
use pullback_runtime::executor::Arithmetic;
use pullback_tests::accuracy::evaluators::Machine;

use super::{SINGLE, formula, points};

/// Rays of numbers of binary32, about how far they pass from the pole, and the integrals of 1/|p|, 1/|p|² and 1/|(x, y)| by their
/// antiderivatives with mpmath at 120 digits, infinite where the line goes through the pole.
const RAYS: [([f64; 8], [f64; 3]); 8] = [
    // 2e-40, from far away
    (
        [
            -227_311.703_125,
            9.512_655_891_605_706e-35,
            7.534_371_219_625_021e-35,
            0.414_809_882_640_838_6,
            -1.735_914_524_620_940_1e-40,
            -1.374_912_014_241_580_8e-40,
            547_990.0,
            547_990.25,
        ],
        [
            429.709_732_716_25,
            3.909_999_496_970_72e40,
            430.511_890_473_642,
        ],
    ),
    // 2e-20
    (
        [1e-20, -2e-20, 1e-20, 0.6, 0.5, -0.7, -3.0, 5.0],
        [
            90.296_552_099_092_6,
            1.353_179_774_229_97e20,
            120.544_029_879_061,
        ],
    ),
    // 2e-30, turned
    (
        [3e-30, 1e-33, -2e-30, 0.6, 0.5, -0.7, 2.0, -1.0],
        [
            -132.554_919_161_417,
            -1.559_760_920_915_52e30,
            -177.248_906_254_075,
        ],
    ),
    // 1e-36
    (
        [0.0, 1e-36, 0.0, 1.0, 0.0, 0.0, -100.0, 7.0],
        [
            173.723_501_319_856,
            3.141_592_540_683_69e36,
            173.723_501_319_856,
        ],
    ),
    // 1e-36, with an end that is nearer than the root of the least number
    (
        [0.0, 1e-36, 2e-37, 1.0, 1e-38, 0.0, -1e-30, 1.0],
        [
            98.055_647_488_459,
            3.080_583_941_602_18e36,
            98.094_868_198_162_9,
        ],
    ),
    // 1e-17
    (
        [-5.0, 0.0, 1e-17, 0.5, 0.0, 1e-30, 1.0, 1e4],
        [179.388_915_286_448, 6.283_185_409_116_99e17, f64::INFINITY],
    ),
    // 3e-15, along a short interval
    (
        [0.0, 3e-15, 0.0, 1.0, 1e-20, 0.0, -1e-7, 2e-7],
        [
            36.723_578_538_951_6,
            1.047_197_569_356_68e15,
            36.723_578_538_951_6,
        ],
    ),
    // 3e-16, of a short direction
    (
        [0.0, 3e-16, 0.0, 1e-3, 1e-20, 0.0, -1.0, 2.0],
        [
            59_749.426_561_397_2,
            1.047_197_460_699_75e19,
            59_749.426_561_397_2,
        ],
    ),
];

#[test]
fn rays_beside_a_pole() {
    let densities = [
        "1/length((x, y, z))",
        "1/(x^2 + y^2 + z^2)",
        "1/length((x, y))",
    ];
    let single = Machine::Processor(Arithmetic::Ieee32, Precision::Accurate);
    let at = points(
        RAYS.iter()
            .map(|(ray, _)| ray.map(|x| f64::from(x as f32)).to_vec()),
    );
    for (k, text) in densities.into_iter().enumerate() {
        let of = formula(text);
        let made = field_integral(&of, Otherwise::Refuse).unwrap();
        let integral = made.into_formula(&of);
        for (machine, bound, largest) in [
            (&Machine::Reference, 1e-11, f64::MAX),
            (&single, SINGLE, f64::from(f32::MAX)),
        ] {
            let values = machine.run(&integral, What::Value, &at).unwrap();
            for ((ray, exact), value) in RAYS.iter().zip(values) {
                let (exact, value) = (exact[k], value[0]);
                let is_right = if exact.abs() > largest {
                    value == f64::INFINITY.copysign(exact)
                } else {
                    (value - exact).abs() <= bound * exact.abs()
                };
                assert!(
                    is_right,
                    "{text} on {ray:?}, {machine}: {value:e}, not {exact:e}"
                );
            }
        }
    }
}
