//! A survey for programs: `docs/accuracy.md` says what the fields mean.

use pullback_compiler::table::{Bound, Metric};
use serde::{Serialize, Serializer};

use super::error::Judge;
use super::measure::{Errors, Witness, in_metric};
use super::report::MOST_CASES;
use super::survey::{Finding, Row, Survey, tier_name};
use super::tables::Expected;

/// Version of the format: the number grows when a program that reads the older one would misread the newer.
const VERSION: u32 = 1;

#[derive(Serialize)]
struct Document<'s> {
    version: u32,
    adapter: &'s str,
    clock: &'static str,
    quick: bool,
    random_points: usize,
    allowances: &'s [String],
    functions: Vec<Function<'s>>,
    exceptions: &'s [String],
}

#[derive(Serialize)]
struct Function<'s> {
    function: &'s str,
    domain: String,
    formula: &'s str,
    tiers: Vec<Tier>,
}

#[derive(Serialize)]
struct Tier {
    tier: &'static str,
    unit: &'static str,
    value: Quantity,
    derivative: Option<Quantity>,
    nanoseconds: Option<f64>,
    cost: Option<f64>,
}

#[derive(Serialize)]
struct Quantity {
    cases: usize,
    wrong: usize,
    metric: &'static str,
    bound: Option<f64>,
    max: f64,
    #[serde(rename = "max_99.9%")]
    most_cases: f64,
    bits: f64,
    by_component: f64,
    by_norm: f64,
    by_unit: f64,
    worst: Worst,
    first_wrong: Option<Worst>,
}

#[derive(Serialize)]
struct Worst {
    at: Vec<Number>,
    got: Vec<Number>,
    expected: Vec<Option<Number>>,
}

/// A number, as text where it is none that JSON has.
struct Number(f64);

impl Serialize for Number {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        if self.0.is_finite() {
            serializer.serialize_f64(self.0)
        } else {
            serializer.serialize_str(&self.0.to_string())
        }
    }
}

/// The survey as JSON.
///
/// # Errors
/// It cannot be written.
pub fn json(survey: &Survey) -> Result<String, serde_json::Error> {
    let document = Document {
        version: VERSION,
        adapter: &survey.adapter,
        clock: if survey.device_clock {
            "device"
        } else {
            "program"
        },
        quick: survey.quick,
        random_points: survey.random_points,
        allowances: &survey.allowances,
        functions: survey.rows.iter().map(function).collect(),
        exceptions: &survey.exceptions,
    };
    Ok(serde_json::to_string_pretty(&document)? + "\n")
}

fn function(row: &Row) -> Function<'_> {
    Function {
        function: row.subject.word,
        domain: row.subject.domain.to_string(),
        formula: &row.subject.body,
        tiers: row.findings.iter().map(tier).collect(),
    }
}

fn tier(finding: &Finding) -> Tier {
    let derivative = finding.measured.derivative.as_ref();
    let [value, slope] = finding.declared.metrics;
    let judged = derivative.filter(|errors| errors[0].count() > 0);
    Tier {
        tier: tier_name(finding.tier),
        unit: finding.format.unit_words(),
        value: quantity(
            finding,
            &finding.measured.value,
            finding.declared.value,
            value,
        ),
        derivative: judged
            .map(|errors| quantity(finding, errors, finding.declared.derivative, slope)),
        nanoseconds: finding.cost.map(|cost| cost.seconds * 1e9),
        cost: finding.cost.and_then(|cost| cost.relative),
    }
}

fn quantity(
    finding: &Finding,
    all: &[Errors; 3],
    bound: Option<Bound>,
    metric: Metric,
) -> Quantity {
    let errors = in_metric(all, metric);
    let most = |metric| in_metric(all, metric).max();
    Quantity {
        cases: errors.count(),
        wrong: errors.wrong.len(),
        metric: match metric {
            Metric::Component => "component",
            Metric::Norm => "norm",
            Metric::Unit => "unit",
        },
        bound: bound.map(|b| b.units),
        max: errors.max(),
        most_cases: errors.quantile(MOST_CASES),
        bits: finding.format.right_bits(errors.max()),
        by_component: most(Metric::Component),
        by_norm: most(Metric::Norm),
        by_unit: most(Metric::Unit),
        worst: worst(&errors.worst),
        first_wrong: errors.wrong.first().map(worst),
    }
}

fn worst(witness: &Witness) -> Worst {
    let numbers = |all: &[f64]| all.iter().map(|&x| Number(x)).collect();
    let right = |expected: &Expected| match *expected {
        Expected::Unstated => None,
        Expected::Number { value, .. } => Some(Number(value)),
    };
    Worst {
        at: numbers(&witness.at),
        got: numbers(&witness.got),
        expected: witness.expected.iter().map(right).collect(),
    }
}
