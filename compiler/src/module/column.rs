//! What a scene of a medium integrates along rays in closed form, by its settings.

use naga::Function;

use super::demand::{Answer, Demand};
use crate::integrate::{Density, Values};
use crate::ir::{Graph, cost};
use crate::lower::{Argument, LowerError, Output};
use crate::program::SettingValue;

/// The density of a scene's medium, and whether its column is taken in closed form.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Column {
    density: Density,
    /// Whether samples will not do.
    must: bool,
    /// How many samples one column stands in for.
    samples: f64,
}

impl Column {
    /// Of a scene with the setting `steps_by`; `None` for others, and where samples are taken in any case.
    pub fn of(settings: &[SettingValue]) -> Option<Self> {
        let find = |name: &str| settings.iter().find(|s| s.spec.name == name);
        let word = |name: &str| find(name).and_then(SettingValue::word);
        let number = |name: &str| find(name).map(|s| s.value.x);
        let must = match word("steps_by")? {
            "samples" => return None,
            word => word == "integral",
        };
        let Some(power) = number("power") else {
            // a stretch of the ray and the light's way to it, which is a third of the diagonal in the mean
            return Some(Self {
                density: Density {
                    power: 1.0,
                    values: Values::Positive,
                },
                must,
                samples: (1.0 + number("light_steps")? / 3.0) / 2.0,
            });
        };
        let values = match word("signs")? {
            "positive" => Values::Positive,
            "negative" => Values::Negative,
            _ => Values::Both,
        };
        let one_colour = values != Values::Both
            || find("positive").map(|s| s.value) == find("negative").map(|s| s.value);
        let whole = word("emission") == Some("even") && one_colour;
        (must || whole).then_some(Self {
            density: Density { power, values },
            must,
            samples: number("steps")? / 2.0,
        })
    }
}

impl Demand<'_> {
    /// The column along the ray o + t d from t = a to t = b, and the power and the signs of the values that it is of; zeros
    /// where samples are taken.
    pub(super) fn column(&self, stub: &Function) -> Result<Answer, LowerError> {
        let result = stub
            .result
            .as_ref()
            .ok_or(LowerError::NoForm("columns"))?
            .ty;
        let none = Answer {
            graph: Graph::new(),
            roots: Vec::new(),
            inputs: Vec::new(),
            output: Output::Zero(result),
        };
        let Some(wanted) = self.column else {
            return Ok(none);
        };
        let made = match wanted.density.column(self.formula) {
            Ok(made) => made,
            Err(problem) if wanted.must => return Err(LowerError::NoColumn(problem)),
            Err(_) => return Ok(none),
        };
        let (mut graph, column) = made.graph.compacted(&[made.integral.value]);
        let sample = cost(&self.formula.graph, &self.formula.value).weighted;
        // a sample costs some operations beside its formula
        let most = wanted.samples * (f64::from(sample) + 10.0);
        if !wanted.must && f64::from(cost(&graph, &column).weighted) > most {
            return Ok(none);
        }
        let signs = match wanted.density.values {
            Values::Both => 0.0,
            Values::Positive => 1.0,
            Values::Negative => 2.0,
        };
        let of = [wanted.density.power, signs].map(|x| graph.real(x));
        Ok(Answer {
            graph,
            roots: column.into_iter().chain(of).collect(),
            inputs: (0..2)
                .flat_map(|a| (0..3).map(move |k| Argument::Component(a, k)))
                .chain([Argument::Whole(2), Argument::Whole(3)])
                .collect(),
            output: Output::Compose(result, (0..3).map(Output::Node).collect()),
        })
    }
}
