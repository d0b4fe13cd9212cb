//! The IR as a formula of the language, for people: shared parts are named in a `where`.

use std::fmt::Write as _;

use rustc_hash::{FxHashMap, FxHashSet};

use super::{Graph, Id, Node, Op, Prim, Ty};
use crate::table;

/// How tightly a text holds together.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Hold {
    Choice,
    Logic,
    Comparison,
    Sum,
    Product,
    Power,
    Whole,
}

/// Longest text that may be written twice rather than named.
const MAX_REPEATED: usize = 6;

/// Names of the leaves.
#[derive(Clone, Copy, Debug, Default)]
pub struct LeafNames<'a> {
    /// Of the scalar inputs.
    pub inputs: &'a [String],
    /// Of the parameters.
    pub params: &'a [String],
}

/// Writes the roots as formulas. What stands in more than one place, and what the user has named, gets a name behind
/// `where`. A loop is written `iterate(…)`, which the language reads where the loop has one state.
#[must_use]
pub fn to_infix(graph: &Graph, roots: &[Id], names: LeafNames) -> String {
    let mut writer = Writer::new(graph, roots, names);
    for (id, node) in graph.ids().zip(graph.nodes()) {
        if writer.live[id.index()] {
            writer.node(id, node);
        }
    }
    writer.finish(roots)
}

struct Writer<'g> {
    graph: &'g Graph,
    names: LeafNames<'g>,
    live: Vec<bool>,
    uses: Vec<u32>,
    texts: Vec<Option<(String, Hold)>>,
    taken: FxHashSet<String>,
    shared: Vec<(String, String)>,
    states: FxHashMap<Id, String>,
    next: usize,
}

impl<'g> Writer<'g> {
    fn new(graph: &'g Graph, roots: &[Id], names: LeafNames<'g>) -> Self {
        let live = graph.reachable(roots);
        let mut uses = vec![0_u32; live.len()];
        for (id, node) in graph.ids().zip(graph.nodes()) {
            if live[id.index()] {
                for arg in &node.args {
                    uses[arg.index()] = uses[arg.index()].saturating_add(1);
                }
            }
        }
        let taken = names.inputs.iter().chain(names.params).cloned();
        Self {
            graph,
            names,
            taken: taken.collect(),
            texts: vec![None; live.len()],
            live,
            uses,
            shared: Vec::new(),
            states: FxHashMap::default(),
            next: 0,
        }
    }

    fn node(&mut self, id: Id, node: &Node) {
        let (text, hold) = self.text(id, node);
        let user = self
            .graph
            .name(id)
            .filter(|name| !self.taken.contains(*name));
        let simple = node.args.is_empty() || text.chars().count() <= MAX_REPEATED;
        let inside_loop = self
            .states
            .keys()
            .any(|state| self.graph.ty(*state) == Ty::Loop);
        let named = !simple && self.uses[id.index()] > 1 && node.ty != Ty::Loop && !inside_loop;
        let place = if named {
            let name = user.map_or_else(|| self.fresh(), str::to_owned);
            self.taken.insert(name.clone());
            self.shared.push((name.clone(), text));
            (name, Hold::Whole)
        } else {
            (text, hold)
        };
        self.texts[id.index()] = Some(place);
    }

    fn fresh(&mut self) -> String {
        loop {
            self.next += 1;
            let name = format!("t{}", self.next);
            if !self.taken.contains(&name) {
                return name;
            }
        }
    }

    /// The text of an operand where at least so tight a text is needed.
    fn operand(&self, id: Id, hold: Hold) -> String {
        match &self.texts[id.index()] {
            Some((text, found)) if *found >= hold => text.clone(),
            Some((text, _)) => format!("({text})"),
            None => "?".into(),
        }
    }

    fn text(&mut self, id: Id, node: &Node) -> (String, Hold) {
        match node.op {
            Op::Const(bits) => number(f64::from_bits(bits)),
            Op::Truth(value) => (value.to_string(), Hold::Whole),
            Op::Input(k) => (leaf(self.names.inputs, k, "input"), Hold::Whole),
            Op::Param(k) => (leaf(self.names.params, k, "param"), Hold::Whole),
            Op::Time => ("time".into(), Hold::Whole),
            Op::Pixel => ("pixel".into(), Hold::Whole),
            Op::Variable(k) => {
                let name = self.graph.name(id).map(str::to_owned);
                (name.unwrap_or_else(|| format!("variable{k}")), Hold::Whole)
            }
            Op::State(..) => {
                let name = self.graph.name(id).map(str::to_owned);
                let name = name.filter(|n| !self.taken.contains(n));
                let name = name.unwrap_or_else(|| self.fresh());
                self.taken.insert(name.clone());
                self.states.insert(id, name.clone());
                (name, Hold::Whole)
            }
            Op::Counter(_) => ("k".into(), Hold::Whole),
            Op::Loop { .. } => (self.repeat(id), Hold::Whole),
            Op::Result(k) => {
                let text = node.args.first().map(|&a| self.operand(a, Hold::Whole));
                let text = text.unwrap_or_default();
                let several = node.args.first().and_then(|&a| self.graph.as_loop(a));
                if several.is_some_and(|it| it.states.len() > 1) {
                    (format!("{text}[{k}]"), Hold::Whole)
                } else {
                    (text, Hold::Whole)
                }
            }
            Op::Apply(prim) => self.apply(prim, node),
        }
    }

    fn repeat(&self, id: Id) -> String {
        let Some(it) = self.graph.as_loop(id) else {
            return "iterate(…)".into();
        };
        let mut out = format!("iterate({}", self.operand(it.count, Hold::Choice));
        for state in &it.states {
            let leaf = self.operand(state.leaf, Hold::Whole);
            let [init, next] = [state.init, state.next].map(|x| self.operand(x, Hold::Choice));
            let _ = write!(out, ", {leaf} = {init}, {next}");
        }
        if let Some(until) = it.until {
            let _ = write!(out, " until {}", self.operand(until, Hold::Choice));
        }
        out.push(')');
        out
    }

    fn apply(&self, prim: Prim, node: &Node) -> (String, Hold) {
        let binary = |sign: &str, left: Hold, right: Hold, hold: Hold| {
            let (a, b) = (
                self.operand(node.args[0], left),
                self.operand(node.args[1], right),
            );
            (format!("{a}{sign}{b}"), hold)
        };
        let comparison = |sign: &str| binary(sign, Hold::Sum, Hold::Sum, Hold::Comparison);
        match prim {
            Prim::Neg => (
                format!("-{}", self.operand(node.args[0], Hold::Product)),
                Hold::Sum,
            ),
            Prim::Add => binary(" + ", Hold::Sum, Hold::Product, Hold::Sum),
            Prim::Sub => binary(" - ", Hold::Sum, Hold::Product, Hold::Sum),
            Prim::Mul => binary("*", Hold::Product, Hold::Power, Hold::Product),
            Prim::Div => binary("/", Hold::Product, Hold::Power, Hold::Product),
            Prim::Pow => binary("^", Hold::Whole, Hold::Whole, Hold::Power),
            Prim::PowInt(n) => {
                let base = self.operand(node.args[0], Hold::Whole);
                let exponent = if n < 0 {
                    format!("({n})")
                } else {
                    n.to_string()
                };
                (format!("{base}^{exponent}"), Hold::Power)
            }
            Prim::Less => comparison(" < "),
            Prim::LessEqual => comparison(" <= "),
            Prim::Equal => comparison(" == "),
            Prim::NotEqual => comparison(" != "),
            Prim::And => binary(" and ", Hold::Comparison, Hold::Comparison, Hold::Logic),
            Prim::Or => binary(" or ", Hold::Comparison, Hold::Comparison, Hold::Logic),
            Prim::Not => (
                format!("not {}", self.operand(node.args[0], Hold::Whole)),
                Hold::Logic,
            ),
            Prim::Select => {
                let [c, a, b] = [0, 1, 2].map(|k| self.operand(node.args[k], Hold::Logic));
                (format!("if {c} then {a} else {b}"), Hold::Choice)
            }
            Prim::Complex => self.complex(node),
            Prim::Hypot3 => (format!("length(({}))", self.list(node)), Hold::Whole),
            _ => {
                let row = table::row(prim);
                // the first of a family has a name of its own
                if let Some(n) = prim.order().filter(|&n| n > 0 || row.names.is_empty()) {
                    let call = format!("{}({n}, {})", row.mnemonic, self.list(node));
                    return (call, Hold::Whole);
                }
                let name = row.names.first().copied().unwrap_or(row.mnemonic);
                (format!("{name}({})", self.list(node)), Hold::Whole)
            }
        }
    }

    fn list(&self, node: &Node) -> String {
        let args = node.args.iter().map(|&a| self.operand(a, Hold::Choice));
        args.collect::<Vec<_>>().join(", ")
    }

    /// a + b i
    fn complex(&self, node: &Node) -> (String, Hold) {
        let values = (
            self.graph.as_real(node.args[0]),
            self.graph.as_real(node.args[1]),
        );
        match values {
            (Some(re), Some(im)) if im.to_bits() == 0 => number(re),
            (Some(0.0), Some(1.0)) => ("i".into(), Hold::Whole),
            (Some(0.0), Some(-1.0)) => ("-i".into(), Hold::Sum),
            (Some(0.0), Some(im)) if im.is_finite() => {
                let hold = if im < 0.0 { Hold::Sum } else { Hold::Product };
                (format!("{}i", number(im).0), hold)
            }
            _ => (format!("complex({})", self.list(node)), Hold::Whole),
        }
    }

    fn finish(mut self, roots: &[Id]) -> String {
        let mut out: Vec<String> = Vec::new();
        for &root in roots {
            out.push(self.operand(
                root,
                if roots.len() > 1 {
                    Hold::Sum
                } else {
                    Hold::Choice
                },
            ));
        }
        let mut text = if out.len() == 1 {
            out.remove(0)
        } else {
            format!("({})", out.join(", "))
        };
        for (k, (name, value)) in std::mem::take(&mut self.shared)
            .into_iter()
            .rev()
            .enumerate()
        {
            let lead = if k == 0 { "\n  where " } else { ",\n        " };
            let _ = write!(text, "{lead}{name} = {value}");
        }
        text
    }
}

fn leaf(names: &[String], k: u16, kind: &str) -> String {
    let name = names.get(usize::from(k)).cloned();
    name.unwrap_or_else(|| format!("{kind}{k}"))
}

fn number(x: f64) -> (String, Hold) {
    let hold = if x.is_sign_negative() {
        Hold::Sum
    } else {
        Hold::Whole
    };
    if x.is_nan() {
        return ("(0/0)".into(), Hold::Whole);
    }
    if x.is_infinite() {
        return (if x > 0.0 { "∞" } else { "-∞" }.into(), hold);
    }
    let plain = format!("{x}");
    let short = format!("{x:e}");
    (
        if short.len() < plain.len() {
            short
        } else {
            plain
        },
        hold,
    )
}
