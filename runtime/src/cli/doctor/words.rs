//! What the doctor finds, in words.

use pullback_runtime::Capabilities;
use pullback_runtime::capabilities::Arithmetic;

use super::report::{AdapterReport, Report, Tier, Trial};

/// The report for people.
pub(super) fn text(report: &Report) -> String {
    let mut text = format!("pullback {} on {}\n\n", report.pullback, report.system);
    for (i, adapter) in report.adapters.iter().enumerate() {
        text += &format!("adapter {}: {}\n", i + 1, adapter.name);
        text += &facts(adapter);
        if let Some(trial) = &adapter.trial {
            text += &tried(trial);
        }
        if let Some(error) = &adapter.error {
            text += &line("test", &format!("FAILED: {error}"));
        }
        if let Some(tiers) = &adapter.tiers {
            text += &line("extended", &tier(&tiers.extended));
            text += &line("double", &tier(&tiers.double));
        }
        text.push('\n');
    }
    text + &report.advice.join("\n") + "\n"
}

fn line(label: &str, what: &str) -> String {
    format!("  {label:<10} {what}").trim_end().to_owned() + "\n"
}

fn facts(adapter: &AdapterReport) -> String {
    let limits = &adapter.limits;
    let mut text = line("kind", adapter.kind);
    text += &line("interface", &adapter.interface);
    text += &line("driver", &adapter.driver);
    text += &line(
        "limits",
        &format!(
            "buffer {} MiB, storage binding {} MiB, texture side {}, workgroups {}",
            limits.buffer_bytes >> 20,
            limits.storage_binding_bytes >> 20,
            limits.texture_side,
            limits.workgroups
        ),
    );
    for feature in &adapter.features {
        let answer = if feature.offered { "yes" } else { "no " };
        let what = format!("{answer} {} ({})", feature.name, feature.meaning);
        text += &line("feature", &what);
    }
    text
}

fn tried(trial: &Trial) -> String {
    let mut text = line(
        "test",
        &format!(
            "ok, ready in {:.0} ms, {} rows in {:.1} ms, arithmetic known in {:.1} ms",
            trial.ready_ms, trial.rows, trial.rows_ms, trial.probe_ms
        ),
    );
    let found: &Capabilities = &trial.capabilities;
    text += &line("f32", "");
    text += &habits(&found.single);
    match &found.double {
        Some(double) => {
            text += &line("f64", "");
            text += &habits(double);
        }
        None => text += &line("f64", "not offered"),
    }
    for (format, decorated) in [
        ("f32", &found.single_decorated),
        ("f64", &found.double_decorated),
    ] {
        if let Some(decorated) = decorated {
            let what = format!(
                "{format} {}, TwoSum as written {}",
                order(decorated),
                exact(decorated.two_sum)
            );
            text += &line("decorated", &what);
        }
    }
    let forms: Vec<_> = found
        .forms
        .iter()
        .map(|form| format!("{}: {}", form.name, exact(form.wrong)))
        .collect();
    text += &line("pairs", &forms.join("; "));
    let loops = found.turns.map_or("are not ended".to_owned(), |turns| {
        format!("end without an error after {turns} turns in all")
    });
    text + &line("loops", &loops)
}

/// The arithmetic of a format.
fn habits(found: &Arithmetic) -> String {
    let mut text = String::new();
    let mut add = |label: &str, what: String| text += &format!("    {label:<10} {what}\n");
    add("order", order(found).to_owned());
    add(
        "sums",
        format!(
            "TwoSum as written {}, with hidden steps {}",
            exact(found.two_sum),
            exact(found.two_sum_hidden)
        ),
    );
    add(
        "products",
        format!(
            "TwoProd by fma {}, by halves with hidden steps {}",
            exact(found.two_product_fma),
            exact(found.two_product_halves)
        ),
    );
    let fma = if found.two_product_fma == 0.0 {
        "rounds once"
    } else {
        "is not fused"
    };
    add("fma", fma.to_owned());
    let r = &found.rounding;
    let sums = r.sum.max(r.difference).max(r.product);
    add(
        "rounding",
        format!(
            "+ - * {}, / {}, sqrt {}",
            rounding(sums),
            rounding(r.quotient),
            rounding(r.root)
        ),
    );
    let s = &found.special;
    add(
        "subnormal",
        format!(
            "results {}, arguments {}",
            kept(&s.subnormal_results),
            kept(&s.subnormal_arguments)
        ),
    );
    add("zeros", signs(&s.zeros));
    add("infinity", signs(&s.infinities));
    add("NaN", signs(&s.nans));
    text
}

/// What becomes of the order of roundings.
fn order(found: &Arithmetic) -> &'static str {
    match (found.two_sum > 0.0, found.contracted > 0.0) {
        (false, false) => "kept as written",
        (true, false) => "sums are reassociated",
        (false, true) => "products are fused with sums",
        (true, true) => "sums are reassociated, products fused with sums",
    }
}

fn exact(share: f64) -> String {
    if share == 0.0 {
        "exact".to_owned()
    } else {
        // Not 0.0 % or 100.0 % where it is neither.
        let percent = (100.0 * share).max(0.1);
        let percent = if share < 1.0 {
            percent.min(99.9)
        } else {
            percent
        };
        format!("wrong for {percent:.1} %")
    }
}

fn rounding(ulp: f64) -> String {
    if ulp <= 0.5 + 1e-6 {
        "correct".to_owned()
    } else if ulp > 1e6 {
        "hopeless".to_owned()
    } else {
        format!("within {:.2} ulp", (ulp * 100.0).ceil() / 100.0)
    }
}

fn kept(broken: &[String]) -> String {
    if broken.is_empty() {
        "kept".to_owned()
    } else {
        format!("lost ({})", broken.join(", "))
    }
}

fn signs(broken: &[String]) -> String {
    if broken.is_empty() {
        "as IEEE 754 has it".to_owned()
    } else {
        format!("wrong in {}", broken.join(", "))
    }
}

fn tier(tier: &Tier) -> String {
    if tier.available {
        tier.how.clone()
    } else {
        format!("not available: {}", tier.how)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_and_errors_are_not_rounded_to_what_they_are_not() {
        assert_eq!(exact(0.0), "exact");
        assert_eq!(exact(1e-6), "wrong for 0.1 %");
        assert_eq!(exact(0.99999), "wrong for 99.9 %");
        assert_eq!(exact(1.0), "wrong for 100.0 %");
        assert_eq!(rounding(0.5), "correct");
        assert_eq!(rounding(0.5001), "within 0.51 ulp");
        assert_eq!(rounding(f64::INFINITY), "hopeless");
    }
}
