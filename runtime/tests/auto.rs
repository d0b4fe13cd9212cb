//! `auto` as a whole: which tier it takes for a formula and a view, and the reason that it says. On the software adapter,
//! which has every tier.

use pullback_compiler::lower::Precision;
use pullback_runtime::auto::{Outcome, Scenery, Verdict, choose};
use pullback_runtime::{AdapterChoice, Frame, Gpu, Pipeline, Size, View, fill_in_scale};

const SIZE: Size = Size {
    width: 320,
    height: 240,
};

/// What is chosen for a picture of a program; `None` where there is no adapter and that is allowed.
fn verdict(source: &str, center: [f64; 2], height: f64) -> Option<Verdict> {
    let gpu = match Gpu::open(&AdapterChoice::Software) {
        Ok(gpu) => gpu,
        Err(_) if std::env::var_os("PULLBACK_ALLOW_NO_GPU").is_some() => return None,
        Err(error) => panic!("{error}"),
    };
    let program = pullback_compiler::compile(source)
        .program
        .expect("a program");
    let picture = &program.pictures()[0];
    let view = View { center, height };
    let mut settings = picture.settings.clone();
    fill_in_scale(&mut settings, picture, &view, SIZE, &[], 0.0);
    let frame = Frame {
        view,
        params: &[],
        settings: &[],
        size: SIZE,
        samples: 1,
        time: 0.0,
        pipeline: Pipeline::Compute,
    };
    let scenery = Scenery {
        program: &program,
        picture: 0,
        settings: &settings,
        frame: &frame,
    };
    Some(choose(&gpu, &scenery).expect("a verdict"))
}

/// What came of a tier, in words: good, seen, unresolved, absent, or not tried.
fn outcome(verdict: &Verdict, precision: Precision) -> &'static str {
    let trial = verdict.trials.iter().find(|t| t.precision == precision);
    match trial.map(|t| t.outcome) {
        None => "not tried",
        Some(Outcome::Same(_)) => "good",
        Some(Outcome::Differs { .. }) => "seen",
        Some(Outcome::Unresolved) => "unresolved",
        Some(Outcome::NotOffered) => "absent",
    }
}

/// Holds the outcome of each tier from `fast` to `double`.
fn expect(verdict: &Verdict, outcomes: [&str; 4]) {
    let found = Precision::ALL.map(|p| outcome(verdict, p));
    assert_eq!(found, outcomes, "{verdict}");
    assert!(verdict.is_true(), "{verdict}");
    assert_eq!(verdict.samples, 48 * 48);
}

#[test]
fn built_in_functions_do_where_they_are_good() {
    let Some(verdict) = verdict("f(x, y) = x^2 + sin(y) + sqrt(x + 3)", [0.0, 0.0], 3.0) else {
        return;
    };
    expect(&verdict, ["good", "not tried", "not tried", "not tried"]);
    assert_eq!(verdict.precision, Precision::Fast);
    let said = verdict.to_string();
    assert!(
        said.starts_with("auto: fast; fast: differs by at most ") && said.ends_with(" pixels"),
        "{said}"
    );
}

/// The built-in sinh of this adapter is off by up to 83 % near 0.
#[test]
fn own_functions_are_taken_where_built_in_ones_are_seen_to_fail() {
    let Some(verdict) = verdict("f(x, y) = sinh(x)/atan(x) + y", [0.0, 0.0], 0.01) else {
        return;
    };
    expect(&verdict, ["seen", "good", "not tried", "not tried"]);
    assert_eq!(verdict.precision, Precision::Accurate);
    let said = verdict.to_string();
    let worst = match verdict.trials[0].outcome {
        Outcome::Differs { count, worst, .. } => {
            assert!(worst.is_visible() && count > 0);
            format!("fast: {count} of 2304 samples differ, the worst by {worst} at (")
        }
        other => panic!("{other:?}"),
    };
    assert!(
        said.starts_with("auto: accurate; ") && said.contains(&worst),
        "{said}"
    );
    assert!(said.contains("; accurate: differs by at most "), "{said}");
}

/// A field with detail at every scale around a point that is no float32 number.
const DEEP: &str = "f(x, y) = sin(3 log((x - 1/3)^2 + (y - 1/7)^2))";

#[test]
fn deep_views_take_the_faster_of_the_wide_tiers_that_do() {
    let Some(verdict) = verdict(DEEP, [1.0 / 3.0, 1.0 / 7.0], 1e-8) else {
        return;
    };
    expect(&verdict, ["unresolved", "unresolved", "good", "good"]);
    let time = |p| {
        let trial = verdict.trials.iter().find(|t| t.precision == p);
        trial.and_then(|t| t.time).expect("good tiers are timed")
    };
    let (extended, double) = (time(Precision::Extended), time(Precision::Double));
    let faster = if double < extended {
        Precision::Double
    } else {
        Precision::Extended
    };
    assert_eq!(verdict.precision, faster, "{verdict}");
    let said = verdict.to_string();
    assert!(
        said.contains(
            "; accurate: does not tell neighbouring pixels apart; extended: differs by at most "
        ) && said.matches("ms a batch").count() == 2,
        "{said}"
    );
}

#[test]
fn deeper_views_need_doubles() {
    let Some(verdict) = verdict(DEEP, [1.0 / 3.0, 1.0 / 7.0], 2e-12) else {
        return;
    };
    let extended = outcome(&verdict, Precision::Extended);
    assert!(["seen", "unresolved"].contains(&extended), "{verdict}");
    expect(&verdict, ["unresolved", "unresolved", extended, "good"]);
    assert_eq!(verdict.precision, Precision::Double);
    assert!(verdict.to_string().starts_with("auto: double; "));
}

/// Where none will do, the one that differs least is taken, and the verdict is not called true.
#[test]
fn views_that_no_tier_resolves_are_said() {
    let Some(verdict) = verdict(DEEP, [1.0 / 3.0, 1.0 / 7.0], 1e-15) else {
        return;
    };
    assert!(!verdict.is_true(), "{verdict}");
    let found = Precision::ALL.map(|p| outcome(&verdict, p));
    assert!(!found.contains(&"good"), "{verdict}");
    assert_eq!(found[2], "unresolved", "{verdict}");
}

/// 10⁶ + x is rounded to a sixteenth before the sine sees it.
#[test]
fn single_precision_is_not_enough_where_digits_of_the_point_are_lost() {
    let Some(verdict) = verdict("f(x, y) = sin(1000000 + x) + y", [0.0, 0.0], 2.0) else {
        return;
    };
    expect(&verdict, ["seen", "seen", "good", "good"]);
    assert!(verdict.precision.format().is_wide(), "{verdict}");
}

// What is visible decides, and each scene has its own: where x > 1, f below is noise in single precision.

/// The outcome of `accurate` for a scene, or of `fast` where that is good already.
fn single(show: &str) -> Option<&'static str> {
    let noise = "f(x, y, z) = if x > 1 then x + 0.2 sin(10000000 + y + z) else x\n";
    let verdict = verdict(&format!("{noise}show {show}"), [0.0, 0.0], 2.0)?;
    let fast = outcome(&verdict, Precision::Fast);
    println!("{show}: {verdict}");
    Some(if fast == "good" {
        fast
    } else {
        outcome(&verdict, Precision::Accurate)
    })
}

/// Holds that single precision is good for one picture, and seen to fail in another.
fn tells_apart(good: &str, seen: &str) {
    if let Some(found) = single(good) {
        assert_eq!(found, "good", "{good}");
    }
    if let Some(found) = single(seen) {
        assert_eq!(found, "seen", "{seen}");
    }
}

#[test]
fn of_slices_the_planes_are_compared() {
    tells_apart(
        "slices(f) { axis = (1, 0, 0), position = -0.5, reference = none }",
        "slices(f) { axis = (1, 0, 0), position = 0.7, reference = none }",
    );
    // the walls behind have it in their colours, planes in the middle do not
    tells_apart(
        "slices(f) { axis = (1, 0, 0), reference = planes, planes = (-0.4, 0, 0), box = (0.9, 2, 2) }",
        "slices(f) { axis = (1, 0, 0), position = -0.5, reference = walls }",
    );
}

#[test]
fn of_nested_surfaces_every_level_is_compared() {
    tells_apart(
        "nested(f) { level = -0.5, spacing = 0.3, count = 3, box = (0.95, 2, 2) }",
        "nested(f) { level = 0, spacing = 0.6, count = 5 }",
    );
}

#[test]
fn of_a_cutaway_what_is_left_is_compared() {
    tells_apart(
        "cutaway(f) { normal = (1, 0, 0), position = 0.17 }",
        "cutaway(f) { normal = (-1, 0, 0), position = 0.17, spacing = 0.6, count = 5 }",
    );
    // no level is out there, but the cut has contour lines
    tells_apart(
        "cutaway(f) { normal = (1, 0, 0), position = 0.17, count = 1 }",
        "cutaway(f) { normal = (0, 0, 1), position = 0.2, count = 1 }",
    );
}

#[test]
fn of_volumes_what_can_be_seen_is_compared() {
    tells_apart(
        "volume(f) { signs = negative }",
        "volume(f) { signs = positive }",
    );
    tells_apart(
        "volumecut(f) { normal = (1, 0, 0), position = 0.17 }",
        "volumecut(f) { normal = (0, 1, 0), position = 0.2, density = 0.000001 }",
    );
}

#[test]
fn of_a_cloud_what_is_dense_is_compared() {
    let cloud = |sign: &str| {
        format!(
            "f(x, y, z) = {sign}(if x > 1 then 1 + 0.5 sin(10000000 + y + z) else 1)\nshow scatter(f)"
        )
    };
    for (sign, expected) in [("-", Precision::Fast), ("", Precision::Extended)] {
        let Some(verdict) = verdict(&cloud(sign), [0.0, 0.0], 2.0) else {
            return;
        };
        let wide = verdict.precision.format().is_wide();
        assert_eq!(wide, expected.format().is_wide(), "{sign}: {verdict}");
    }
}

#[test]
fn of_a_glow_the_light_near_the_surface_is_compared() {
    let glow = |size: &str| {
        format!(
            "f(x, y, z) = √(x^2 + y^2 + z^2) - {size} + (if x > 1 then 0.02 sin(10000000 + y + z) else 0)\n\
             show glow(f) {{ estimate = value, epsilon = 0.005, box = 2 }}"
        )
    };
    for (size, wide) in [("0.3", false), ("1.5", true)] {
        let Some(verdict) = verdict(&glow(size), [0.0, 0.0], 2.0) else {
            return;
        };
        assert_eq!(
            verdict.precision.format().is_wide(),
            wide,
            "{size}: {verdict}"
        );
    }
}

/// South of the sphere's equator |z| > 1, which no pixel's own coordinates are.
#[test]
fn of_the_sphere_what_it_shows_is_compared() {
    let sphere = |view: &str| {
        format!(
            "f(z) = if abs(z) > 3 then z exp(0.1i sin(10000000 + re(z))) else z\nshow sphere(f) {{ {view} }}"
        )
    };
    for (view, wide) in [
        ("pitch = 90", false),
        ("pitch = 0", true),
        ("pitch = 90, rotation = (180, 0, 0)", true),
    ] {
        let Some(verdict) = verdict(&sphere(view), [0.0, 0.0], 2.3) else {
            return;
        };
        assert_eq!(
            verdict.precision.format().is_wide(),
            wide,
            "{view}: {verdict}"
        );
    }
}
